// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/common_particles.h"
#include "coupling/coupler.h"

#include "hand_made.h"

#include <gtest/gtest.h>

/// Contact whose particles several ranks share, against the same on one process:
/// what a rank owns changes as it goes. Contacts are found point by point and summed
/// in the order of ids, so both must agree to the bit.
namespace ogive::coupling
{
namespace
{
using hand_made::Arrays;

constexpr double dt = 2e-7, dx = .002;

struct Mesh : MeshPort<3>
{
  Arrays<3> &arrays;
  explicit Mesh(Arrays<3> &of) : arrays(of) {}
  Surface<3> surface() override { return arrays.surface(); }
  StepLimit  stable_dt() const override { return {dt, {}}; }
  void       add_mass(std::uint32_t, double) override {}
  bool       embed(std::uint32_t, const std::array<double, 3> &, double, Embedding<3> &) const override { return false; }
};

struct Cloud : ParticlePort<3>
{
  Arrays<3>                 &arrays;
  std::vector<std::uint32_t> index;
  explicit Cloud(Arrays<3> &of) : arrays(of) {}
  Surface<3> surface() override { return arrays.surface(); }
  StepLimit  stable_dt() const override { return {dt, {}}; }
  void       set_slaves(std::span<const std::int64_t>) override {}
  void       drive_slaves(const std::array<std::span<const double>, 3> &) override {}
  void       slave_forces(const std::array<std::span<double>, 3> &) const override {}
  std::span<const std::uint32_t> index_of_id() const override { return index; }
  void seam_forces(int, const std::array<std::span<double>, 3> &force) const override
  {
    for (std::size_t i = 0; i < arrays.id.size(); ++i)
      force[1][i] = 3. + static_cast<double>(arrays.id[i]);
  }
  void renew_index()
  {
    index.resize(arrays.id.size());
    for (std::uint32_t i = 0; i < index.size(); ++i)
      index[static_cast<std::size_t>(arrays.id[i])] = i;
  }
};

/// Two blocks of particles that fly at each other and at an angle past each other,
/// and two boxes of facets, one from the side at both, one at the other box.
struct Bodies
{
  Arrays<3> mesh, cloud;

  Bodies()
  {
    for (int body = 0; body < 2; ++body)
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 5; ++j)
          for (int k = 0; k < 4; ++k)
            cloud.add(dx * Point<3>(i + .3 * body, j + .4 * body, k + body * 4.05),
                      body == 0 ? Point<3>(5, 3, 60) : Point<3>(-7, 2, -75), 2.2e-5, body, .5 * dx);
    for (int body = 2; body < 4; ++body)
    {
      const std::size_t first = mesh.mass.size();
      hand_made::add_box(mesh, {.004, .005, .006}, 4, 8e-3, body);
      const Point<3> middle = dx * (body == 2 ? Point<3>(-2.6, 2.1, 3.7) : Point<3>(-6.7, 2.3, 3.9));
      for (std::size_t i = first; i < mesh.mass.size(); ++i)
        for (int a = 0; a < 3; ++a)
        {
          mesh.x[a][i] += middle[a];
          mesh.v[a][i] = a == 0 ? (body == 2 ? 40. : 90.) : 4. * a;
        }
    }
  }

