// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/reader.h"
#include "core/input/shape_geometry.h"
#include "tests/unit/input/scene_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace ogive::input
{
namespace
{
using testing::base_scene;
using testing::replaced;
using testing::write_file;

/// The scene's text with every default: field by field, number by number.
std::string all_of(Scene s)
{
  return write_resolved(s);
}

TEST(GoodScenes, GiveTheNumbersOfTheText)
{
  const Scene s = read_scene(write_file("scene.prm", base_scene));
  EXPECT_EQ(s.title, "Test");
  EXPECT_EQ(s.dimension, Dimension::three_d);
  EXPECT_EQ(s.end_time, 60e-6);
  ASSERT_EQ(s.bodies.size(), 3u);
  const Body &p = s.bodies[0];
  EXPECT_EQ(p.name, "projectile");
  EXPECT_EQ(p.shape.kind, ShapeKind::cylinder);
  EXPECT_EQ(p.shape.base, Vec3(0, 0, .0805));
  EXPECT_EQ(p.shape.axis, Vec3(0, 0, -1));
  EXPECT_EQ(p.shape.radius, .010);
  EXPECT_EQ(p.shape.length, .070);
  EXPECT_EQ(p.shape.nose, Nose::conical);
  EXPECT_EQ(p.shape.nose_length, .010);
  EXPECT_EQ(p.velocity, Vec3(0, 0, -303.5));
  EXPECT_EQ(p.spacing, .002);
  EXPECT_EQ(p.spacing_far, 0);
  EXPECT_EQ(s.bodies[1].method, Method::sph);
  EXPECT_EQ(s.bodies[2].shape.inner_radius, .024);
  EXPECT_EQ(s.bodies[2].shape.length, .012);
  EXPECT_EQ(s.bodies[2].spacing_far, .009);
  ASSERT_EQ(s.materials.size(), 2u);
  EXPECT_EQ(s.materials[0].name, "clay");
  EXPECT_EQ(s.materials[0].density, 7850);
  EXPECT_EQ(s.materials[1].name, "copper-benchmark");
  ASSERT_EQ(s.symmetry.size(), 2u);
  EXPECT_EQ(s.symmetry[1].axis, 1);
  EXPECT_EQ(s.walls.at(0).point, Vec3(0, 0, -.05));
  EXPECT_EQ(s.walls[0].friction, .1);
  EXPECT_EQ(s.boundaries.at(0).face, "outer");
  EXPECT_TRUE(s.boundaries[0].fix[2]);
  EXPECT_EQ(s.interfaces.at(0).mesh, "rest");
  EXPECT_EQ(s.contacts.at(0).second, "zone");
  EXPECT_EQ(s.contacts[0].stiffness, .1);
  ASSERT_EQ(s.observers.size(), 2u);
  EXPECT_EQ(s.observers[0].quantity, "residual_velocity");
  EXPECT_TRUE(s.observers[0].has_reference);
  EXPECT_EQ(s.observers[0].reference, 199.7);
  EXPECT_EQ(s.observers[0].reference_unit, "m/s");
  EXPECT_EQ(s.observers[0].kind, ReferenceKind::memory);
  EXPECT_EQ(s.observers[1].quantity, "precursor_speed");
  EXPECT_EQ(s.observers[1].parameter, 100e6);
  EXPECT_FALSE(s.observers[1].has_reference);
  EXPECT_EQ(s.sph.alpha, 1.5);
  EXPECT_EQ(s.sph.beta, SphOptions().beta);
  EXPECT_TRUE(s.stop.active);
  EXPECT_EQ(s.stop.window, 10e-6);
  EXPECT_EQ(s.output.history_interval, 1e-6);
}

// "auto" stands for the split and the limiter that go with the correction.
TEST(GoodScenes, ViscosityGoesTogether)
{
  const std::string file  = write_file("scene.prm", base_scene);
  const auto        split = [&](const std::vector<std::string> &settings) {
    const SphOptions o = read_scene(file, settings).sph.settled();
    return o.correction + " " + o.shock_split + " " + o.limiter;
  };
  EXPECT_EQ(split({}), "pairwise curvature linear");
  EXPECT_EQ(split({"SPH/correction=none"}), "none none none");
  EXPECT_EQ(split({"SPH/shock split=none"}), "pairwise none none");
  EXPECT_EQ(split({"SPH/shock split=sharp"}), "pairwise sharp linear");
  EXPECT_EQ(split({"SPH/shock split=compression"}), "pairwise compression none");
  EXPECT_EQ(split({"SPH/limiter=none"}), "pairwise curvature none");
  EXPECT_EQ(split({"SPH/correction=none", "SPH/limiter=linear"}), "none none linear");
}

TEST(GoodScenes, HoldLoadsTiesAndCoarsening)
{
  std::string text = replaced(base_scene, "set kind = fixed",
                              "set kind = displacement\n    set displacement = 0, 0, 2 mm\n"
                              "    set history = 0 us: 0, 10 us: 1, 20 us: 0.5");
  text = replaced(text, "    set particles = zone\n    set mesh = rest",
                  "    set slave = projectile\n    set master = rest\n    set tolerance = 0.2");
  text = replaced(text, "set spacing far = 9 mm",
                  "set velocity = 0, 0, -303.5 m/s\n    set coarsen = 2\n    set coarsen distance = 40 mm\n"
                  "    set coarsen from = 0, 0, -6 mm\n    set coarsen along = 0, 0, 1");
  text = replaced(text, "set spacing = 3 mm", "set spacing = 2 mm");
  const Scene s = read_scene(write_file("scene.prm", text));
  // the resolved scene reads to the same one
  const std::string resolved = write_resolved(s);
  for (const Scene &t : {s, read_scene(write_file("resolved.prm", resolved))})
  {
    const Boundary &b = t.boundaries.at(0);
    EXPECT_EQ(b.kind, BoundaryKind::displacement);
    EXPECT_EQ(b.displacement, Vec3(0, 0, .002));
    EXPECT_EQ(b.history.at(-1), 0);
    EXPECT_EQ(b.history.at(5e-6), .5);
    EXPECT_EQ(b.history.at(10e-6), 1);
    EXPECT_NEAR(b.history.at(15e-6), .75, 1e-15);
    EXPECT_EQ(b.history.at(1), .5);
    EXPECT_EQ(t.interfaces.at(0).slave, "projectile");
    EXPECT_EQ(t.interfaces[0].master, "rest");
    EXPECT_EQ(t.interfaces[0].tolerance, .2);
    EXPECT_EQ(t.bodies[2].coarsen, 2);
    EXPECT_EQ(t.bodies[2].coarsen_distance, .04);
    EXPECT_EQ(t.bodies[2].coarsen_from, Vec3(0, 0, -.006));
    EXPECT_EQ(t.bodies[2].coarsen_along, Vec3(0, 0, 1));
  }
  EXPECT_EQ(write_resolved(read_scene(write_file("resolved.prm", resolved))), resolved);
}

// One body twice: it meets itself. Overlaps are at rest unless it is said.
TEST(GoodScenes, LetABodyMeetItself)
{
  auto text = replaced(base_scene, "set contacts = strike", "set contacts = strike, itself");
  text      = replaced(text, "subsection Contacts\n",
                       "subsection Contacts\n  subsection itself\n    set between = zone, zone\n    set overlap = refuse\n  end\n");
  const Scene s = read_scene(write_file("itself.prm", text));
  ASSERT_EQ(s.contacts.size(), 2u);
  EXPECT_EQ(s.contacts[0].overlap, "rest");
  EXPECT_EQ(s.contacts[1].first, "zone");
  EXPECT_EQ(s.contacts[1].second, "zone");
  EXPECT_EQ(s.contacts[1].overlap, "refuse");
}

TEST(GoodScenes, AreNamedAfterTheirFolderOrFile)
{
  const std::string file = write_file("scene.prm", base_scene);
  const auto        folder = std::filesystem::absolute(file).parent_path();
  EXPECT_EQ(read_scene(file).name, folder.filename().string());
  EXPECT_EQ(read_scene(write_file("bullet.prm", base_scene)).name, "bullet");
}

TEST(GoodScenes, OverridesWin)
{
  const std::string file = write_file("scene.prm", base_scene);
  const Scene       s    = read_scene(file, {"Bodies/projectile/velocity=0, 0, -150 m/s", "SPH/kernel = wendland-c2"});
  EXPECT_EQ(s.bodies[0].velocity.z(), -150);
  EXPECT_EQ(s.sph.kernel, "wendland-c2");
  EXPECT_EQ(read_scene(file, {"Bodies/zone/spacing=2 mm"}).bodies[1].spacing, .002);
}

// Numbers without a short decimal form, and a direction off the axes, must come
// back to the last bit.
TEST(GoodScenes, ResolvedTextReadsBackEqual)
{
  std::string text = replaced(base_scene, "set point = 0, 0, -50 mm", "set point = 0, 0, -53.33333333333333 mm");
  text             = replaced(text, "set normal = 0, 0, 1", "set normal = 0.1, 0.2, 0.7");
  text             = replaced(text, "set point = 0, 0, -53", "set point = 0, 0, -153");
  const Scene       first    = read_scene(write_file("scene.prm", text));
  const std::string resolved = write_resolved(first);
  const Scene       second   = read_scene(write_file("resolved.prm", resolved));
  EXPECT_EQ(all_of(second), resolved);
  EXPECT_EQ(second.name, first.name);
  EXPECT_EQ(second.end_time, first.end_time);
  EXPECT_EQ(second.walls[0].normal, first.walls[0].normal);
  EXPECT_EQ(second.walls[0].point, first.walls[0].point);
  ASSERT_EQ(second.bodies.size(), first.bodies.size());
  for (std::size_t b = 0; b < first.bodies.size(); ++b)
  {
    EXPECT_EQ(second.bodies[b].shape.kind, first.bodies[b].shape.kind);
    EXPECT_EQ(second.bodies[b].shape.base, first.bodies[b].shape.base);
    EXPECT_EQ(second.bodies[b].shape.axis, first.bodies[b].shape.axis);
    EXPECT_EQ(second.bodies[b].shape.radius, first.bodies[b].shape.radius);
    EXPECT_EQ(second.bodies[b].shape.inner_radius, first.bodies[b].shape.inner_radius);
    EXPECT_EQ(second.bodies[b].shape.length, first.bodies[b].shape.length);
    EXPECT_EQ(second.bodies[b].shape.nose, first.bodies[b].shape.nose);
    EXPECT_EQ(second.bodies[b].shape.nose_length, first.bodies[b].shape.nose_length);
    EXPECT_EQ(second.bodies[b].material, first.bodies[b].material);
    EXPECT_EQ(second.bodies[b].method, first.bodies[b].method);
    EXPECT_EQ(second.bodies[b].spacing, first.bodies[b].spacing);
    EXPECT_EQ(second.bodies[b].spacing_far, first.bodies[b].spacing_far);
    EXPECT_EQ(second.bodies[b].velocity, first.bodies[b].velocity);
  }
  ASSERT_EQ(second.materials.size(), first.materials.size());
  for (std::size_t m = 0; m < first.materials.size(); ++m)
  {
    const materials::Parameters &a = first.materials[m], &b = second.materials[m];
    EXPECT_EQ(b.name, a.name);
    EXPECT_EQ(b.density, a.density);
    EXPECT_EQ(b.shear_modulus, a.shear_modulus);
    EXPECT_EQ(b.eos.bulk_modulus, a.eos.bulk_modulus);
    EXPECT_EQ(b.strength.yield_stress, a.strength.yield_stress);
    EXPECT_EQ(std::isnan(b.strength.exponent), std::isnan(a.strength.exponent));
    EXPECT_EQ(b.sources.size(), a.sources.size());
    EXPECT_EQ(b.ranges.size(), a.ranges.size());
  }
  EXPECT_EQ(second.observers[0].reference, first.observers[0].reference);
  EXPECT_EQ(second.observers[0].source, first.observers[0].source);
  EXPECT_EQ(second.sph.alpha, first.sph.alpha);
  EXPECT_EQ(second.output.history_interval, first.output.history_interval);
}

TEST(GoodScenes, ShippedScenesReadAndReadBack)
{
  for (const auto &e : std::filesystem::recursive_directory_iterator(OGIVE_SOURCE_DIR "/apps/scenes"))
    if (e.path().extension() == ".prm")
    {
      SCOPED_TRACE(e.path().string());
      const std::string resolved = write_resolved(read_scene(e.path().string()));
      EXPECT_EQ(all_of(read_scene(write_file("resolved.prm", resolved))), resolved);
    }
}

TEST(Reference, ShowsExpectationDefaultAndMeaning)
{
  const std::string text = reference();
  for (const char *row : {"| `end time` | a time > 0, such as \"80 us\" | **mandatory** | when the run ends |",
                          "| `alpha` | a number >= 0 | `1` | linear coefficient of the viscosity |",
                          "## Bodies/NAME", "## Materials/NAME/Strength", "for shape ring or shell",
                          "| `plateau_stress` | Pa | Pa |"})
    EXPECT_NE(text.find(row), std::string::npos) << row;
}

constexpr const char *bar_prm = R"(set dimension = uniaxial
set end time = 20 us
set bodies = bar
set walls = anvil
subsection Bodies
  subsection bar
    set shape = box
    set lower = 0 mm
    set upper = 10 mm
    set material = copper-benchmark
    set method = sph
    set spacing = 0.25 mm
    set velocity = -20 m/s
  end
end
subsection Walls
  subsection anvil
    set point = 0 mm
    set normal = 1
  end
end
)";

constexpr const char *bar_json = R"({
  "dimension": "uniaxial",
  "end time": "20 us",
  "bodies": ["bar"],
  "walls": "anvil",
  "Bodies": {
    "bar": {
      "shape": "box",
      "lower": "0 mm", "upper": "10 mm",
      "material": "copper-benchmark",
      "method": "sph",
      "spacing": "0.25 mm",
      "velocity": "-20 m/s"
    }
  },
  "Walls": {
    "anvil": { "point": "0 mm", "normal": 1 }
  }
}
)";

