// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/coupler.h"
#include "coupling/interface.h"

#include "core/base/error.h"
#include "hand_made.h"

#include <gtest/gtest.h>

#include <random>

namespace ogive::coupling
{
namespace
{
using hand_made::Arrays;

constexpr double h = .004, dx = .002, dt = 2.3e-7;

/// One layer of elements of edge `size` in the tilted frame, below the plane
/// where the last local coordinate is 0, `n` of them each other way.
template <int dim>
struct HandMesh : MeshPort<dim>
{
  Arrays<dim>                                                     &arrays;
  double                                                           size;
  Eigen::Matrix<double, dim, dim>                                  turn = hand_made::tilt<dim>();
  std::vector<std::array<std::uint32_t, Embedding<dim>::n_nodes>>  element;
  std::vector<Point<dim>>                                          lower; // local, of each element

  HandMesh(Arrays<dim> &to, double edge, int n) : arrays(to), size(edge)
  {
    std::map<std::array<int, 3>, std::uint32_t> nodes;
    const auto node = [&](const std::array<int, 3> &at) {
      const auto found = nodes.find(at);
      if (found != nodes.end())
        return found->second;
      Point<dim> p;
      for (int a = 0; a < dim; ++a)
        p[a] = size * (a == dim - 1 ? at[a] - 1 : at[a]);
      return nodes[at] = arrays.add(turn * p, Point<dim>::Zero(), 7800 * std::pow(size, dim), 1);
    };
    const int nx = dim > 1 ? n : 1, ny = dim > 2 ? n : 1;
    for (int i = 0; i < nx; ++i)
      for (int j = 0; j < ny; ++j)
      {
        std::array<int, 3> first{};
        if (dim > 1)
          first[0] = i;
        if (dim > 2)
          first[1] = j;
        auto &e = element.emplace_back();
        for (int k = 0; k < (1 << dim); ++k)
        {
          auto at = first;
          for (int a = 0; a < dim; ++a)
            at[a] += (k >> a) & 1;
          e[k] = node(at);
        }
        Point<dim> low;
        for (int a = 0; a < dim; ++a)
          low[a] = size * (a == dim - 1 ? -1 : first[a]);
        lower.push_back(low);
        add_top_facet(e, static_cast<std::uint32_t>(element.size() - 1));
      }
  }

  void add_top_facet(const std::array<std::uint32_t, Embedding<dim>::n_nodes> &e, std::uint32_t index)
  {
    typename Surface<dim>::Facet facet;
    facet.body    = 1;
    facet.element = index;
    if constexpr (dim == 1)
      facet.node = {e[1]};
    else if constexpr (dim == 2)
      facet.node = {e[3], e[2]}; // from right to left: above is on the right
    else
      facet.node = {e[4], e[5], e[7], e[6]};
    arrays.facets.push_back(facet);
  }

  Surface<dim> surface() override { return arrays.surface(); }
  StepLimit    stable_dt() const override { return {dt, {}}; }
  void         add_mass(std::uint32_t node, double mass) override { arrays.mass[node] += mass; }
  bool embed(std::uint32_t e, const std::array<double, dim> &point, double reach,
             Embedding<dim> &result) const override
  {
    const Point<dim> local = turn.transpose() * Eigen::Map<const Point<dim>>(point.data());
    for (int k = 0; k < (1 << dim); ++k)
    {
      result.node[k]   = element[e][k];
      result.weight[k] = 1;
      for (int a = 0; a < dim; ++a)
      {
        const double xi = 2 * (local[a] - lower[e][a]) / size - 1;
        if (std::abs(xi) > 1 + reach)
          return false;
        result.weight[k] *= .5 * ((k >> a) & 1 ? 1 + xi : 1 - xi);
      }
    }
    return true;
  }
};

template <int dim>
struct HandParticles : ParticlePort<dim>
{
  Arrays<dim>                         &arrays;
  std::vector<std::uint32_t>           index;
  std::vector<std::int64_t>            slaves;
  std::array<std::vector<double>, dim> internal; // forces by id

