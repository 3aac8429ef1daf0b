// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "fem/elements/hex8.h"
#include "fem/elements/line2.h"
#include "fem/elements/quad4.h"
#include "fem/elements/quad4_area_weighted.h"
#include "fem/elements/b_bar.h"
#include "fem/elements/spectral.h"
#include "fem/integrated_group.h"
#include "fem/one_point_group.h"

/// Names of elements in a scene, and what stands behind them.
namespace ogive::fem
{
namespace
{
/// The correction needs masses between the corners of an element.
void refuse_correction(const std::string &element, const input::FemOptions &options)
{
  if (options.correction != "none")
    throw InputError({"", 0, "FEM/correction"}, "is " + options.correction + ", but there are " + element + " elements",
                     "FEM/correction = none", "or FEM/element = one-point");
}

template <class Group, int dim>
std::unique_ptr<ElementGroup<dim>> build(const BodyMesh<dim> &mesh, const GroupPlace &place,
                                         const input::FemOptions &options)
{
  return std::make_unique<Group>(mesh, place, options);
}

template <int dim>
std::unique_ptr<ElementGroup<dim>> spectral(const BodyMesh<dim> &mesh, const GroupPlace &place,
                                            const input::FemOptions &options)
{
  refuse_correction("spectral", options);
  switch (mesh.degree)
  {
    case 2:
      return build<IntegratedGroup<Spectral<dim, 2>>, dim>(mesh, place, options);
    case 3:
      return build<IntegratedGroup<Spectral<dim, 3>>, dim>(mesh, place, options);
    default:
      require(mesh.degree == 4, "no spectral element of this degree");
      return build<IntegratedGroup<Spectral<dim, 4>>, dim>(mesh, place, options);
  }
}
} // namespace

template <>
std::unique_ptr<ElementGroup<1>> make_element_group(const BodyMesh<1> &mesh, const GroupPlace &place,
                                                    const input::FemOptions &options)
{
  // A line of two nodes has one form only.
  if (mesh.element == "spectral")
    return spectral<1>(mesh, place, options);
  return build<OnePointGroup<Line2>, 1>(mesh, place, options);
}

template <>
std::unique_ptr<ElementGroup<2>> make_element_group(const BodyMesh<2> &mesh, const GroupPlace &place,
                                                    const input::FemOptions &options)
{
  if (mesh.element == "spectral")
    return spectral<2>(mesh, place, options);
  if (mesh.element != "one-point")
    refuse_correction(mesh.element, options);
  if (mesh.element == "b-bar")
    return mesh.axisymmetric ? build<IntegratedGroup<BBar<2, true>>, 2>(mesh, place, options) :
                               build<IntegratedGroup<BBar<2, false>>, 2>(mesh, place, options);
  if (mesh.element == "full")
    return mesh.axisymmetric ? build<IntegratedGroup<Full<2, true>>, 2>(mesh, place, options) :
                               build<IntegratedGroup<Full<2, false>>, 2>(mesh, place, options);
  if (mesh.element == "area-weighted")
  {
    require(mesh.axisymmetric, "only rings are area-weighted");
    return build<OnePointGroup<Quad4AreaWeighted>, 2>(mesh, place, options);
  }
  require(mesh.element == "one-point", "unknown element");
  return mesh.axisymmetric ? build<OnePointGroup<Quad4Axisymmetric>, 2>(mesh, place, options) :
                             build<OnePointGroup<Quad4>, 2>(mesh, place, options);
}

template <>
std::unique_ptr<ElementGroup<3>> make_element_group(const BodyMesh<3> &mesh, const GroupPlace &place,
                                                    const input::FemOptions &options)
{
  if (mesh.element == "spectral")
    return spectral<3>(mesh, place, options);
  if (mesh.element != "one-point")
    refuse_correction(mesh.element, options);
  if (mesh.element == "b-bar")
    return build<IntegratedGroup<BBar<3, false>>, 3>(mesh, place, options);
  if (mesh.element == "full")
    return build<IntegratedGroup<Full<3, false>>, 3>(mesh, place, options);
  require(mesh.element == "one-point", "unknown element");
  return build<OnePointGroup<Hex8>, 3>(mesh, place, options);
}
} // namespace ogive::fem
