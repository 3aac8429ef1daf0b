// SPDX-License-Identifier: LGPL-2.1-or-later
// What a body starts with: velocity fields of waves and flows, and states.
#include "core/base/error.h"
#include "core/input/reader.h"
#include "core/input/velocity_field.h"
#include "tests/unit/input/scene_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ogive::input
{
namespace
{
using testing::write_file;

/// A box of 4 x 2 x 1 m with its middle at (3, 2, .5), particles every half metre.
Body box(const std::string &field)
{
  Body b;
  b.velocity_field       = field;
  b.velocity_field_speed = 10;
  b.spacing              = .5;
  b.shape.lower          = {1, 1, 0};
  b.shape.upper          = {5, 3, 1};
  return b;
}

Vec3 at(const Body &b, const Vec3 &x)
{
  return velocity_field(b, x, 1000);
}

TEST(WaveFields, ClosingRunsAtTheMiddle)
{
  const Body b = box("closing");
  EXPECT_EQ(at(b, {2, 1.5, .2}), Vec3(10, 0, 0));
  EXPECT_EQ(at(b, {3.1, 2.5, .9}), Vec3(-10, 0, 0));
  EXPECT_EQ(at(b, {3, 2, .5}), Vec3(0, 0, 0));
}

TEST(WaveFields, ConvergingPointsInwards)
{
  Body b = box("converging");
  EXPECT_LT((at(b, {6, 6, .5}) - Vec3(-6, -8, 0)).norm(), 1e-12);
  EXPECT_EQ(at(b, {3, 2, .5}), Vec3(0, 0, 0));
  b.shape.kind = ShapeKind::sphere;
  b.shape.base = {1, 1, 1};
  EXPECT_LT((at(b, {1, 4, 5}) - Vec3(0, -6, -8)).norm(), 1e-12);
  // towards the axis of a round body, wherever along it
  b.shape.kind = ShapeKind::disc;
  b.shape.axis = {0, 2, 0};
  EXPECT_LT((at(b, {4, 9, 5}) - Vec3(-6, 0, -8)).norm(), 1e-12);
}

TEST(WaveFields, StandingWaveHasFreeEnds)
{
  Body b       = box("standing-wave");
  b.half_waves = 2;
  // one wave in 4 m: crest, node, trough, node, crest
  const double share[] = {1, 0, -1, 0, 1};
  for (int k = 0; k < 5; ++k)
    EXPECT_NEAR(at(b, {1. + k, 2, .5}).x(), 10 * share[k], 1e-12) << k;
  b.half_waves = 1;
  EXPECT_NEAR(at(b, {2, 2, .5}).x(), 10 * std::sqrt(.5), 1e-12);
}

TEST(WaveFields, ShearIsLinearAndDoesNotCompress)
{
  const Body b = box("shear");
  EXPECT_EQ(at(b, {2, 3, .5}), Vec3(10, 0, 0));
  EXPECT_EQ(at(b, {4, 1.5, .5}), Vec3(-5, 0, 0));
}

TEST(WaveFields, SawToothChangesFromParticleToParticle)
{
  const Body b = box("saw-tooth");
  EXPECT_EQ(at(b, {1.25, 1.25, .25}), Vec3(10, 0, 0));
  for (int a = 0; a < 3; ++a)
  {
    Vec3 x(1.25, 1.25, .25);
    x[a] += .5;
    EXPECT_EQ(at(b, x), Vec3(-10, 0, 0)) << a;
  }
  EXPECT_EQ(at(b, {1.75, 1.75, .25}), Vec3(10, 0, 0));
  // a box whose edge is no multiple of the spacing is filled with a whole number: 8 in 4 m
  Body wide    = b;
  wide.spacing = .52;
  EXPECT_EQ(at(wide, {4.75, 1.25, .25}), Vec3(-10, 0, 0));
}

TEST(WaveFields, StretchRunsApart)
{
  const Body b = box("stretch");
  EXPECT_EQ(at(b, {5, 1.5, .2}), Vec3(10, 0, 0));
  EXPECT_EQ(at(b, {3, 2.5, .9}), Vec3(0, 0, 0));
  EXPECT_EQ(at(b, {2, 2.5, .9}), Vec3(-5, 0, 0));
}

TEST(WaveFields, DrawKeepsTheVolume)
{
  Body b = box("draw");
  EXPECT_EQ(at(b, {5, 2, .5}), Vec3(10, 0, 0));
  EXPECT_LT((at(b, {3, 3, 0}) - Vec3(0, -2.5, 1.25)).norm(), 1e-12); // half of 10/2 per metre along each
  b.shape.lower[2] = b.shape.upper[2] = 0;                          // a plane
  EXPECT_LT((at(b, {4, 1, 0}) - Vec3(5, 5, 0)).norm(), 1e-12);
}

// Nodes lie on the corners of cells, up to rounding to either side.
TEST(WaveFields, SawToothChangesFromNodeToNode)
{
  const Body b = box("saw-tooth");
  for (int k = 0; k <= 8; ++k)
    for (const double rounding : {-1e-12, 1e-12})
      EXPECT_EQ(at(b, {1 + .5 * k + rounding, 1, 0}).x(), k % 2 == 0 ? 10 : -10) << k;
}

std::string gas(const std::string &dimension, const std::string &body)
{
  return "set dimension = " + dimension + "\nset end time = 1 ms\nset bodies = a\nset materials = gas\n" +
         "subsection Materials\n subsection gas\n set density = 2 kg/m^3\n subsection EOS\n set law = "
         "ideal-gas\n"
         " set gamma = 1.4\n end\n subsection Strength\n set law = fluid\n end\n end\nend\n" +
         "subsection Bodies\n  subsection a\n    set material = gas\n    set method = sph\n    set spacing = "
         "1 mm\n" +
         body + "  end\nend\n";
}

std::string complaint(const std::string &text)
{
  try
  {
    read_scene(write_file("a.prm", text));
  }
  catch (const InputError &e)
  {
    return e.what();
  }
  return "";
}

const char *const line = "set shape = box\nset lower = -10 mm\nset upper = 10 mm\n";

TEST(StartStates, AreReadAndReadBack)
{
  const std::string body = std::string(line) +
                           "set pressure = 3 kPa\nset step plane = 1 mm\n"
                           "set density beyond = 0.5 kg/m^3\nset pressure beyond = 7 Pa\n";
  const Scene s = read_scene(write_file("a.prm", gas("uniaxial", body)));
  EXPECT_EQ(s.bodies[0].pressure, 3000);
  EXPECT_TRUE(s.bodies[0].has_step());
  EXPECT_EQ(s.bodies[0].step_plane, .001);
  EXPECT_EQ(s.bodies[0].density_beyond, .5);
  EXPECT_EQ(s.bodies[0].pressure_beyond, 7);
  const std::string resolved = write_resolved(s);
  EXPECT_EQ(write_resolved(read_scene(write_file("resolved.prm", resolved))), resolved);
}

TEST(StartStates, DensityAndJitterAreReadAndReadBack)
{
  const std::string body = std::string(line) + "set start density = 1.9 kg/m^3\nset jitter = 0.25\n";
  const Scene       s    = read_scene(write_file("a.prm", gas("uniaxial", body)));
  EXPECT_EQ(s.bodies[0].start_density, 1.9);
  EXPECT_EQ(s.bodies[0].jitter, .25);
  EXPECT_TRUE(s.bodies[0].has_initial_state());
  const std::string resolved = write_resolved(s);
  EXPECT_EQ(write_resolved(read_scene(write_file("resolved.prm", resolved))), resolved);

  std::string elements = gas("uniaxial", std::string(line) + "set velocity = 1 m/s\nset start density = 1.9 kg/m^3\n");
  elements.replace(elements.find("method = sph"), 12, "method = fem");
  EXPECT_NE(complaint(elements).find("for particles only"), std::string::npos);
  EXPECT_NE(complaint(gas("uniaxial", body + "set jitter = 0.5\n")).find("jitter"), std::string::npos);
}

// Elements die where they are asked to, and where nothing else holds on to them.
TEST(Erosion, IsReadReadBackAndRefused)
{
  const std::string eroding = "set method = fem\n    set erosion = failure\n";
  const auto        with    = [&](const std::string &more) {
    return testing::replaced(testing::base_scene, "set method = fem\n", eroding + more);
  };
  const Scene s = read_scene(write_file("a.prm", with("set erosion strain = 0.3\nset erosion step = 2 ns\n")));
  EXPECT_TRUE(s.bodies[0].erosion.on);
  EXPECT_EQ(s.bodies[0].erosion.strain, .3);
  EXPECT_EQ(s.bodies[0].erosion.step, 2e-9);
  EXPECT_FALSE(s.bodies[1].erosion.on);
  const std::string resolved = write_resolved(s);
  EXPECT_EQ(write_resolved(read_scene(write_file("resolved.prm", resolved))), resolved);

  EXPECT_NE(complaint(with("")).find("never fails"), std::string::npos);
  EXPECT_NE(complaint(with("set erosion strain = -1\n")).find("erosion strain"), std::string::npos);
  const auto particles =
    testing::replaced(testing::base_scene, "set method = sph\n", "set method = sph\n    set erosion = failure\n");
  EXPECT_NE(complaint(particles).find("erosion"), std::string::npos);
  EXPECT_NE(complaint(testing::replaced(testing::base_scene, "set spacing far = 9 mm\n",
                                        "set spacing far = 9 mm\n    set erosion = failure\n    set erosion strain = 1\n"))
              .find("ties particles"),
            std::string::npos);
}

// Elements turn into particles where they can, and where nothing else holds on to them.
TEST(Conversion, IsReadReadBackAndRefused)
{
  const auto with = [&](const std::string &more) {
    return testing::replaced(testing::base_scene, "set method = fem\n", "set method = auto\n    " + more);
  };
  const Scene s = read_scene(write_file(
    "a.prm", with("set particles per edge = 2\nset conversion step = 2 ns\nset zone radius = 3 mm\nset zone along = 0, 0, 1\n")));
  EXPECT_EQ(s.bodies[0].method, Method::automatic);
  EXPECT_EQ(s.bodies[0].conversion.per_edge, 2);
  EXPECT_EQ(s.bodies[0].conversion.step, 2e-9);
  EXPECT_EQ(s.bodies[0].conversion.zone_radius, 3e-3);
  const std::string resolved = write_resolved(s);
  EXPECT_EQ(write_resolved(read_scene(write_file("resolved.prm", resolved))), resolved);

  EXPECT_NE(complaint(with("set particles per edge = 1.5\n")).find("1.5 is not a whole number"), std::string::npos);
  EXPECT_NE(complaint(with("set conversion layers = 0.5\n")).find("whole number"), std::string::npos);
  EXPECT_NE(complaint(with("set particles per edge = 4\n")).find("particles per edge"), std::string::npos);
  EXPECT_NE(complaint(with("set element = b-bar\n")).find("only one-point elements"), std::string::npos);
  const auto blunt = testing::replaced(with("set coarsen = 1\nset coarsen distance = 3 mm\n"), "    set nose = conical\n    set nose length = 10 mm\n", "    set nose = blunt\n");
  EXPECT_NE(complaint(blunt).find("hanging nodes"), std::string::npos);
  const std::string scaled = with("") + "subsection FEM\n set mass scaling step = 1 us\nend\n";
  EXPECT_NE(complaint(scaled).find("added for the sake of the step"), std::string::npos);
  const std::string reference = with("") + "subsection SPH\n set configuration = reference\nend\n";
  EXPECT_NE(complaint(reference).find("reference configuration"), std::string::npos);
}

// A pressure is enough to set things going.
TEST(StartStates, MoveThings)
{
  EXPECT_NE(complaint(gas("uniaxial", line)).find("nothing moves"), std::string::npos);
  EXPECT_EQ(complaint(gas("uniaxial", std::string(line) + "set pressure = 1 Pa\n")), "");
}

TEST(WaveFields, AreRefusedWhereTheyMeanNothing)
{
  const std::string field = std::string(line) + "set field speed = 1 m/s\nset velocity field = ";
  EXPECT_EQ(complaint(gas("uniaxial", field + "closing\n")), "");
  EXPECT_NE(complaint(gas("uniaxial", field + "shear\n")).find("no shear in a uniaxial scene"),
            std::string::npos);
  EXPECT_NE(complaint(gas("uniaxial", field + "draw\n")).find("no sides to draw in"), std::string::npos);
  EXPECT_EQ(complaint(gas("uniaxial", field + "saw-tooth\n")), "");
  const std::string ring =
      "set shape = box\nset lower = 0, 0 mm\nset upper = 9, 9 mm\nset field speed = 1 m/s\n"
      "set velocity field = converging\n";
  std::string round = gas("axisymmetric", ring);
  round.replace(round.find("method = sph"), 12, "method = fem");
  EXPECT_NE(complaint(round).find("x is the radius"), std::string::npos);
}
} // namespace
} // namespace ogive::input