  explicit HandParticles(Arrays<dim> &of) : arrays(of) {}
  Surface<dim> surface() override { return arrays.surface(); }
  StepLimit    stable_dt() const override { return {dt, {}}; }
  void set_slaves(std::span<const std::int64_t> ids) override { slaves.assign(ids.begin(), ids.end()); }
  void drive_slaves(const std::array<std::span<const double>, dim> &v) override
  {
    for (int a = 0; a < dim; ++a)
      for (std::size_t s = 0; s < slaves.size(); ++s)
        arrays.v[a][slaves[s]] = v[a][s];
  }
  void slave_forces(const std::array<std::span<double>, dim> &force) const override
  {
    for (int a = 0; a < dim; ++a)
      for (std::size_t s = 0; s < slaves.size(); ++s)
        force[a][s] = internal[a][slaves[s]] + arrays.f[a][slaves[s]];
  }
  std::span<const std::uint32_t> index_of_id() const override { return index; }
};

/// A block of particles three layers high on the mesh, its lowest layer
/// `gap` above the plane.
template <int dim>
struct Seam
{
  Arrays<dim>                   mesh, cloud;
  std::unique_ptr<Coupler<dim>> coupler;
  HandParticles<dim>           *particles = nullptr;
  std::size_t                   layer     = 0; ///< particles a layer
  double                        mesh_mass_before = 0;

  explicit Seam(double gap = .5 * dx, double edge = h, const std::string &method = "tied",
                double wobble = 0)
  {
    const int n         = dim == 1 ? 1 : 3;
    auto      mesh_port = std::make_unique<HandMesh<dim>>(mesh, edge, n);
    const auto turn     = mesh_port->turn;
    std::mt19937                           random(5);
    std::uniform_real_distribution<double> u(-wobble, wobble);
    const int across = dim == 1 ? 1 : static_cast<int>(n * edge / dx + .5);
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < across; ++i)
        for (int j = 0; j < (dim > 2 ? across : 1); ++j)
        {
          Point<dim> p;
          for (int a = 0; a < dim; ++a)
            p[a] = (a == dim - 1 ? gap + k * dx : (a == 0 ? i + .5 : j + .5) * dx) + u(random);
          cloud.add(turn * p, Point<dim>::Zero(), 2700 * std::pow(dx, dim), 0, .5 * dx);
          layer += k == 0;
        }
    auto particle_port = std::make_unique<HandParticles<dim>>(cloud);
    particles          = particle_port.get();
    for (std::uint32_t i = 0; i < cloud.id.size(); ++i)
      particles->index.push_back(i);
    for (auto &component : particles->internal)
      component.assign(cloud.id.size(), 0);
    for (const double m : mesh.mass)
      mesh_mass_before += m;

    input::Scene scene;
    scene.bodies.resize(2);
    scene.bodies[0].name   = "zone";
    scene.bodies[0].method = input::Method::sph;
    scene.bodies[1].name   = "frame";
    scene.interfaces.push_back({"seam", method, "zone", "frame"});
    coupler = std::make_unique<Coupler<dim>>(scene, std::move(mesh_port), std::move(particle_port));
  }
};

template <int dim>
void affine_motion()
{
  Seam<dim> seam(.5 * dx, h, "tied", .1 * dx);
  ASSERT_EQ(seam.coupler->tied_particles(), seam.layer);

  Eigen::Matrix<double, dim, dim> gradient;
  Point<dim>                      shift;
  for (int a = 0; a < dim; ++a)
  {
    shift[a] = 31. - 17 * a;
    for (int b = 0; b < dim; ++b)
      gradient(a, b) = 900. * (a + 1) - 1400. * b + 333;
  }
  for (std::size_t i = 0; i < seam.mesh.mass.size(); ++i)
  {
    const Point<dim> v = shift + gradient * seam.mesh.at(seam.mesh.x, i);
    for (int a = 0; a < dim; ++a)
      seam.mesh.v[a][i] = v[a];
  }
  seam.coupler->drive();
  for (std::size_t s = 0; s < seam.layer; ++s)
  {
    const Point<dim> exact = shift + gradient * seam.cloud.at(seam.cloud.x, s);
    EXPECT_LE((seam.cloud.at(seam.cloud.v, s) - exact).norm(), 1e-13 * shift.norm()) << s;
  }
  EXPECT_EQ(seam.cloud.at(seam.cloud.v, seam.layer), Point<dim>(Point<dim>::Zero())); // not tied
}

template <int dim>
Vec3 moment(const Arrays<dim> &arrays, const std::array<std::vector<double>, dim> &force)
{
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < arrays.mass.size(); ++i)
  {
    Vec3 x = Vec3::Zero(), f = Vec3::Zero();
    x.template head<dim>() = arrays.at(arrays.x, i);
    f.template head<dim>() = arrays.at(force, i);
    sum += x.cross(f);
  }
  return sum;
}

