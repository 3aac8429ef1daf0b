// SPDX-License-Identifier: LGPL-2.1-or-later
// What changes on several ranks: elements that die, turn into particles or change hands, steps
// in parts, checkpoints. Against one rank to 1e-9, as in ranks_test.cc.
#include "core/base/error.h"
#include "core/io/memory_archive.h"
#include "tests/unit/fem/twins.h"

#include <random>

using namespace ogive;
using namespace ogive::fem;
using namespace ogive::fem::test;

namespace
{
constexpr double H = 1e-3;

/// A shaken, spinning block that is drawn more and more towards one end.
template <int dim>
BodyMesh<dim> drawn(bool axisymmetric, bool dies = true)
{
  input::Scene scene;
  scene.dimension     = dimension_of(dim, axisymmetric);
  const double corner = axisymmetric ? 0 : 2 * H;
  input::Body  body   = box({corner, H, -H}, {corner + 3 * H, 8 * H, 2 * H}, H);
  body.erosion.on     = dies;
  body.erosion.strain = dim == 1 ? .01 : .04;
  auto mesh           = make_mesh<dim>(body, scene, 0, make(copper_linear_hardening()));
  shake(mesh, 0, 3);
  const int up = dim > 1 ? 1 : 0;
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
  {
    const double t = (mesh.x[up][a] - H) / (7 * H);
    mesh.v[up][a] += 400 * t * t;
    if (!axisymmetric && dim > 1)
      mesh.v[0][a] -= 3e3 * mesh.x[1][a]; // spin
  }
  return mesh;
}

template <int dim>
void expect_same_deaths(bool axisymmetric)
{
  Twins<dim> twins({drawn<dim>(axisymmetric)});
  twins.steps(dim == 2 ? 250 : 180);
  twins.expect_equal();
  const double died = twins.alone->balance().eroded_elements;
  EXPECT_GT(died, 1);
  EXPECT_LT(died, static_cast<double>(twins.alone->size()));
  for (std::uint32_t e = 0; e < twins.alone->size(); ++e)
    EXPECT_EQ(twins.alone->alive(e), twins.together->alive(e));
  const Sample a = twins.alone->sample(0), b = twins.together->sample(0);
  EXPECT_EQ(a.cells, b.cells);
  ASSERT_EQ(a.density.size(), b.density.size());
  for (std::size_t e = 0; e < a.density.size(); ++e)
  {
    EXPECT_NEAR(a.density[e] / b.density[e], 1, 1e-9);
    EXPECT_NEAR(a.plastic_strain[e], b.plastic_strain[e], 1e-9);
    EXPECT_NEAR(a.centre[0][e], b.centre[0][e], 1e-9 * twins.extent);
  }
}
TEST(RankedChanges, ElementsDie)
{
  expect_same_deaths<1>(false);
  expect_same_deaths<2>(false);
  expect_same_deaths<2>(true);
  expect_same_deaths<3>(false);
}

/// Conserved to rounding on all ranks together: mass, momenta and energy with what has left.
TEST(RankedChanges, BooksCloseOverDeaths)
{
  Twins<3>      twins({drawn<3>(false)});
  const Balance b0 = twins.together->balance();
  for (int k = 0; k < 200; ++k)
  {
    twins.step();
    const Balance b = twins.together->balance();
    ASSERT_NEAR(b.mass + b.eroded_mass, b0.mass, 1e-13 * b0.mass);
    ASSERT_LE((b.momentum + b.eroded_momentum - b0.momentum).norm(), 1e-12 * b0.momentum.norm());
    ASSERT_LE((b.angular_momentum + b.eroded_angular_momentum - b0.angular_momentum).norm(),
              1e-12 * b0.angular_momentum.norm());
    ASSERT_NEAR(closed(b) + b.eroded_energy, b0.kinetic, 1e-12 * b0.kinetic);
  }
}

/// What a coupling layer asks of elements, before and after some turn into particles.
TEST(RankedChanges, ElementsTurnIntoParticles)
{
  auto mesh              = drawn<3>(false, false);
  mesh.converts          = true;
  mesh.conversion.strain = .02;
  Twins<3> twins({mesh});
  EXPECT_EQ(twins.alone->elements_of(0), twins.together->elements_of(0));
  twins.steps(60);
  const std::vector<std::uint32_t> gone = {5, 40, 17, 62, 18};
  twins.together->refresh_all();
  const auto a = twins.alone->take_out(gone), b = twins.together->take_out(gone);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    EXPECT_EQ(a[k].node, b[k].node);
    EXPECT_NEAR(a[k].internal / b[k].internal, 1, 1e-9);
    for (int c = 0; c < 8; ++c)
      EXPECT_NEAR(a[k].mass[c] / b[k].mass[c], 1, 1e-12);
  }
  const std::vector<std::uint32_t> beside = {4, 41, 0, 16, 30, 61};
  twins.alone->damp(0, beside, .05);
  twins.together->damp(0, beside, .05);
  twins.steps(100);
  twins.expect_equal();
  EXPECT_EQ(twins.together->converted_elements(), gone.size());
  EXPECT_EQ(twins.alone->cells(0).element, twins.together->cells(0).element);
  EXPECT_EQ(twins.alone->cells(0).node, twins.together->cells(0).node);
  const auto of = twins.alone->conversion_measures(0, mesh.conversion);
  const auto to = twins.together->conversion_measures(0, mesh.conversion);
  ASSERT_EQ(of.size(), to.size());
  for (std::size_t e = 0; e < of.size(); ++e)
    EXPECT_NEAR(of[e], to[e], 1e-9 * (1 + of[e]));

