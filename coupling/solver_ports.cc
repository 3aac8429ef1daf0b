// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/coupler.h"
#include "fem/solver.h"
#include "sph/solver.h"

#include <memory>

namespace ogive::coupling
{
namespace
{
template <int dim>
class FemPort : public MeshPort<dim>
{
public:
  explicit FemPort(fem::Solver<dim> &solver) : solver_(solver) {}

  Surface<dim> surface() override { return solver_.surface(); }
  StepLimit    stable_dt() const override { return solver_.stable_dt(); }
  void         add_mass(std::uint32_t node, double mass) override { solver_.add_mass(node, mass); }
  bool embed(std::uint32_t element, const std::array<double, dim> &point, double reach,
             Embedding<dim> &result) const override
  {
    typename fem::Solver<dim>::Embedding found;
    if (!solver_.embed(element, point, reach, found))
      return false;
    result.node   = found.node;
    result.weight = found.weight;
    return true;
  }

  typename MeshPort<dim>::Cells cells(int body) const override
  {
    auto cells = solver_.cells(body);
    return {std::move(cells.element), std::move(cells.node)};
  }
  void copy_state(std::uint32_t element, materials::Points &to, std::size_t k) const override
  {
    solver_.copy_pressing_state(element, to, k);
  }
  void copy_states(std::span<const std::uint32_t> elements, materials::Points &to) const override
  {
    solver_.gather_pressing_states(elements, to);
  }
  void follow(const std::string &who, std::span<const std::uint32_t> nodes) override { solver_.follow(who, nodes); }
  void weigh(int body, std::span<const std::uint32_t> elements, std::span<const double> shares) override
  {
    solver_.weigh(body, elements, shares);
  }
  void damp(int body, std::span<const std::uint32_t> elements, double share) override
  {
    solver_.damp(body, elements, share);
  }

private:
  fem::Solver<dim> &solver_;
};

template <int dim>
class SphPort : public ParticlePort<dim>
{
public:
  explicit SphPort(sph::Solver<dim> &solver) : solver_(solver) {}

  Surface<dim> surface() override { return solver_.surface(); }
  StepLimit    stable_dt() const override { return solver_.stable_dt(); }
  void         set_slaves(std::span<const std::int64_t> ids) override { solver_.set_slaves(ids); }
  void drive_slaves(const std::array<std::span<const double>, dim> &v) override { solver_.drive_slaves(v); }
  void slave_forces(const std::array<std::span<double>, dim> &f) const override { solver_.slave_forces(f); }
  std::span<const std::uint32_t> index_of_id() const override { return solver_.index_of_id(); }
  std::span<const double>        damage() const override { return solver_.damage(); }
  void set_pieces(std::span<const std::int64_t> pieces) override { solver_.set_pieces(pieces); }

  void set_riders(const sph::Newcomers<dim> &riders) override { solver_.set_riders(riders); }
  typename ParticlePort<dim>::Riders riders(int body) override
  {
    const auto r = solver_.riders(body);
    return {r.velocity, r.state};
  }
  void set_seam_hourglass(int body, double c) override { solver_.set_seam_hourglass(body, c); }
  void seam_forces(int body, const std::array<std::span<double>, dim> &f) const override
  {
    solver_.seam_forces(body, f);
  }
  void seam_normals(int body, const std::array<std::span<double>, dim> &area) override
  {
    solver_.seam_normals(body, area);
  }
  void weigh(std::span<const std::int64_t> ids, std::span<const double> shares) override { solver_.weigh(ids, shares); }
  double                              seam_work(int body) const override { return solver_.seam_work(body); }
  typename ParticlePort<dim>::Lattice lattice(int body) const override
  {
    return {solver_.cell(body), solver_.reach(body)};
  }

private:
  sph::Solver<dim> &solver_;
};

template <class Port, class Base, class Solver>
std::unique_ptr<Base> port_to(Solver *solver)
{
  return solver ? std::make_unique<Port>(*solver) : nullptr;
}
} // namespace

// Here and not in coupler.cc, so that the layer links without the solvers.
template <int dim>
Coupler<dim>::Coupler(const input::Scene &scene, fem::Solver<dim> *mesh, sph::Solver<dim> *particles,
                      const Ranks &ranks)
  : Coupler(scene, port_to<FemPort<dim>, MeshPort<dim>>(mesh),
            port_to<SphPort<dim>, ParticlePort<dim>>(particles), ranks)
{}

template Coupler<1>::Coupler(const input::Scene &, fem::Solver<1> *, sph::Solver<1> *, const Ranks &);
template Coupler<2>::Coupler(const input::Scene &, fem::Solver<2> *, sph::Solver<2> *, const Ranks &);
template Coupler<3>::Coupler(const input::Scene &, fem::Solver<3> *, sph::Solver<3> *, const Ranks &);
} // namespace ogive::coupling
