// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/parallel/ranks.h"
#include "support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <numeric>

/// The same run by each process alone and by all of them together.
namespace ogive::sph::test
{
/// A checkpoint whole on each rank.
using Files = Memory;

inline std::vector<std::size_t> by_id(const std::vector<std::int64_t> &id)
{
  std::vector<std::size_t> order(id.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return id[a] < id[b]; });
  return order;
}

/// Two lists in the order of the ids, to `bound` of the largest of both, or of `least`.
inline void expect_near(const std::vector<double> &a, const std::vector<std::size_t> &order_a,
                        const std::vector<double> &b, const std::vector<std::size_t> &order_b, double bound,
                        const std::string &name, std::size_t each = 1, double least = 0)
{
  ASSERT_EQ(a.size(), b.size()) << name;
  ASSERT_EQ(a.size(), each * order_a.size()) << name;
  double size = least, most = 0;
  for (std::size_t k = 0; k < order_a.size(); ++k)
    for (std::size_t c = 0; c < each; ++c)
    {
      const double x = a[order_a[k] * each + c], y = b[order_b[k] * each + c];
      ASSERT_TRUE(std::isfinite(x) && std::isfinite(y)) << name;
      size = std::max({size, std::abs(x), std::abs(y)});
      most = std::max(most, std::abs(x - y));
    }
  EXPECT_LE(most, bound * size) << name;
}

inline void expect_near(const Sample &a, const Sample &b, double bound)
{
  ASSERT_EQ(a.id.size(), b.id.size());
  const auto order_a = by_id(a.id), order_b = by_id(b.id);
  for (std::size_t k = 0; k < order_a.size(); ++k)
    ASSERT_EQ(a.id[order_a[k]], b.id[order_b[k]]);
  const auto near = [&](const std::vector<double> &u, const std::vector<double> &v, const char *name) {
    expect_near(u, order_a, v, order_b, bound, name);
  };
  // Components of one vector are measured by the whole.
  const auto vector = [&](const auto &u, const auto &v, const char *name) {
    std::vector<double> all_u, all_v;
    for (std::size_t k = 0; k < u[0].size(); ++k)
      for (std::size_t c = 0; c < u.size(); ++c)
      {
        all_u.push_back(u[c].empty() ? 0. : u[c][k]);
        all_v.push_back(v[c].empty() ? 0. : v[c][k]);
      }
    expect_near(all_u, order_a, all_v, order_b, bound, name, u.size());
  };
  vector(a.x, b.x, "x");
  vector(a.v, b.v, "v");
  vector(a.sigma, b.sigma, "sigma");
  near(a.density, b.density, "density");
  near(a.energy, b.energy, "energy");
  near(a.plastic_strain, b.plastic_strain, "plastic strain");
  near(a.damage, b.damage, "damage");
}

inline double total(const Balance &b)
{
  return b.kinetic + b.internal();
}

inline void expect_near(const Balance &a, const Balance &b, double bound)
{
  const double energy = std::max(total(a), a.kinetic), momentum = std::sqrt(2 * a.mass * a.kinetic);
  EXPECT_NEAR(a.mass, b.mass, bound * a.mass);
  for (const auto amount : {&Balance::kinetic, &Balance::elastic, &Balance::plastic_work, &Balance::viscosity_heat,
                            &Balance::hourglass_sph, &Balance::external_work, &Balance::wall_loss, &Balance::friction_heat})
    EXPECT_NEAR(a.*amount, b.*amount, bound * energy);
  EXPECT_LE((a.momentum - b.momentum).norm(), bound * momentum);
  EXPECT_LE((a.external_impulse - b.external_impulse).norm(), bound * momentum);
  EXPECT_EQ(a.gradient_fallbacks, b.gradient_fallbacks);
}

/// Every field that a checkpoint has for each particle, by id. Components are
/// measured by their whole; heats, which are parts of the energy, by the kinetic one.
inline void expect_same_fields(const Files &a, const Files &b, double bound)
{
  const auto order_a = by_id(a.integers("s/id")), order_b = by_id(b.integers("s/id"));
  int        fields  = 0;
  double     kinetic = 0;
  for (const char *name : {"s/v_x", "s/v_y", "s/v_z"})
    if (a.all_doubles().count(name))
      for (const double v : a.doubles(name))
        kinetic = std::max(kinetic, .5 * v * v);
  for (const auto &[name, values] : a.all_doubles())
    if (values.size() == order_a.size())
    {
      double size = name.find("heat") != std::string::npos ? kinetic : 0.; // of the whole vector or tensor
      for (const auto &[other, part] : a.all_doubles())
        if (name.rfind('_') != std::string::npos && other.rfind(name.substr(0, name.rfind('_') + 1), 0) == 0)
          for (const double p : part)
            size = std::max(size, std::abs(p));
      expect_near(values, order_a, b.doubles(name), order_b, bound, name, 1, size);
      ++fields;
    }
  for (const auto &[name, values] : a.all_integers())
    if (values.size() == order_a.size())
    {
      const auto others = b.integers(name);
      for (std::size_t k = 0; k < order_a.size(); ++k)
        ASSERT_EQ(values[order_a[k]], others[order_b[k]]) << name;
      ++fields;
    }
  EXPECT_GT(fields, 20);
}