  static input::Scene scene()
  {
    input::Scene scene;
    const char  *names[] = {"a", "b", "c", "d"};
    for (int k = 0; k < 4; ++k)
    {
      input::Body body;
      body.name    = names[k];
      body.method  = k < 2 ? input::Method::sph : input::Method::fem;
      body.spacing = dx;
      scene.bodies.push_back(body);
    }
    const auto add = [&](const char *first, const char *second, double friction) {
      input::Contact contact;
      contact.name      = std::string(first) + second;
      contact.first     = first;
      contact.second    = second;
      contact.friction  = friction;
      contact.stiffness = .05;
      scene.contacts.push_back(contact);
    };
    add("a", "b", .2);
    add("c", "a", .1);
    add("b", "c", .3);
    add("c", "d", .2);
    return scene;
  }
};

/// The particles that a rank owns in the given epoch, in an order of its own.
Arrays<3> part(const Arrays<3> &all, const Ranks &ranks, int epoch)
{
  Arrays<3> own;
  for (std::size_t n = 0; n < all.id.size(); ++n)
  {
    const std::size_t i = (n * 7 + static_cast<std::size_t>(epoch)) % all.id.size();
    if ((static_cast<int>(i / 3) + epoch) % ranks.size() != ranks.rank())
      continue;
    own.add(all.at(all.x, i), all.at(all.v, i), all.mass[i], all.body[i], all.radius[i]);
    own.id.back() = all.id[i];
  }
  own.topology = all.topology + static_cast<std::uint64_t>(epoch);
  return own;
}

/// What all ranks own, by id.
Arrays<3> whole(const Arrays<3> &own, const Ranks &ranks, const Arrays<3> &like)
{
  struct One
  {
    std::int64_t          id;
    std::array<double, 3> x, v;
  };
  std::vector<One> mine;
  for (std::size_t i = 0; i < own.id.size(); ++i)
    mine.push_back({own.id[i], {own.x[0][i], own.x[1][i], own.x[2][i]}, {own.v[0][i], own.v[1][i], own.v[2][i]}});
  Arrays<3>   all   = like;
  std::size_t count = 0;
  for (const One &one : ranks.gather(mine))
  {
    ++count;
    for (int a = 0; a < 3; ++a)
    {
      all.x[a][static_cast<std::size_t>(one.id)] = one.x[a];
      all.v[a][static_cast<std::size_t>(one.id)] = one.v[a];
    }
  }
  EXPECT_EQ(count, like.id.size());
  return all;
}

TEST(SharedContact, MovesAllBodiesAsOneProcessDoes)
{
  const Ranks ranks = Ranks::world();
  ASSERT_FALSE(ranks.alone());
  Bodies alone, shared;
  shared.cloud    = part(alone.cloud, ranks, 0);
  const auto cloud = alone.cloud;
  auto       port  = std::make_unique<Cloud>(alone.cloud);
  port->renew_index();
  Coupler<3> one(Bodies::scene(), std::make_unique<Mesh>(alone.mesh), std::move(port));
  Coupler<3> many(Bodies::scene(), std::make_unique<Mesh>(shared.mesh), std::make_unique<Cloud>(shared.cloud), ranks);
  int         epoch = 0;
  bool        touched[4][4] = {};
  for (int step = 0; step < 160; ++step)
  {
    for (auto *coupler : {&one, &many})
      coupler->gather();
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < a; ++b)
      {
        ASSERT_EQ(many.contact_force(a, b), one.contact_force(a, b)) << step << " " << a << " " << b;
        touched[a][b] |= one.contact_force(a, b).norm() > 0;
      }
    ASSERT_EQ(one.active_contacts(), many.active_contacts()) << step;
    for (auto *bodies : {&alone, &shared})
    {
      bodies->mesh.kick_and_drift(dt, Point<3>::Zero());
      bodies->cloud.kick_and_drift(dt, Point<3>::Zero());
    }
    // Particles change their ranks between the step and its books, too.
    if (step % 17 == 16)
      shared.cloud = part(whole(shared.cloud, ranks, cloud), ranks, ++epoch);
    for (auto *coupler : {&one, &many})
      coupler->close({step * dt, dt, dt});
  }
  EXPECT_TRUE(touched[1][0] && touched[2][0] && touched[2][1] && touched[3][2]);
  const auto all = whole(shared.cloud, ranks, cloud);
  EXPECT_EQ(all.x, alone.cloud.x);
  EXPECT_EQ(all.v, alone.cloud.v);
  EXPECT_EQ(shared.mesh.x, alone.mesh.x);
  EXPECT_EQ(shared.mesh.v, alone.mesh.v);
  EXPECT_EQ(many.balance().contact_taken, one.balance().contact_taken);
  EXPECT_EQ(many.balance().friction_heat, one.balance().friction_heat);
  EXPECT_GT(one.balance().friction_heat, 0);
  EXPECT_EQ(many.stable_dt().dt, one.stable_dt().dt);
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < a; ++b)
      EXPECT_EQ(many.contact_force(a, b), one.contact_force(a, b));
}