template <int dim>
void transposed_forces()
{
  Seam<dim>                              seam(.5 * dx, h, "tied", .1 * dx);
  std::mt19937                           random(8);
  std::uniform_real_distribution<double> u(-4e3, 4e3);
  std::array<std::vector<double>, dim>   slave_force = seam.particles->internal;
  Point<dim>                             sum         = Point<dim>::Zero();
  double                                 scale       = 0;
  for (std::size_t s = 0; s < seam.layer; ++s)
    for (int a = 0; a < dim; ++a)
    {
      slave_force[a][s] = u(random);
      sum[a] += slave_force[a][s];
      scale += std::abs(slave_force[a][s]);
    }
  seam.particles->internal = slave_force;
  seam.coupler->gather();
  Point<dim> passed = Point<dim>::Zero();
  for (std::size_t i = 0; i < seam.mesh.mass.size(); ++i)
    passed += seam.mesh.at(seam.mesh.f, i);
  EXPECT_LE((passed - sum).norm(), 1e-14 * scale);
  EXPECT_LE((moment<dim>(seam.mesh, seam.mesh.f) - moment<dim>(seam.cloud, slave_force)).norm(),
            1e-14 * scale * 5 * h);

  double mass = 0, given = 0;
  for (std::size_t i = 0; i < seam.mesh.mass.size(); ++i)
  {
    mass += seam.mesh.mass[i];
    EXPECT_GT(seam.mesh.mass[i], 0);
  }
  for (std::size_t s = 0; s < seam.layer; ++s)
    given += seam.cloud.mass[s];
  EXPECT_NEAR(mass, seam.mesh_mass_before + given, 1e-14 * mass);
}

/// Springs between the tied and the free particles, the nodes free: the seam
/// neither makes nor loses energy.
template <int dim>
void closed_energy()
{
  Seam<dim> seam;
  for (std::size_t i = 0; i < seam.mesh.mass.size(); ++i)
    for (int a = 0; a < dim; ++a)
      seam.mesh.v[a][i] = 3. + 40 * seam.mesh.x[dim - 1 - a][i] / h;
  seam.coupler->drive();
  const auto   rest = seam.cloud.x;
  const double k    = .05 * 2700 * std::pow(dx, dim) / (dt * dt);
  const auto   kinetic = [&] {
    double sum = seam.mesh.kinetic();
    for (std::size_t i = seam.layer; i < seam.cloud.mass.size(); ++i)
      sum += .5 * seam.cloud.mass[i] * seam.cloud.at(seam.cloud.v, i).squaredNorm();
    return sum;
  };
  const double start    = kinetic();
  double       internal = 0, turned_over = 0;
  for (int n = 0; n < 400; ++n)
  {
    seam.coupler->gather();
    const auto force = [&](std::size_t s, std::size_t p, int a) {
      return k * ((seam.cloud.x[a][p] - seam.cloud.x[a][s]) - (rest[a][p] - rest[a][s]));
    };
    for (std::size_t s = 0; s < seam.layer; ++s)
      for (int a = 0; a < dim; ++a)
      {
        seam.particles->internal[a][s] = force(s, s + seam.layer, a);
        seam.cloud.f[a][s + seam.layer] = -seam.particles->internal[a][s];
      }
    seam.mesh.f = {};
    for (auto &component : seam.mesh.f)
      component.assign(seam.mesh.mass.size(), 0);
    auto before = seam.cloud.v;
    auto keep   = seam.cloud.f;
    seam.coupler->gather(); // clears the particles' forces
    seam.cloud.f = keep;
    seam.mesh.kick_and_drift(dt, Point<dim>::Zero());
    seam.coupler->drive();
    // Slaves move with what they were given; the free ones are kicked.
    for (std::size_t i = 0; i < seam.cloud.mass.size(); ++i)
      for (int a = 0; a < dim; ++a)
      {
        if (i >= seam.layer)
          seam.cloud.v[a][i] += dt * keep[a][i] / seam.cloud.mass[i];
        const double f    = i < seam.layer ? seam.particles->internal[a][i] : keep[a][i];
        const double work = .5 * dt * f * (seam.cloud.v[a][i] + before[a][i]);
        internal -= work; // compatible energy of the springs
        turned_over += std::abs(work);
      }
    for (int a = 0; a < dim; ++a)
      for (std::size_t i = 0; i < seam.cloud.mass.size(); ++i)
        seam.cloud.x[a][i] += dt * seam.cloud.v[a][i];
    seam.coupler->close({n * dt, dt, dt});
    ASSERT_NEAR(kinetic() + internal, start, 1e-13 * (start + turned_over)) << n;
  }
  const auto balance = seam.coupler->balance();
  EXPECT_GT(turned_over, .01 * start);
  EXPECT_GT(std::abs(balance.work_on_mesh), 1e-4 * start);
  EXPECT_LE(std::abs(balance.interface_work), 1e-14 * (start + turned_over));
  EXPECT_DOUBLE_EQ(balance.work_on_particles + balance.work_on_mesh, balance.interface_work);
}
} // namespace

