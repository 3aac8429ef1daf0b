// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/materials/material.h"
#include "sph/fill.h"
#include "sph/neighbours.h"
#include "sph/solver.h"
#include "sph/sweep.h"
#include "sph/viscosity/pair.h"

#include <Eigen/Dense>

#include <map>
#include <random>

namespace ogive::sph::test
{
inline std::shared_ptr<const materials::Material> material(double density, double bulk, double shear,
                                                           double yield = materials::none)
{
  materials::Parameters p;
  p.name             = "test";
  p.density          = density;
  p.shear_modulus    = shear;
  p.eos.law          = "linear";
  p.eos.bulk_modulus = bulk;
  p.strength.law     = "elastic";
  if (!std::isnan(yield))
  {
    p.strength.law          = "perfect-plastic";
    p.strength.yield_stress = yield;
  }
  return materials::make_material(p);
}

/// Copper: c_L 4660 m/s.
inline std::shared_ptr<const materials::Material> copper()
{
  return material(8930, 130e9, 48e9);
}

/// Moves particles by up to `jitter` spacings along each axis (seeded).
template <int dim>
void shake(BodyParticles<dim> &p, double spacing, double jitter, unsigned seed)
{
  std::mt19937                           random(seed);
  std::uniform_real_distribution<double> shift(-jitter * spacing, jitter * spacing);
  for (auto &x : p.x)
    for (auto &c : x)
      c += shift(random);
}

/// A box of particles, jittered by `jitter` spacings (seeded), at rest.
template <int dim>
BodyParticles<dim> box(const Vec3 &lower, const Vec3 &upper, double spacing,
                       std::shared_ptr<const materials::Material> m, double jitter = 0, unsigned seed = 7,
                       const std::vector<input::SymmetryPlane> &planes = {})
{
  input::Scene scene;
  scene.symmetry = planes;
  input::Body body;
  body.name        = "box";
  body.spacing     = spacing;
  body.shape.lower = lower;
  body.shape.upper = upper;
  auto p           = fill<dim>(body, scene, 0, m);
  shake(p, spacing, jitter, seed);
  return p;
}

/// Steps with the solver's own bound, time-centred kicks.
template <int dim>
struct Runner
{
  Solver<dim> &solver;
  double       time = 0, last = 0;

  StepStatus step(double dt)
  {
    const StepStatus status = solver.step({time, .5 * (last + dt), dt});
    time += dt;
    last = dt;
    return status;
  }
  StepStatus step() { return step(solver.stable_dt().dt); }
};

/// Hand-placed particles for one sweep: packs the records, finds the pairs by
/// brute force within 3h, the widest support.
template <int dim>
struct Cloud
{
  using L = Layout<dim>;
  using V_ = ViscousLayout<dim>;
  using V  = Eigen::Matrix<double, dim, 1>;
  using M  = Eigen::Matrix<double, dim, dim>;

  double              h;
  std::vector<V>      x, v;
  std::vector<double> mass, density;
  NeighbourRows       rows;
  Sweep               sweep;
  AlignedVector<double> force, correction, energy, gradient_sums, force_sums, power_sums, viscosity, hourglass, viscous, viscous_sums,
    unasked = AlignedVector<double>(simd_width);

  explicit Cloud(const BodyParticles<dim> &p, double h_)
    : h(h_)
    , mass(p.mass)
  {
    for (std::size_t i = 0; i < p.x.size(); ++i)
    {
      x.push_back(Eigen::Map<const V>(p.x[i].data()));
      v.push_back(V::Zero());
      density.push_back(p.material->density());
    }
  }

  std::size_t size() const { return x.size(); }

