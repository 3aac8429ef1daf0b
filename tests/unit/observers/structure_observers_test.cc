// SPDX-License-Identifier: LGPL-2.1-or-later
// Observers of structures on made-up states whose answers are known in closed
// form.
#include "core/io/memory_archive.h"
#include "coupling/observers/observer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace ogive::coupling
{
namespace
{
constexpr double pi = std::numbers::pi;

void add(Sample &s, const Vec3 &x0, const Vec3 &x, double mass, double radius)
{
  for (int a = 0; a < 3; ++a)
  {
    s.x0[a].push_back(x0[a]);
    s.x[a].push_back(x[a]);
    s.v[a].push_back(0);
  }
  s.mass.push_back(mass);
  s.radius.push_back(radius);
  s.id.push_back(static_cast<std::int64_t>(s.id.size()));
}

/// A lattice of nx x ny particles, moved by `motion`.
Sample lattice(int nx, int ny, double dx, const std::function<Vec3(const Vec3 &)> &motion)
{
  Sample s;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
    {
      const Vec3 x0((i + .5) * dx, (j + .5) * dx, 0);
      add(s, x0, motion(x0), 2 * dx * dx, .5 * dx);
    }
  return s;
}

input::Scene scene_with(const input::Shape &shape, double spacing, input::Dimension dimension)
{
  input::Scene scene;
  scene.dimension = dimension;
  input::Body body;
  body.name    = "it";
  body.shape   = shape;
  body.spacing = spacing;
  scene.bodies.push_back(body);
  return scene;
}

struct Watch
{
  input::Scene              scene = scene_with({}, 1, input::Dimension::plane_strain);
  input::Observer           observer;
  std::unique_ptr<Observer> made;

  explicit Watch(const std::string &quantity)
  {
    observer.name = observer.quantity = quantity;
    observer.body                     = "it";
  }

  void row(double time, const Sample &s)
  {
    if (!made)
      made = make_observer(observer, scene);
    RowFrame frame;
    frame.time   = time;
    frame.sample = [&](int) -> const Sample & { return s; };
    made->row(frame);
  }

  /// Written to a checkpoint and read into a fresh observer.
  void restart()
  {
    io::MemoryArchive archive;
    made->save(archive, "here");
    made = make_observer(observer, scene);
    made->load(archive, "here");
  }

  double value() const { return made->value(); }
};

/// One particle at (3, 0, 0) that swings along y.
Sample swinging(double y)
{
  Sample s;
  add(s, {3, 0, 0}, {3, y, 0}, 1, .5);
  return s;
}
} // namespace

// y = a exp(-k t) sin(2 pi t/T): passages of zero at multiples of T/2 whatever
// the decay; the peaks of whole periods fall by exp(-k T).
TEST(StructureObservers, PeriodAndLossOfADampedSine)
{
  const double period = .7, decay = .3, dt = .001;
  Watch        t("period"), loss("amplitude_loss");
  for (Watch *w : {&t, &loss})
    w->observer.direction = {0, 1, 0};
  for (int k = 0; k * dt < 2.6; ++k)
  {
    const double y = .2 * std::exp(-decay * k * dt) * std::sin(2 * pi * k * dt / period);
    for (Watch *w : {&t, &loss})
    {
      w->row(k * dt, swinging(y));
      if (k == 1200) // inside the second period
        w->restart();
    }
    if (k * dt < .69)
    {
      EXPECT_TRUE(std::isnan(t.value()));
    }
  }
  EXPECT_NEAR(t.value(), period, 1e-5 * period); // passages are interpolated: rows alone give .001
  EXPECT_NEAR(loss.value(), 1 - std::exp(-decay * 2 * period), 1e-4);
}

// w = W (1 + e cos) after its greatest value at t = 1: the mean over a whole
// number of periods is W.
TEST(StructureObservers, DeflectionSettlesToTheMeanOfItsRinging)
{
  Watch set("tip_deflection"), over("mid_deflection"), most("greatest_deflection");
  for (Watch *w : {&set, &over, &most})
    w->observer.direction = {0, -1, 0};
  over.observer.parameter = .25;
  for (int k = 0; k <= 500; ++k)
  {
    const double t = .01 * k, w = t < 1 ? 1.1 * t : 1 + .1 * std::cos(2 * pi * (t - 1));
    for (Watch *o : {&set, &over, &most})
    {
      o->row(t, swinging(-w));
      if (k == 250)
        o->restart();
    }
    if (k == 50)
    {
      EXPECT_DOUBLE_EQ(set.value(), .55); // still growing: the present value
    }
  }
  EXPECT_NEAR(set.value(), 1, 1e-3); // 201 rows hold one row more than two periods
  EXPECT_NEAR(over.value(), 4, 4e-3);
  EXPECT_NEAR(most.value(), 1.1, 1e-12);
}

// The end of a lattice is turned by .3 rad and moved, the rest stays.
TEST(StructureObservers, RotationOfAnEnd)
{
  Watch w("tip_rotation");
  w.observer.point     = {10, 1, 0};
  w.observer.parameter = 2.5;
  const double c = std::cos(.3), s = std::sin(.3);
  w.row(0, lattice(10, 2, 1,
                   [&](const Vec3 &x)
                   {
                     const Vec3 d = x - Vec3(10, 1, 0);
                     return x.x() > 7 ? Vec3(11 + c * d.x() + s * d.y(), 3 - s * d.x() + c * d.y(), 0) : x;
                   }));
  EXPECT_NEAR(w.value(), .3, 1e-14);
}

namespace
{
/// A ring or shell of two layers of points, mapped without change of volume so
/// that its inner radius r0 becomes r0 times `squeeze`.
Sample collapsed(int n, double r0, double dx, double squeeze)
{
  Sample s;
  for (int layer = 0; layer < 2; ++layer)
    for (int i = 0; i < 40; ++i)
      for (int j = 0; j < (n == 3 ? 20 : 1); ++j)
      {
        const double from = r0 + (layer + .5) * dx, turn = 2 * pi * i / 40, z = n == 3 ? -.95 + .1 * j : 0;
        const double to   = std::pow(std::pow(from, n) - std::pow(r0, n) + std::pow(squeeze * r0, n), 1. / n);
        const double flat = std::sqrt(1 - z * z);
        const Vec3   e(flat * std::cos(turn), flat * std::sin(turn), z), base(1, 2, 0);
        add(s, base + from * e, base + to * e, 1, .5 * dx);
      }
  return s;
}

input::Scene hollow(int n)
{
  input::Shape shape;
  shape.kind         = n == 3 ? input::ShapeKind::shell : input::ShapeKind::ring;
  shape.base         = {1, 2, 0};
  shape.inner_radius = 8;
  shape.radius       = 10;
  return scene_with(shape, 1, n == 3 ? input::Dimension::three_d : input::Dimension::plane_strain);
}
} // namespace

// Without change of volume the wall is where the mapping has put it, and it is
// round; the least radius and its moment are kept when it springs back.
TEST(StructureObservers, InnerWallStopsWhereItWasLeast)
{
  for (const int n : {2, 3})
  {
    Watch radius("stopping_radius"), time("stopping_time"), round("roundness");
    int   k = 0;
    for (const double squeeze : {1., .7, .5, .55})
    {
      for (Watch *w : {&radius, &time, &round})
      {
        w->scene = hollow(n);
        w->row(.1 * k, collapsed(n, 8, 1, squeeze));
        w->restart();
      }
      ++k;
    }
    EXPECT_NEAR(radius.value(), 4, 1e-12) << n;
    EXPECT_NEAR(time.value(), .2, 1e-12) << n;
    EXPECT_NEAR(round.value(), 1, 1e-12) << n;
  }
}

// An ellipse: along x the wall stands at 1.2, along y at .9 of the diagonal's.
TEST(StructureObservers, RoundnessIsGreatestOverLeastDirection)
{
  Watch w("roundness");
  w.scene  = hollow(2);
  Sample s = collapsed(2, 8, 0, 1);
  for (std::size_t i = 0; i < s.mass.size(); ++i)
  {
    const Vec3   d(s.x0[0][i] - 1, s.x0[1][i] - 2, 0);
    const double turn = std::atan2(std::abs(d.y()), std::abs(d.x())) / pi * 180;
    const double f    = turn < 22.5 ? 1.2 : turn > 67.5 ? .9 : 1;
    s.x[0][i]         = 1 + f * d.x();
    s.x[1][i]         = 2 + f * d.y();
  }
  w.row(0, s);
  EXPECT_NEAR(w.value(), 1.2 / .9, 1e-12);
}

TEST(StructureObservers, InnerWallNeedsOne)
{
  Watch w("stopping_radius");
  EXPECT_THROW(w.row(0, swinging(0)), InputError);
}

// A cone of points, radius 2 - .1 z: exact at any height, for the outline is
// interpolated linearly.
TEST(StructureObservers, WidthOfACone)
{
  Watch w("width_at");
  w.observer.direction = {0, 0, 1};
  w.observer.parameter = 2.37;
  Sample s;
  s.is_mesh = true;
  for (int layer = 0; layer <= 40; ++layer)
    for (int i = 0; i < 64; ++i)
      for (const double share : {.5, 1.})
      {
        const double z = .25 * layer, r = share * (2 - .1 * z), turn = 2 * pi * (i + .5) / 64;
        add(s, Vec3::Zero(), {r * std::cos(turn), r * std::sin(turn), z + 5}, 1, 0);
      }
  w.row(0, s);
  EXPECT_NEAR(w.value(), 2 * (2 - .237), 1e-12);
}

// A missing layer parts a lattice; a stretch of 1.6 does not.
TEST(StructureObservers, PiecesOfALattice)
{
  Watch w("fragments");
  w.row(0, lattice(12, 5, .1, [](const Vec3 &x) { return Vec3(1.6 * x.x(), x.y(), 0); }));
  EXPECT_EQ(w.value(), 1);
  w.row(1,
        lattice(12, 5, .1,
                [](const Vec3 &x) { return Vec3(x.x() + (x.x() > .4) * .1 + (x.x() > .8) * .2, x.y(), 0); }));
  EXPECT_EQ(w.value(), 3);
}

TEST(StructureObservers, PiecesOfAMesh)
{
  Watch  w("fragments");
  Sample s;
  s.is_mesh        = true;
  s.nodes_per_cell = 2;
  for (int i = 0; i < 6; ++i)
    add(s, {1. * i, 0, 0}, {1. * i, 0, 0}, 1, 0);
  s.cells = {0, 1, 1, 2, 3, 4, 4, 5};
  w.row(0, s);
  EXPECT_EQ(w.value(), 2);
}

// Two neighbours come to .4 spacings and part again: the least of the run.
TEST(StructureObservers, SmallestDistanceOfTheRun)
{
  Watch w("smallest_distance");
  for (const double gap : {1., .4, .9})
  {
    w.row(0, lattice(4, 4, .2,
                     [&](const Vec3 &x)
                     { return x.x() < .2 && x.y() < .2 ? Vec3(x.x(), x.y() + (1 - gap) * .2, 0) : x; }));
    w.restart();
  }
  EXPECT_NEAR(w.value(), .4, 1e-12);
}

// The edges of two squares, 1 and 3 m long at the start, are stretched to 2 along x
// and .5 along y; the diagonals are in between.
TEST(StructureObservers, SmallestDistanceOfAMeshIsOfItsNodes)
{
  Watch  w("smallest_distance");
  Sample s;
  s.is_mesh        = true;
  s.nodes_per_cell = 4;
  for (const double size : {1., 3.})
    for (const auto &[i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      add(s, {i * size, j * size, 0}, {2 * i * size, .5 * j * size, 0}, 1, 0);
  s.cells = {0, 1, 2, 3, 4, 5, 6, 7};
  w.row(0, s);
  EXPECT_NEAR(w.value(), .5, 1e-14);
}

// The right half of a mirrored lattice is pushed up by .03.
TEST(StructureObservers, SymmetryErrorIsTheGreatestMismatch)
{
  Watch w("symmetry_error");
  w.observer.body.clear();
  w.observer.point = {.4, 0, 0};
  w.row(0, lattice(8, 3, .1, [](const Vec3 &x) { return Vec3(.4 + 2 * (x.x() - .4), x.y(), 0); }));
  EXPECT_NEAR(w.value(), 0, 1e-14);
  w.row(1, lattice(8, 3, .1, [](const Vec3 &x) { return Vec3(x.x(), x.y() + (x.x() > .7) * .03, 0); }));
  EXPECT_NEAR(w.value(), .03, 1e-14);
  w.row(2, lattice(7, 3, .1, [](const Vec3 &x) { return x; })); // one column has no partner
  EXPECT_TRUE(std::isnan(w.value()));
}

TEST(StructureObservers, SharesOfTheFirstEnergy)
{
  const input::Scene scene;
  for (const auto &[name, share] :
       {std::pair{"kinetic_share", .2}, std::pair{"elastic_share", .1}, std::pair{"plastic_share", .6}})
  {
    input::Observer o;
    o.quantity          = name;
    const auto observer = make_observer(o, scene);
    RowFrame   frame;
    frame.kinetic = 9;
    frame.elastic = 1;
    observer->row(frame);
    frame.kinetic      = 2;
    frame.plastic_work = 6;
    observer->row(frame);
    EXPECT_DOUBLE_EQ(observer->value(), share) << name;
  }
}
} // namespace ogive::coupling
