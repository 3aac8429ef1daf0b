// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/interface.h"

#include "core/base/error.h"
#include "coupling/interface_blended.h"
#include "coupling/interface_pair_flux.h"
#include "coupling/interface_tied.h"

#include <algorithm>

namespace ogive::coupling
{
namespace
{
template <int dim>
using Maker = std::unique_ptr<Interface<dim>> (*)(const InterfaceSpec &, MeshPort<dim> &, ParticlePort<dim> &,
                                                  Slaves<dim> &);

template <int dim, class Method>
std::unique_ptr<Interface<dim>> make(const InterfaceSpec &spec, MeshPort<dim> &mesh,
                                     ParticlePort<dim> &particles, Slaves<dim> &slaves)
{
  return std::make_unique<Method>(spec, mesh, particles, slaves);
}

template <int dim>
const std::vector<std::pair<std::string, Maker<dim>>> &registry()
{
  static const std::vector<std::pair<std::string, Maker<dim>>> methods{
    {"tied", make<dim, TiedInterface<dim>>},
    {"pair-flux", make<dim, PairFluxInterface<dim>>},
    {"blended", make<dim, BlendedInterface<dim>>},
  };
  return methods;
}
} // namespace

std::vector<std::string> interface_methods()
{
  std::vector<std::string> names;
  for (const auto &entry : registry<3>())
    names.push_back(entry.first);
  return names;
}

template <int dim>
bool Slaves<dim>::holds(std::int64_t particle) const
{
  return std::find(id.begin(), id.end(), particle) != id.end();
}

template <int dim>
void Slaves<dim>::add(std::int64_t particle)
{
  id.push_back(particle);
  for (int a = 0; a < dim; ++a)
  {
    velocity[a].push_back(0);
    force[a].push_back(0);
  }
}

template <int dim>
std::unique_ptr<Interface<dim>> make_interface(const InterfaceSpec &spec, MeshPort<dim> &mesh,
                                               ParticlePort<dim> &particles, Slaves<dim> &slaves)
{
  std::string known;
  for (const auto &[name, maker] : registry<dim>())
  {
    if (name == spec.method)
      return maker(spec, mesh, particles, slaves);
    known += (known.empty() ? "" : ", ") + name;
  }
  throw InputError({"", 0, spec.name}, "unknown interface method \"" + spec.method + "\"",
                   "one of: " + known);
}

#define OGIVE_INSTANTIATE(dim)                                                                               \
  template struct Slaves<dim>;                                                                               \
  template std::unique_ptr<Interface<dim>> make_interface(const InterfaceSpec &, MeshPort<dim> &,            \
                                                          ParticlePort<dim> &, Slaves<dim> &);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::coupling