  materials::Points s, t;
  s.resize(beside.size());
  t.resize(beside.size());
  twins.alone->gather_pressing_states(beside, s);
  twins.together->gather_pressing_states(beside, t);
  for (std::size_t k = 0; k < beside.size(); ++k)
  {
    EXPECT_NEAR(s.sigma[1][k], t.sigma[1][k], 1e-9 * 117e9);
    EXPECT_NEAR(s.density[k] / t.density[k], 1, 1e-9);
    twins.together->copy_pressing_state(beside[k], s, k);
    EXPECT_EQ(s.sigma[1][k], t.sigma[1][k]);
  }
  Solver<3>::Embedding  p, q;
  std::array<double, 3> inside{};
  for (int i = 0; i < 3; ++i)
    for (const std::uint32_t a : twins.alone->look(0).node)
      inside[i] += twins.alone->surface().x[i][a] / 8;
  ASSERT_TRUE(twins.alone->embed(0, inside, .1, p));
  ASSERT_TRUE(twins.together->embed(0, inside, .1, q));
  for (int c = 0; c < 8; ++c)
    EXPECT_NEAR(p.weight[c], q.weight[c], 1e-9);
}

/// Elements that stand for a part of their material.
TEST(RankedChanges, SharedMaterial)
{
  auto mesh = block<3>({0, 0, 0}, {4 * H, 3 * H, 3 * H}, H);
  shake(mesh, .1 * H, 5);
  Twins<3>                         twins({mesh});
  const std::vector<std::uint32_t> elements = {1, 2, 7, 20, 35};
  const std::vector<double>        shares   = {.5, .25, .75, .1, .9};
  twins.alone->weigh(0, elements, shares);
  twins.together->weigh(0, elements, shares);
  twins.steps(100);
  twins.expect_equal();
}