inline void expect_equal(const Sample &a, const Sample &b)
{
  ASSERT_EQ(a.id, b.id);
  const auto same = [](const std::vector<double> &u, const std::vector<double> &v) {
    ASSERT_EQ(u.size(), v.size());
    ASSERT_EQ(std::memcmp(u.data(), v.data(), u.size() * sizeof(double)), 0);
  };
  for (int k = 0; k < 3; ++k)
  {
    same(a.x[k], b.x[k]);
    same(a.v[k], b.v[k]);
  }
  for (int k = 0; k < 6; ++k)
    same(a.sigma[k], b.sigma[k]);
  same(a.density, b.density);
  same(a.energy, b.energy);
}

/// A run of one solver; `before` is called before each step.
template <int dim>
struct Course
{
  Solver<dim>                          solver;
  Runner<dim>                          run{solver};
  std::function<void(Solver<dim> &)>   before = [](Solver<dim> &) {};

  Course(Parameters p, const std::vector<BodyParticles<dim>> &bodies, const Ranks &ranks)
    : solver((p.ranks = ranks, p), bodies)
  {}
  void advance(int steps)
  {
    for (int k = 0; k < steps; ++k)
    {
      before(solver);
      const StepStatus status = run.step();
      ASSERT_TRUE(status.ok) << status.culprit.why;
    }
  }
};

inline std::int64_t migrated(const Ranks &ranks, const Diagnostics &d)
{
  return ranks.sum(static_cast<std::int64_t>(d.migrated));
}

/// A block of copper about `centre`, in spacings, turning about it.
template <int dim>
BodyParticles<dim> spinning(double spacing, const Vec3 &cells, double rate,
                            std::shared_ptr<const materials::Material> m = copper())
{
  auto p = box<dim>(-.5 * spacing * cells, .5 * spacing * cells, spacing, m, .1, 3);
  for (std::size_t i = 0; i < p.x.size(); ++i)
  {
    p.v[i][0] = -rate * p.x[i][1];
    p.v[i][1] = rate * p.x[i][0];
    if constexpr (dim == 3)
      p.v[i][2] = .3 * rate * p.x[i][0];
  }
  return p;
}

/// Both ways of the run must agree to `bound`.
template <int dim>
void compare(const Parameters &p, const std::vector<BodyParticles<dim>> &bodies, int steps, double bound = 1e-9,
             bool must_move = true, const std::function<void(Solver<dim> &)> &before = [](Solver<dim> &) {})
{
  const Ranks ranks = Ranks::world();
  Course<dim> alone(p, bodies, Ranks()), shared(p, bodies, ranks);
  ASSERT_EQ(alone.solver.size(), shared.solver.size());
  alone.before = shared.before = before;
  alone.advance(steps);
  shared.advance(steps);
  for (std::size_t k = 0; k < bodies.size(); ++k)
    expect_near(alone.solver.sample(bodies[k].body), shared.solver.sample(bodies[k].body), bound);
  expect_near(alone.solver.balance(), shared.solver.balance(), bound);
  EXPECT_NEAR(alone.solver.stable_dt().dt, shared.solver.stable_dt().dt, bound * alone.solver.stable_dt().dt);
  EXPECT_EQ(ranks.sum(static_cast<std::int64_t>(shared.solver.updates())), static_cast<std::int64_t>(alone.solver.updates()));
  for (std::size_t w = 0; w < p.walls.size(); ++w)
    EXPECT_NEAR(alone.solver.wall_force(w), shared.solver.wall_force(w), 1e3 * bound * std::abs(alone.solver.wall_force(w)));
  const Diagnostics a = alone.solver.diagnostics(), b = shared.solver.diagnostics();
  EXPECT_EQ(a.pairs, b.pairs);
  EXPECT_EQ(a.rebuilds, b.rebuilds);
  Files files_a, files_b;
  alone.solver.save(files_a, "s");
  shared.solver.save(files_b, "s");
  expect_same_fields(files_a, files_b, bound);
  if (must_move && !ranks.alone())
  {
    EXPECT_GT(a.rebuilds, 2u); // else this proves little
    EXPECT_GT(migrated(ranks, b), 0);
  }
}
} // namespace ogive::sph::test
