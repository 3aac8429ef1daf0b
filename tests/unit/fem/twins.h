// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/parallel/ranks.h"
#include "tests/unit/fem/blocks.h"

#include <gtest/gtest.h>

#include <cstring>

/// The same model on all ranks together and, on each of them, alone.
namespace ogive::fem::test
{
template <int dim>
struct Twins
{
  Ranks                        ranks = Ranks::world();
  std::unique_ptr<Solver<dim>> alone, together;
  double                       time = 0, last = 0, extent = 0, speed = 0;
  bool                         rewound = false; ///< one has taken steps that the other has not

  explicit Twins(const std::vector<BodyMesh<dim>> &meshes, Parameters p = {})
  {
    alone    = solver_with<dim>(meshes, p);
    p.ranks  = ranks;
    together = solver_with<dim>(meshes, p);
    for (const auto &mesh : meshes)
      for (int i = 0; i < dim; ++i)
        for (const double x : mesh.x[i])
          extent = std::max(extent, std::abs(x));
  }

  /// Both take a step of the length that the one alone chooses.
  void step(double fixed_dt = 0)
  {
    const StepLimit limit = alone->stable_dt(), same = together->stable_dt();
    ASSERT_NEAR(same.dt / limit.dt, 1, 1e-9)
        << limit.culprit.id << " or " << same.culprit.id << " at " << time << ' '
        << alone->balance().eroded_elements << ' ' << together->balance().eroded_elements;
    const double dt = fixed_dt > 0 ? fixed_dt : limit.dt;
    for (auto *solver : {alone.get(), together.get()})
    {
      const StepStatus status = solver->step({time, .5 * (last + dt), dt});
      ASSERT_TRUE(status.ok) << status.culprit.entity << ' ' << status.culprit.id << ' '
                             << status.culprit.why;
    }
    time += dt;
    last = dt;
  }
  void steps(int n, double fixed_dt = 0)
  {
    for (int k = 0; k < n && !testing::Test::HasFatalFailure(); ++k)
      step(fixed_dt);
  }

  /// Nodes that several ranks move have the same bits on all of them: what a rank has of its
  /// nodes does not change as the owners tell all.
  void expect_same_bits()
  {
    const auto                               s = together->surface();
    std::array<std::vector<double>, 2 * dim> own;
    for (int i = 0; i < dim; ++i)
    {
      own[i].assign(s.x[i].begin(), s.x[i].end());
      own[dim + i].assign(s.v[i].begin(), s.v[i].end());
    }
    together->refresh_all();
    std::size_t kept = 0, other = 0;
    for (std::uint32_t a = 0; a < s.n; ++a)
      for (int i = 0; i < dim && together->keeps(a); ++i)
      {
        ++kept;
        other += own[i][a] != s.x[i][a] || own[dim + i][a] != s.v[i][a];
      }
    EXPECT_EQ(other, 0u) << "of " << kept;
  }

  void expect_equal(double tolerance = 1e-9)
  {
    if (testing::Test::HasFatalFailure())
      return;
    expect_same_bits();
    const auto s = alone->surface(), t = together->surface();
    ASSERT_EQ(s.n, t.n);
    double x = 0, v = 0;
    for (int i = 0; i < dim; ++i)
      for (std::size_t a = 0; a < s.n; ++a)
      {
        speed = std::max(speed, std::abs(s.v[i][a]));
        x     = std::max(x, std::abs(s.x[i][a] - t.x[i][a]));
        v     = std::max(v, std::abs(s.v[i][a] - t.v[i][a]));
      }
    EXPECT_LE(x, tolerance * extent);
    EXPECT_LE(v, tolerance * speed);
    for (std::size_t a = 0; a < s.n; ++a)
      ASSERT_NEAR(s.mass[a], t.mass[a], 1e-13 * s.mass[a]);
    EXPECT_EQ(s.contact_points, t.contact_points);
    ASSERT_EQ(s.facets.size(), t.facets.size());
    for (std::size_t f = 0; f < s.facets.size(); ++f)
      ASSERT_EQ(s.facets[f].element, t.facets[f].element);
    expect_equal_books(tolerance);
  }

  void expect_equal_books(double tolerance) const
  {
    const Balance a = alone->balance(), b = together->balance();
    const double  energy = a.kinetic + a.internal() + a.absorbed + std::abs(a.external_work),
                 push    = a.mass * speed;
    EXPECT_NEAR(a.mass, b.mass, 1e-13 * a.mass);
    for (const auto field :
         {&Balance::kinetic, &Balance::elastic, &Balance::plastic_work, &Balance::bulk_viscosity_heat,
          &Balance::hourglass_fem, &Balance::external_work, &Balance::wall_loss, &Balance::friction_heat,
          &Balance::absorbed, &Balance::eroded_energy})
      EXPECT_NEAR(a.*field, b.*field, tolerance * energy);
    EXPECT_LE((a.momentum - b.momentum).norm(), tolerance * push);
    EXPECT_LE((a.external_impulse - b.external_impulse).norm(), tolerance * push);
    EXPECT_LE((a.angular_momentum - b.angular_momentum).norm(), tolerance * push * extent);
    EXPECT_EQ(a.eroded_elements, b.eroded_elements);
    EXPECT_EQ(alone->size(), together->size());
    const auto updates = ranks.sum(static_cast<std::int64_t>(together->updates()));
    if (!rewound)
    {
      EXPECT_EQ(static_cast<std::int64_t>(alone->updates()), updates);
    }
  }
};
} // namespace ogive::fem::test