/// A push on nodes at and below the surface in each of four parts of a step, alike on all ranks.
TEST(RankedChanges, StepsInParts)
{
  auto mesh = block<2>({0, 0, 0}, {6 * H, 5 * H, 0}, H);
  shake(mesh, .1 * H, 5);
  Twins<2> twins({mesh});
  for (auto *solver : {twins.alone.get(), twins.together.get()})
    solver->allow_parts();
  const double dt = .8 * twins.alone->stable_dt().dt, h = dt / 4;
  for (int k = 0; k < 100; ++k)
    for (auto *solver : {twins.alone.get(), twins.together.get()})
    {
      const TimeStep whole{k * dt, k == 0 ? .5 * dt : dt, dt};
      for (int part = 0; part < 4; ++part)
      {
        const auto s = solver->surface();
        for (const std::uint32_t a : {0u, 5u, 9u, 20u})
          s.force[1][a] += 20. * (a + 1) * (.001 - s.x[1][a]) / H;
        if (part == 0)
          ASSERT_TRUE(solver->begin(whole, {whole.time, k == 0 ? .5 * h : h, h}).ok);
        else
          ASSERT_TRUE(solver->go_on({whole.time + part * h, h, h}).ok);
      }
      ASSERT_TRUE(solver->finish(whole).ok);
    }
  twins.expect_equal();
  EXPECT_NEAR(twins.alone->parts_error(), twins.together->parts_error(),
              1e-9 * twins.alone->balance().kinetic);
}

/// Two blocks fly through each other: boxes that were even at the start are not.
std::vector<BodyMesh<2>> passing(bool dies)
{
  std::vector<BodyMesh<2>> meshes;
  for (int b = 0; b < 2; ++b)
  {
    meshes.push_back(block<2>({b * 12 * H, b * .5 * H, 0}, {b * 12 * H + 6 * H, b * .5 * H + 4 * H, 0}, H,
                              false, b, copper_linear_hardening()));
    shake(meshes[b], .1 * H, 30);
    for (double &v : meshes[b].v[0])
      v += b == 0 ? 600 : -600;
    meshes[b].erosion.on     = dies;
    meshes[b].erosion.strain = .004;
  }
  return meshes;
}
Parameters restless()
{
  Parameters p;
  p.parallel.interval  = 20;
  p.parallel.imbalance = .9; // even is not even enough: shared anew whenever it was looked at
  return p;
}
TEST(RankedChanges, ElementsChangeHands)
{
  for (const bool dies : {false, true})
  {
    Twins<2> twins(passing(dies), restless());
    twins.steps(50);
    twins.expect_equal();
    // Back over a change of hands.
    twins.together->snapshot();
    const std::size_t moved = twins.together->share().moves;
    const double      dt    = twins.alone->stable_dt().dt;
    for (int k = 0; k < 45; ++k)
      ASSERT_TRUE(twins.together->step({twins.time + k * dt, dt, dt}).ok);
    EXPECT_GT(twins.together->share().moves, moved);
    twins.rewound = true;
    twins.together->restore();
    twins.expect_equal();
    twins.steps(100);
    twins.expect_equal();
    EXPECT_GT(twins.together->share().moves, moved + 1);
    if (dies)
    {
      EXPECT_GT(twins.alone->balance().eroded_elements, 3);
      EXPECT_LT(twins.alone->balance().eroded_elements, 48);
    }
  }
}

template <int dim>
std::vector<double> state_of(Solver<dim> &solver)
{
  solver.refresh_all();
  std::vector<double> all;
  const auto          s = solver.surface();
  for (int i = 0; i < dim; ++i)
  {
    all.insert(all.end(), s.x[i].begin(), s.x[i].end());
    all.insert(all.end(), s.v[i].begin(), s.v[i].end());
  }
  const Balance b = solver.balance();
  all.insert(all.end(),
             {b.kinetic, b.elastic, b.plastic_work, b.bulk_viscosity_heat, b.hourglass_fem, b.eroded_energy});
  return all;
}

/// The same run twice, to the bit, with deaths and changes of hands.
TEST(RankedChanges, TheSameEveryTime)
{
  std::vector<double> states[2];
  for (auto &state : states)
  {
    Twins<2> twins(passing(true), restless());
    twins.steps(90);
    state = state_of(*twins.together);
  }
  EXPECT_EQ(states[0], states[1]);
}