TEST(CommonParticles, AreThoseWithinReachAndAllSlaves)
{
  const Ranks ranks = Ranks::world();
  // A row of particles and a box at one end of it.
  Arrays<3> row, mesh;
  for (int i = 0; i < 400; ++i)
    row.add(dx * Point<3>(i, 0, 0), Point<3>(i, 1, 0), 1, 0, .5 * dx);
  hand_made::add_box(mesh, {dx, dx, dx}, 2, 1, 1);
  const double reach = 3.3 * dx;
  Arrays<3>    own   = part(row, ranks, 0);
  CommonParticles<3> common(ranks, std::make_unique<Cloud>(own));
  common.meet(mesh.surface());
  EXPECT_EQ(common.size(), 400u); // at the start
  const std::vector<std::int64_t> slaves{311};
  common.set_slaves(slaves);
  common.attend({{0, 1, mesh_party, reach}});
  for (int step = 0; step < 60; ++step)
  {
    for (auto &x : mesh.x[0])
      x += .4 * dx;
    if (step % 7 == 3)
    {
      own = part(row, ranks, step);
      own.topology += static_cast<std::uint64_t>(step);
    }
    common.meet(mesh.surface());
    const auto   s      = common.surface();
    const double middle = (step + 1) * .4 * dx;
    // Wanted: within reach of a face of the box. Not wanted: far beyond the slack.
    for (std::int64_t id = 0; id < 400; ++id)
    {
      const double gap = std::abs(static_cast<double>(id) * dx - middle) - dx;
      const bool   in  = std::find(s.id.begin(), s.id.end(), id) != s.id.end();
      const bool   must = gap <= reach || id == 311;
      if (must || gap > 4 * reach)
      {
        EXPECT_EQ(in, must) << step << " " << id;
      }
    }
    EXPECT_TRUE(std::is_sorted(s.id.begin(), s.id.end()));
    for (std::size_t k = 0; k < s.n; ++k)
    {
      EXPECT_EQ(s.x[0][k], dx * static_cast<double>(s.id[k]));
      EXPECT_EQ(common.index_of_id()[static_cast<std::size_t>(s.id[k])], k);
    }
  }
  EXPECT_LT(common.settled(), 61u); // in some steps all was as before
}

TEST(CommonParticles, TellSeamForcesToAllAndTakeContactForcesHome)
{
  const Ranks ranks = Ranks::world();
  Arrays<3>   row, mesh;
  for (int i = 0; i < 23; ++i)
    row.add(dx * Point<3>(i, 0, 0), Point<3>::Zero(), 1, 0, .5 * dx);
  Arrays<3>          own = part(row, ranks, 2);
  CommonParticles<3> common(ranks, std::make_unique<Cloud>(own));
  common.meet(mesh.surface());
  auto s = common.surface();
  ASSERT_EQ(s.n, 23u);
  std::array<std::vector<double>, 3> sums;
  std::array<std::span<double>, 3>   view;
  for (int a = 0; a < 3; ++a)
  {
    sums[a].assign(s.n, 0.);
    view[a] = sums[a];
  }
  common.seam_forces(0, view);
  for (std::size_t k = 0; k < s.n; ++k)
  {
    EXPECT_EQ(sums[1][k], 3. + static_cast<double>(s.id[k]));
    s.force[2][k] = 10. * static_cast<double>(s.id[k]);
  }
  common.give_forces();
  for (std::size_t i = 0; i < own.id.size(); ++i)
    EXPECT_EQ(own.f[2][i], 10. * static_cast<double>(own.id[i]));
}
} // namespace
} // namespace ogive::coupling
