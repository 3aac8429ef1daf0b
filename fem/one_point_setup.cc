// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/base/error.h"
#include "fem/elements/hex8.h"
#include "fem/elements/line2.h"
#include "fem/elements/quad4.h"
#include "fem/elements/quad4_area_weighted.h"
#include "fem/one_point_group.h"

#include <algorithm>

/// One-point elements before their first step.
namespace ogive::fem
{
template <class Element>
OnePointGroup<Element>::OnePointGroup(const BodyMesh<dim> &mesh, const GroupPlace &place,
                                      const input::FemOptions &options)
  : body_(mesh.body)
  , n_(mesh.n_cells())
  , padded_n_(padded(n_))
  , first_element_(place.first_element)
  , first_node_(place.first_node)
  , shared_(place.shared)
  , own_elements_(place.own)
  , material_(mesh.material)
  , options_(options)
  , bulk_(bulk_viscosity(options))
  , viscous_hourglass_(options.hourglass == "viscous")
  , corrected_(options.correction != "none")
  , split_(options.shock_split != "none")
  , shear_modulus_(mesh.material->shear_modulus())
  // A fluid has no shear stiffness; a tenth of its bulk modulus resists the
  // patterns without stiffening the volume response.
  , hourglass_modulus_(shear_modulus_ > 0 ? shear_modulus_ : .1 * mesh.material->bulk_modulus())
  , rest_(mesh.material->density())
  , grave_(place.grave)
  , by_step_((mesh.erosion.on && mesh.erosion.step > 0) || (mesh.converts && mesh.conversion.step > 0))
{
  require(n_ > 0 || shared_, "a body without elements");
  node_.resize(padded_n_ * corners);
  for (auto *a : {&mass_, &viscous_pressure_, &half_hourglass_, &half_viscous_, &half_power_,
                  &hourglass_energy_, &viscous_heat_})
    a->resize(padded_n_, 0.);
  // Whoever leaves takes its forces along; damping, or the velocity, may change under them.
  if (!modal || mesh.loses_elements() || options.local_steps != "none")
    corner_force_.resize(padded_n_ * corners * dim, 0.);
  Q_.resize(padded_n_ * modes * dim, 0.);
  if (by_step_)
    bound_.resize(padded_n_, 0.);
  corner_mass_.resize(Element::hoop ? padded_n_ * corners : 0);
  points_.resize(padded_n_);
  material_->initialise(points_, 0, padded_n_);
  limit_ = {0., 0.};

  for (std::size_t e = 0; e < padded_n_; ++e)
  {
    const std::size_t cell = std::min(e, n_ - 1);
    double            x[corners][dim];
    for (int a = 0; a < corners; ++a)
    {
      const std::uint32_t node   = mesh.cells[cell * corners + a];
      node_[slot(e, a, corners)] = static_cast<std::uint32_t>(place.first_node + node);
      for (int i = 0; i < dim; ++i)
        x[a][i] = mesh.x[i][node];
    }
    if constexpr (Element::hoop)
    {
      double share[corners];
      Element::corner_volumes(x, share);
      for (int a = 0; a < corners; ++a)
        corner_mass_[slot(e, a, corners)] = material_->density() * share[a];
    }
  }
  for (auto &component : nodal_force_)
    component.resize(mesh.n_nodes(), 0.);
  for (auto *field : {&weak_force_, &weak_acceleration_})
    for (auto &component : *field)
      component.resize(corrected_ ? mesh.n_nodes() : 0, 0.);
  weak_pressure_.resize(corrected_ ? padded_n_ : 0, 0.);
  half_correction_.resize(corrected_ ? padded_n_ : 0, 0.);
  if (mesh.converts) // a seam will come
    prepare_damping();
  find_rows();
  set_masses(mesh);
  // The correction and area weights ask neighbours; with local steps elements change their group.
  quiet_.resize((padded_n_ / width + block_packs - 1) / block_packs,
                options.quiescent_skip == "on" && !corrected_ && !area_weighted && options.local_steps == "none");
}

/// By the registers that measure volumes later: an element at rest has its own density.
template <class Element>
void OnePointGroup<Element>::set_masses(const BodyMesh<dim> &mesh)
{
  for (std::size_t pack = 0; pack < padded_n_ / width; ++pack)
  {
    Corners x;
    for (int a = 0; a < corners; ++a)
      for (int i = 0; i < dim; ++i)
        x[a][i] = VDouble(
          [&](auto lane) { return mesh.x[i][node_[(pack * corners + a) * width + lane] - first_node_]; });
    Shape shape;
    if constexpr (modal)
    {
      VDouble X[7][3];
      modes_of(x, X);
      shape.volume = areas_of(X, shape.area);
    }
    else
      Element::gradient(x, shape);
    store(rest_ * shape.volume, &mass_[pack * width]);
  }
}

template <class Element>
void OnePointGroup<Element>::find_rows()
{
  row_.resize(node_.size() / width);
  for (std::size_t k = 0; k < row_.size(); ++k)
  {
    row_[k] = node_[k * width];
    for (std::size_t lane = 1; lane < width; ++lane)
      if (node_[k * width + lane] != node_[k * width] + lane)
        row_[k] = no_row;
  }
}

template <class Element>
void OnePointGroup<Element>::initialise(const Nodes<dim> &nodes)
{
  if (options_.mass_scaling_step > 0)
  {
    inertia_ = mass_;
    scaling_ = 2 / options_.mass_scaling_step;
    start(nodes);
    scaling_ = 0;
    limit_   = {0., 0.};
  }
  start(nodes);
}

template class OnePointGroup<Line2>;
template class OnePointGroup<Quad4>;
template class OnePointGroup<Quad4Axisymmetric>;
template class OnePointGroup<Quad4AreaWeighted>;
template class OnePointGroup<Hex8>;
} // namespace ogive::fem