TEST(Json, GivesTheSameScene)
{
  EXPECT_EQ(all_of(read_scene(write_file("bar.json", bar_json))), all_of(read_scene(write_file("bar.prm", bar_prm))));
}

TEST(Json, MistakesHaveLines)
{
  const auto message = [](const std::string &from, const std::string &to) -> std::string {
    try
    {
      read_scene(write_file("bar.json", replaced(bar_json, from, to)));
    }
    catch (const std::exception &e)
    {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message("\"spacing\"", "\"spaicng\"").find("bar.json:12: \"Bodies/bar/spaicng\": unknown entry"),
            std::string::npos);
  EXPECT_NE(message("\"10 mm\"", "10").find("bar.json:9: \"Bodies/bar/upper\": \"10\" has no unit"), std::string::npos);
  EXPECT_NE(message("\"sph\",", "\"sph\"").find("bar.json:12: "), std::string::npos);
  EXPECT_NE(message("\"20 us\"", "null").find("bar.json:3: \"end time\""), std::string::npos);
  EXPECT_NE(message("\"bar\": {", "\"bra\": {").find("did you mean \"bar\"?"), std::string::npos);
  EXPECT_NE(message("\"walls\": \"anvil\",", "\"walls\": \"anvil\", \"walls\": \"a\",").find("given twice"),
            std::string::npos);
}

TEST(Geometry, NosesJoinTheShankAndEndInATip)
{
  Shape s;
  s.kind        = ShapeKind::cylinder;
  s.base        = Vec3(.1, -.2, .3);
  s.axis        = Vec3(1, 2, 2) / 3;
  s.radius      = .013;
  s.length      = .05;
  s.nose_length = .031;
  for (const Nose nose : {Nose::hemispherical, Nose::conical, Nose::ogive})
  {
    s.nose         = nose;
    const double l = total_length(s);
    EXPECT_DOUBLE_EQ(radius_at(s, s.length), s.radius);
    EXPECT_NEAR(radius_at(s, l), 0, 1e-7 * s.radius);
    EXPECT_DOUBLE_EQ(l, s.length + (nose == Nose::hemispherical ? .013 : .031));
    EXPECT_NEAR(support(s, Dimension::three_d, s.axis), s.base.dot(s.axis) + l, 1e-12);
    for (const Vec3 &x : inner_points(s, Dimension::three_d))
      EXPECT_TRUE(contains(s, Dimension::three_d, x, 0));
  }
}

TEST(Geometry, TouchingBodiesDoNotOverlapAndDippingOnesDo)
{
  Scene scene;
  Shape plate, ball;
  plate.lower = Vec3(-.1, -.1, -.01);
  plate.upper = Vec3(.1, .1, 0);
  ball.kind   = ShapeKind::sphere;
  ball.radius = .02;
  ball.base   = Vec3(.03, .01, .02);
  Vec3 at;
  EXPECT_FALSE(find_overlap(plate, ball, scene, at));
  // a dip of a hundredth of the radius
  ball.base.z() -= .0002;
  ASSERT_TRUE(find_overlap(plate, ball, scene, at));
  EXPECT_TRUE(contains(plate, scene.dimension, at, 0) && contains(ball, scene.dimension, at, 0));
}
} // namespace
} // namespace ogive::input