TEST(Tied, PassesAffineMotionExactly)
{
  affine_motion<1>();
  affine_motion<2>();
  affine_motion<3>();
}

TEST(Tied, PassesForceAndMomentExactlyAndItsMass)
{
  transposed_forces<1>();
  transposed_forces<2>();
  transposed_forces<3>();
}

TEST(Tied, NeitherMakesNorLosesEnergy)
{
  closed_energy<1>();
  closed_energy<2>();
  closed_energy<3>();
}

TEST(Tied, NoParticleAtTheSeamNamesBodiesAndDistance)
{
  try
  {
    Seam<3> seam(1.25 * dx);
    FAIL() << "accepted";
  }
  catch (const InputError &error)
  {
    const std::string text = error.what();
    for (const char *word : {"seam", "zone", "frame", "0.0025 m"})
      EXPECT_NE(text.find(word), std::string::npos) << text;
  }
}

// Particles far larger than the elements lean on them: weights 1 + t, -t.
TEST(Tied, NodeLeftWithoutMassIsAnInputError)
{
  EXPECT_THROW(Seam<1>(.9 * dx, .1 * dx), InputError);
}

TEST(Tied, UnknownMethodNamesTheKnownOnes)
{
  try
  {
    Seam<2> seam(.5 * dx, h, "glued");
    FAIL() << "accepted";
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("tied"), std::string::npos);
  }
  EXPECT_EQ(interface_methods(), (std::vector<std::string>{"tied", "pair-flux", "blended"}));
}

TEST(Tied, CheckpointKeepsWeightsAndWork)
{
  Seam<2>                  seam, again(.6 * dx);
  hand_made::MemoryArchive archive;
  for (auto &f : seam.particles->internal[1])
    f = 77;
  for (auto &v : seam.mesh.v[1])
    v = 4;
  seam.coupler->gather();
  seam.coupler->drive();
  seam.coupler->close({0, dt, dt});
  seam.coupler->save(archive, "coupling");
  again.coupler->load(archive, "coupling");
  EXPECT_NE(seam.coupler->balance().work_on_mesh, 0);
  EXPECT_EQ(again.coupler->balance().work_on_mesh, seam.coupler->balance().work_on_mesh);
  for (std::size_t i = 0; i < seam.mesh.mass.size(); ++i)
    seam.mesh.v[0][i] = again.mesh.v[0][i] = std::sin(1. + i);
  again.mesh.v[1] = seam.mesh.v[1];
  seam.coupler->drive();
  again.coupler->drive();
  EXPECT_EQ(again.cloud.v[0], seam.cloud.v[0]);
  EXPECT_THROW(Seam<2>(.5 * dx, 2 * h).coupler->load(archive, "coupling"), InputError);
}

TEST(Coupler, NamesWhatIsWrongInTheScene)
{
  input::Scene scene;
  scene.bodies.resize(2);
  scene.bodies[0].name = "a";
  scene.bodies[1].name = "b";
  const auto refused   = [&](const input::Contact &contact) {
    auto wrong = scene;
    wrong.contacts.push_back(contact);
    EXPECT_THROW(Coupler<2>(wrong, nullptr, std::unique_ptr<ParticlePort<2>>()), InputError);
  };
  refused({"c", "a", "missing", 0, .1});
  refused({"c", "a", "b", -.1, .1});
  refused({"c", "a", "b", 0, .2});
  refused({"c", "a", "b", 0, 0});
  auto wrong = scene;
  wrong.interfaces.push_back({"i", "tied", "a", "b"}); // both meshes
  EXPECT_THROW(Coupler<2>(wrong, nullptr, std::unique_ptr<ParticlePort<2>>()), InputError);
}
} // namespace ogive::coupling