  void pack(bool standard = false)
  {
    const std::size_t n = size();
    rows.clear();
    for (std::size_t i = 0; i < n; ++i)
    {
      for (std::size_t j = 0; j < n; ++j)
        if (j != i && (x[i] - x[j]).norm() < 3 * h)
          rows.index.push_back(static_cast<std::uint32_t>(j));
      while (rows.index.size() % simd_width)
        rows.index.push_back(static_cast<std::uint32_t>(n));
      rows.row.push_back(rows.index.size());
    }
    force.assign((n + 1) * L::force_stride, 0.);
    correction.assign((n + 1) * L::correction_stride, 0.);
    energy.assign((n + 1) * L::energy_stride, 0.);
    gradient_sums.assign(n * L::gradient_stride, 0.);
    force_sums.assign(n * L::forces_stride, 0.);
    power_sums.assign(n * L::powers_stride, 0.);
    viscous_sums.assign(n * V_::sums_stride, 0.);
    hourglass.assign(rows.index.size(), 0.);
    viscosity.assign(rows.index.size() * dim, 0.);
    for (std::size_t i = 0; i < n; ++i)
    {
      double *r = &force[i * L::force_stride];
      for (int a = 0; a < dim; ++a)
      {
        r[L::x + a] = x[i][a];
        r[L::v + a] = v[i][a];
      }
      r[L::weight]  = standard ? mass[i] : mass[i] / density[i];
      r[L::density] = density[i];
      r[L::sound]   = 4660;
    }
    sweep.begin              = 0;
    sweep.end                = n;
    sweep.row                = rows.row.data();
    sweep.index              = rows.index.data();
    sweep.force_records      = force.data();
    sweep.correction_records = correction.data();
    sweep.energy_records     = energy.data();
    sweep.pair_viscosity     = viscosity.data();
    sweep.viscosity_step     = 1;
    sweep.pair_weak          = unasked.data();
    sweep.n_entries          = rows.index.size();
    sweep.pair_hourglass     = hourglass.data();
    sweep.h                  = h;
    sweep.alpha              = 1;
    sweep.beta               = 2;
    sweep.hourglass          = .2;
  }

  /// Records for the viscous sweep, all of the viscosity weak and kept.
  template <class Law>
  void pack_viscous(const std::vector<M> &gradients, bool limited)
  {
    const std::size_t stride = V_::stride(Law::n_fields, limited);
    viscous.assign((size() + 1) * stride, 0.);
    sweep.viscous_records = viscous.data();
    for (std::size_t i = 0; i < size(); ++i)
    {
      double           *r = &viscous[i * stride];
      ViscousPoint<dim> p;
      p.gradient = gradients[i];
      p.density  = density[i];
      p.sound    = 4660;
      p.h        = h;
      std::copy(&force[i * L::force_stride], &force[i * L::force_stride] + 2 * dim, r);
      r[V_::mass]     = mass[i];
      r[V_::density]  = density[i];
      r[V_::sound]    = p.sound;
      r[V_::strength] = 1;
      Law{sweep.alpha, sweep.beta, h}.prepare(p, r + V_::extra);
      for (int a = 0; a < dim; ++a)
        for (int b = a; limited && b < dim; ++b)
          r[V_::extra + Law::n_fields + L::sym(a, b)] = .5 * (gradients[i](a, b) + gradients[i](b, a));
    }
  }
  V viscous_force_on(std::size_t i) const
  {
    return Eigen::Map<const V>(&viscous_sums[i * V_::sums_stride + V_::direct_sum]);
  }

  Sweep with(AlignedVector<double> &sums)
  {
    sweep.sums = sums.data();
    return sweep;
  }

  M moment(std::size_t i) const
  {
    M m;
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        m(a, b) = gradient_sums[i * L::gradient_stride + L::m_sum + L::sym(a, b)];
    return m;
  }
  M difference(std::size_t i) const
  {
    M g;
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        g(a, b) = gradient_sums[i * L::gradient_stride + L::g_sum + a * dim + b];
    return g;
  }
  void set_p(std::size_t i, const M &p)
  {
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        force[i * L::force_stride + L::p + a * dim + b] = p(a, b);
  }
  void set_rate(std::size_t i, const M &l)
  {
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        force[i * L::force_stride + L::rate + L::sym(a, b)] = .5 * (l(a, b) + l(b, a));
  }
  V force_on(std::size_t i) const { return Eigen::Map<const V>(&force_sums[i * L::forces_stride + L::f_sum]); }
};

/// A checkpoint in memory.
class Memory : public ArchiveWriter, public ArchiveReader
{
public:
  using ArchiveWriter::write;
  void write(const std::string &name, std::span<const double> v) override
  {
    doubles_[name].assign(v.begin(), v.end());
  }
  void write(const std::string &name, std::span<const std::int64_t> v) override
  {
    integers_[name].assign(v.begin(), v.end());
  }
  std::vector<double>       doubles(const std::string &name) const override { return doubles_.at(name); }
  std::vector<std::int64_t> integers(const std::string &name) const override { return integers_.at(name); }

  const std::map<std::string, std::vector<double>>       &all_doubles() const { return doubles_; }
  const std::map<std::string, std::vector<std::int64_t>> &all_integers() const { return integers_; }

private:
  std::map<std::string, std::vector<double>>       doubles_;
  std::map<std::string, std::vector<std::int64_t>> integers_;
};
} // namespace ogive::sph::test