/// A checkpoint says that more ranks wrote it than did: the last had nothing.
class OneMoreRank final : public ArchiveReader
{
public:
  explicit OneMoreRank(const io::MemoryArchive &archive) : archive_(archive) {}
  std::vector<double>       doubles(const std::string &name) const override { return archive_.doubles(name); }
  std::vector<std::int64_t> integers(const std::string &name) const override
  {
    auto values = archive_.integers(name);
    if (name == "fem/ranks")
      ++values.at(0);
    return values;
  }

private:
  const io::MemoryArchive &archive_;
};

TEST(RankedChanges, Checkpoints)
{
  Twins<2> twins(passing(true), restless());
  twins.steps(70);
  io::MemoryArchive by_one, by_all;
  twins.alone->save(by_one, "fem");
  twins.together->save(by_all, "fem");
  const auto go_on = [&](const ArchiveReader &archive, bool on_ranks)
  {
    Parameters p = restless();
    if (on_ranks)
      p.ranks = twins.ranks;
    auto solver = solver_with<2>(passing(true), p);
    solver->load(archive, "fem");
    const double dt = .9 * twins.last;
    for (int k = 0; k < 40; ++k)
      EXPECT_TRUE(solver->step({twins.time + k * dt, k == 0 ? .5 * (twins.last + dt) : dt, dt}).ok);
    return state_of(*solver);
  };
  const auto alone = go_on(by_one, false);
  // The same number of ranks goes on to the bit.
  {
    const double dt = .9 * twins.last;
    for (int k = 0; k < 40; ++k)
      ASSERT_TRUE(twins.together->step({twins.time + k * dt, k == 0 ? .5 * (twins.last + dt) : dt, dt}).ok);
    EXPECT_EQ(state_of(*twins.together), go_on(by_all, true));
  }
  double scale = 0;
  for (const double x : alone)
    scale = std::max(scale, std::abs(x));
  for (const auto &other : {go_on(by_one, true), go_on(by_all, false), go_on(OneMoreRank(by_all), true)})
  {
    ASSERT_EQ(other.size(), alone.size());
    for (std::size_t k = 0; k < alone.size(); ++k)
      ASSERT_NEAR(other[k], alone[k], 1e-9 * scale);
  }
}

TEST(RankedChanges, ClassesOfStepsAreRefused)
{
  Parameters p;
  p.ranks               = Ranks::world();
  p.options.local_steps = "4";
  if (!p.ranks.alone())
  {
    EXPECT_THROW(solver_with<2>(block<2>({0, 0, 0}, {4 * H, 3 * H, 0}, H), p), InputError);
  }
}

/// One rank's element turns inside out: all ranks say so, and say which.
TEST(RankedChanges, OneFailureIsEveryones)
{
  auto mesh = block<2>({0, 0, 0}, {6 * H, 5 * H, 0}, H);
  for (std::size_t a = 0; a < mesh.n_nodes(); ++a)
    if (std::abs(mesh.x[0][a] - 6 * H) < 1e-9 && std::abs(mesh.x[1][a] - 5 * H) < 1e-9)
      mesh.v[0][a] = mesh.v[1][a] = -1e5;
  Twins<2>     twins({mesh});
  const double dt = 1.5 * H / 1e5;
  twins.together->snapshot();
  const StepStatus a = twins.alone->step({0, .5 * dt, dt}), b = twins.together->step({0, .5 * dt, dt});
  EXPECT_FALSE(a.ok);
  ASSERT_FALSE(b.ok);
  EXPECT_EQ(a.culprit.id, b.culprit.id);
  EXPECT_STREQ(a.culprit.entity, b.culprit.entity);
  EXPECT_STREQ(a.culprit.why, b.culprit.why);
  EXPECT_LE((a.culprit.where - b.culprit.where).norm(), 1e-9 * twins.extent);
  twins.together->restore();
  EXPECT_TRUE(twins.together->step({0, 1e-12, 2e-12}).ok);
}
} // namespace
