// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/unit/input/scene_text.h"

#include <cstddef>
#include <iterator>

namespace ogive::input::testing
{
const char *const base_scene = R"(# a quarter of a plate and its projectile
set title = Test
set dimension = 3d
set end time = 60 us
set bodies = projectile, zone, rest
set materials = clay
set symmetry planes = x, y
set walls = floor
set boundaries = clamp
set interfaces = seam
set contacts = strike
set observers = residual_velocity, wave

subsection Bodies
  subsection projectile
    set shape = cylinder
    set base = 0, 0, 80.5 mm
    set axis = 0, 0, -1
    set radius = 10 mm
    set length = 70 mm
    set nose = conical
    set nose length = 10 mm
    set material = copper-benchmark
    set method = fem
    set spacing = 2 mm
    set velocity = 0, 0, -303.5 m/s
  end
  subsection zone
    set shape = disc
    set base = 0, 0, -12 mm
    set axis = 0, 0, 1
    set radius = 24 mm
    set thickness = 12 mm
    set material = clay
    set method = sph
    set spacing = 1 mm
  end
  subsection rest
    set shape = ring
    set base = 0, 0, -12 mm
    set inner radius = 24 mm
    set radius = 100 mm
    set thickness = 12 mm
    set material = clay
    set method = fem
    set spacing = 3 mm
    set spacing far = 9 mm
  end
end
subsection Materials
  subsection clay
    set density = 7.85 g/cm^3
    set young modulus = 200 GPa
    set poisson ratio = 0.3
    subsection EOS
      set law = linear
    end
    subsection Strength
      set law = perfect-plastic
      set yield stress = 340 MPa
    end
  end
end
subsection Walls
  subsection floor
    set point = 0, 0, -50 mm
    set normal = 0, 0, 1
    set friction = 0.1
  end
end
subsection Boundaries
  subsection clamp
    set body = rest
    set face = outer
    set kind = fixed
  end
end
subsection Interfaces
  subsection seam
    set particles = zone
    set mesh = rest
  end
end
subsection Contacts
  subsection strike
    set between = projectile, zone
  end
end
subsection Observers
  subsection residual_velocity
    set body = projectile
    set direction = 0, 0, -1
    set reference = 199.7 m/s
    set kind = memory
    set source = Boervik
  end
  subsection wave
    set quantity = precursor_speed
    set body = rest
    set parameter = 100 MPa
  end
end
subsection SPH
  set alpha = 1.5
end
subsection Stop
  set body = projectile
  set window = 10 us
end
subsection Output
  set history interval = 1 us
end
)";

namespace
{
/// The shape of the body "zone".
constexpr const char *zone_disc = "set shape = disc\n    set base = 0, 0, -12 mm\n    set axis = 0, 0, 1\n"
                                  "    set radius = 24 mm\n    set thickness = 12 mm\n";
} // namespace

const WrongScene wrong_scenes[] = {
  // text
  {"no such statement", "set title", "let title", "let title", "let", "not a statement", "did you mean \"set\"?"},
  {"no equals sign", "set title = Test", "set title Test", "set title", "title Test", "no \"=\"", "set NAME = VALUE"},
  {"open subsection", "  set history interval = 1 us\nend\n", "  set history interval = 1 us\n", "", "Output",
   "not closed", "end"},
  {"end too many", "set alpha = 1.5\nend", "set alpha = 1.5\nend\nend", "set alpha = 1.5\nend\nend", "end", "no open subsection", ""},
  {"entry given twice", "set title = Test", "set title = Test\nset title = Again", "Again", "title", "given twice",
   "line 2"},
  // names of entries and subsections
  {"slip in an entry", "set radius = 10 mm", "set raduis = 10 mm", "raduis", "Bodies/projectile/raduis",
   "unknown entry", "did you mean \"radius\"?"},
  {"slip at the top", "set end time", "set end tiem", "end tiem", "end tiem", "unknown entry",
   "did you mean \"end time\"?"},
  {"entry in the wrong place", "set title = Test", "set title = Test\nset kernel = cubic", "kernel", "kernel",
   "unknown entry", "belongs to subsection \"SPH\""},
  {"slip in a section", "subsection Contacts", "subsection Contact", "subsection Contact", "Contact",
   "unknown subsection", "did you mean \"Contacts\"?"},
  {"body not in the list", "  subsection zone", "  subsection zoen", "subsection zoen", "Bodies/zoen",
   "not in the list \"bodies\"", "did you mean \"zone\"?"},
  {"body without subsection", "set bodies = projectile, zone, rest", "set bodies = projectile, zone, rest, more",
   "set bodies", "bodies", "\"more\" is not described", "Bodies/more"},
  {"body twice", "set bodies = projectile, zone, rest", "set bodies = projectile, zone, rest, zone", "set bodies",
   "bodies", "listed twice", ""},
  {"unused section", "set walls = floor\n", "", "subsection Walls", "Walls", "not used", "set walls"},
  {"unused wall", "subsection floor", "subsection roof", "subsection roof", "Walls/roof", "not in the list \"walls\"",
   "floor"},
  // mandatory entries
  {"no bodies", "set bodies = projectile, zone, rest", "set bodies = ", "set bodies", "bodies", "no value",
   "a list of names"},
  {"no dimension", "set dimension = 3d", "", "", "dimension", "missing", "one of uniaxial"},
  {"no end time", "set end time = 60 us", "", "", "end time", "missing", "a time > 0"},
  {"no shape", "    set shape = disc\n", "", "subsection zone", "Bodies/zone/shape", "missing", "one of box"},
  {"no material", "    set material = copper-benchmark\n", "", "subsection projectile", "Bodies/projectile/material",
   "missing", "name of a material"},
  {"no method", "    set method = sph\n", "", "subsection zone", "Bodies/zone/method", "missing", "one of fem, sph"},
  {"no spacing", "    set spacing = 1 mm\n", "", "subsection zone", "Bodies/zone/spacing", "missing", "a length > 0"},
  {"no radius", "    set radius = 10 mm\n", "", "subsection projectile", "Bodies/projectile/radius", "missing",
   "a length > 0"},
  {"no nose length", "    set nose length = 10 mm\n", "", "subsection projectile", "Bodies/projectile/nose length",
   "missing", "a length > 0"},
  {"no density", "    set density = 7.85 g/cm^3\n", "", "subsection clay", "Materials/clay/density", "missing",
   "a density > 0"},
  {"no source", "    set source = Boervik\n", "", "subsection residual_velocity",
   "Observers/residual_velocity/source", "missing", "a text"},
  {"no parameter", "    set parameter = 100 MPa\n", "", "subsection wave", "Observers/wave/parameter", "missing",
   "a pressure >= 0"},
  {"no stop window", "  set window = 10 us\n", "", "subsection Stop", "Stop/window", "missing", "a time > 0"},
  {"no yield stress", "      set yield stress = 340 MPa\n", "", "subsection Strength",
   "Materials/clay/Strength/yield stress", "missing", "perfect"},
  // units, signs and words
  {"missing unit", "set yield stress = 340 MPa", "set yield stress = 340", "yield stress",
   "Materials/clay/Strength/yield stress", "has no unit", "a pressure >= 0, such as \"340 MPa\""},
  {"wrong unit", "set yield stress = 340 MPa", "set yield stress = 340 mm", "yield stress",
   "Materials/clay/Strength/yield stress", "wrong unit: it is a length", "a pressure"},
  {"unit in the wrong case", "set young modulus = 200 GPa", "set young modulus = 200 gpa", "young modulus",
   "Materials/clay/young modulus", "unknown unit \"gpa\"", "did you mean \"GPa\"?"},
  {"unit on a number", "set alpha = 1.5", "set alpha = 1.5 m", "alpha", "SPH/alpha", "pure number", "a number >= 0"},
  {"negative density", "set density = 7.85 g/cm^3", "set density = -7.85 g/cm^3", "density", "Materials/clay/density",
   "out of bounds", "a density > 0"},
  {"NaN", "set radius = 10 mm", "set radius = nan mm", "radius = nan", "Bodies/projectile/radius",
   "not a finite number", "a length > 0"},
  {"infinity", "-303.5 m/s", "-inf m/s", "-inf", "Bodies/projectile/velocity", "not a finite number", ""},
  {"velocity without unit", "0, 0, -303.5 m/s", "0, 0, -303.5", "-303.5", "Bodies/projectile/velocity", "has no unit",
   "m/s"},
  {"two components", "0, 0, -303.5 m/s", "0, -303.5 m/s", "-303.5", "Bodies/projectile/velocity", "has 2 components",
   "expected 3"},
  {"zero normal", "set normal = 0, 0, 1", "set normal = 0, 0, 0", "normal", "Walls/floor/normal", "zero vector", ""},
  {"Poisson's ratio", "set poisson ratio = 0.3", "set poisson ratio = 0.5", "poisson", "Materials/clay/poisson ratio",
   "out of bounds", "< 0.5"},
  {"end time zero", "set end time = 60 us", "set end time = 0 s", "end time", "end time", "out of bounds", "> 0"},
  {"not a dimension", "set dimension = 3d", "set dimension = 3D", "dimension", "dimension", "not known",
   "did you mean \"3d\"?"},
  {"no method", "set method = sph", "set method = mixed", "method = mixed", "Bodies/zone/method", "not known",
   "one of fem, sph"},
  {"unknown law", "set law = perfect-plastic", "set law = perfectly-plastic", "perfectly",
   "Materials/clay/Strength/law", "not known", "did you mean \"perfect-plastic\"?"},
  {"unknown material", "set material = copper-benchmark", "set material = coper-benchmark", "coper",
   "Bodies/projectile/material", "no material \"coper-benchmark\"", "did you mean \"copper-benchmark\"?"},
  {"unknown quantity", "set quantity = precursor_speed", "set quantity = precurser_speed", "precurser",
   "Observers/wave/quantity", "not known", "did you mean \"precursor_speed\"?"},
  {"reference of the wrong kind", "set reference = 199.7 m/s", "set reference = 199.7 mm", "199.7",
   "Observers/residual_velocity/reference", "wrong unit", "a velocity"},
  {"empty value", "set title = Test", "set title =", "title", "title", "no value", "a text"},
  {"too stiff contact", "set between = projectile, zone", "set between = projectile, zone\n    set stiffness = 0.5",
   "stiffness", "Contacts/strike/stiffness", "out of bounds", "<= 0.1"},
  // entries that do not apply
  {"nose of a disc", "set thickness = 12 mm", "set thickness = 12 mm\n    set nose = blunt", "nose = blunt",
   "Bodies/zone/nose", "does not apply", "\"shape\" is cylinder"},
  {"nose length of a blunt nose", "set nose = conical", "set nose = blunt", "nose length",
   "Bodies/projectile/nose length", "does not apply", "\"nose\" is conical or ogive"},
  {"pressure of a fixed face", "set kind = fixed", "set kind = fixed\n    set pressure = 1 MPa", "pressure",
   "Boundaries/clamp/pressure", "does not apply", "\"kind\" is pressure"},
  {"box of a ring", "set inner radius = 24 mm", "set inner radius = 24 mm\n    set lower = 0, 0, 0 mm", "lower",
   "Bodies/rest/lower", "does not apply", "\"shape\" is box"},
  // histories
  {"history of a fixed face", "set kind = fixed", "set kind = fixed\n    set history = 0 us: 1", "history",
   "Boundaries/clamp/history", "does not apply", "\"kind\" is velocity or displacement"},
  {"times out of order", "set kind = fixed",
   "set kind = pressure\n    set pressure = 1 MPa\n    set history = 0 us: 0, 20 us: 1, 10 us: 1", "history",
   "Boundaries/clamp/history", "do not ascend: \"10 us\" follows \"20 us\"", "ascending times"},
  {"a time twice", "set kind = fixed",
   "set kind = pressure\n    set pressure = 1 MPa\n    set history = 0 us: 0, 10 us: 1, 10 us: 2", "history",
   "Boundaries/clamp/history", "do not ascend", "TIME: FACTOR"},
  {"time without unit", "set kind = fixed",
   "set kind = pressure\n    set pressure = 1 MPa\n    set history = 0: 0, 10 us: 1", "history",
   "Boundaries/clamp/history", "\"0\" has no unit", "\"0 us: 0, 10 us: 1"},
  {"factor with a unit", "set kind = fixed",
   "set kind = pressure\n    set pressure = 1 MPa\n    set history = 0 us: 0, 10 us: 1 MPa", "history",
   "Boundaries/clamp/history", "a pure number is wanted", "TIME: FACTOR"},
  {"no colon", "set kind = fixed", "set kind = pressure\n    set pressure = 1 MPa\n    set history = 0 us 0", "history",
   "Boundaries/clamp/history", "no \":\"", "TIME: FACTOR"},
  {"no factor", "set kind = fixed", "set kind = pressure\n    set pressure = 1 MPa\n    set history = 0 us:", "history",
   "Boundaries/clamp/history", "lacks its factor", "TIME: FACTOR"},
  {"negative time", "set kind = fixed",
   "set kind = pressure\n    set pressure = 1 MPa\n    set history = -1 us: 0", "history", "Boundaries/clamp/history",
   "out of bounds", "TIME: FACTOR"},
  {"displacement at once", "set kind = fixed", "set kind = displacement\n    set displacement = 0, 0, 1 mm",
   "subsection clamp", "Boundaries/clamp/history", "would jump", "begins with 0"},
  {"displacement that jumps", "set kind = fixed",
   "set kind = displacement\n    set displacement = 0, 0, 1 mm\n    set history = 0 us: 1", "history",
   "Boundaries/clamp/history", "factor at time 0 is 1", "begins with 0"},
  {"body force on a face", "set face = outer\n    set kind = fixed",
   "set kind = body-force\n    set acceleration = 0, 0, -9.81 m/s^2\n    set face = outer", "face = outer",
   "Boundaries/clamp/face", "does not apply", "\"kind\" is fixed"},
  {"body force without unit", "set face = outer\n    set kind = fixed",
   "set kind = body-force\n    set acceleration = 0, 0, -9.81 m/s", "acceleration", "Boundaries/clamp/acceleration",
   "wrong unit: it is a velocity", "an acceleration"},
  {"absorbing particles", "set body = rest\n    set face = outer\n    set kind = fixed",
   "set body = zone\n    set face = outer\n    set kind = absorbing", "kind = absorbing", "Boundaries/clamp/kind",
   "held or driven at constant velocity", "fixed or velocity"},
  {"particles driven in time", "set body = rest\n    set face = outer\n    set kind = fixed",
   "set body = zone\n    set face = outer\n    set kind = velocity\n    set velocity = 0, 0, 1 m/s\n"
   "    set history = 0 us: 0, 1 us: 1", "set history", "Boundaries/clamp/history", "constant velocity only", "no history"},
  // names that point nowhere
  {"interface to no body", "set mesh = rest", "set mesh = rset", "rset", "Interfaces/seam/mesh", "no body \"rset\"",
   "did you mean \"rest\"?"},
  {"interface to elements", "set particles = zone", "set particles = projectile", "set particles",
   "Interfaces/seam/particles", "made of elements", "method sph"},
  {"interface to particles", "set mesh = rest", "set mesh = zone", "mesh = zone", "Interfaces/seam/mesh",
   "made of particles", "method fem"},
  {"interface without particles", "    set particles = zone\n", "", "subsection seam", "Interfaces/seam/particles",
   "missing", "method sph"},
  {"tie of particles", "    set particles = zone\n    set mesh = rest", "    set master = rest\n    set slave = zone",
   "slave = zone", "Interfaces/seam/slave", "made of particles", "method fem"},
  {"tie without master", "    set particles = zone\n    set mesh = rest", "    set slave = rest", "subsection seam",
   "Interfaces/seam/master", "missing", "method fem"},
  {"tie of both kinds", "    set particles = zone\n", "    set particles = zone\n    set slave = rest\n", "particles = zone",
   "Interfaces/seam/particles", "by their meshes", "\"slave\" and \"master\""},
  {"tie to itself", "    set particles = zone\n    set mesh = rest", "    set slave = rest\n    set master = rest",
   "master = rest", "Interfaces/seam/master", "tied to itself", "two different bodies"},
  {"tie at other speed", "    set particles = zone\n    set mesh = rest", "    set slave = projectile\n    set master = rest",
   "subsection rest", "Bodies/rest/velocity", "moves otherwise", "the velocity of \"projectile\""},
  {"tolerance of particles", "set mesh = rest", "set mesh = rest\n    set tolerance = 0.2", "tolerance",
   "Interfaces/seam/tolerance", "does not apply", "\"slave\""},
  {"tolerance beyond the facet", "    set particles = zone\n    set mesh = rest",
   "    set slave = rest\n    set master = rest\n    set tolerance = 2", "tolerance", "Interfaces/seam/tolerance",
   "out of bounds", "<= 1"},
  {"contact with no body", "set between = projectile, zone", "set between = projectile, zon", "between",
   "Contacts/strike/between", "no body \"zon\"", "did you mean \"zone\"?"},
  {"contact of one", "set between = projectile, zone", "set between = projectile", "between", "Contacts/strike/between",
   "1 names instead of 2", "2 names"},
  {"contact of tied bodies", "set between = projectile, zone", "set between = rest, zone", "between",
   "Contacts/strike/between", "tied by the interface \"seam\"", ""},
  {"boundary of no body", "set body = rest\n    set face", "set body = ring\n    set face", "body = ring",
   "Boundaries/clamp/body", "no body \"ring\"", "one of projectile"},
  {"no such face", "set face = outer", "set face = outter", "outter", "Boundaries/clamp/face", "no face \"outter\"",
   "did you mean \"outer\"?"},
  {"observer of no body", "set body = rest\n    set parameter", "set body = rast\n    set parameter", "rast",
   "Observers/wave/body", "no body \"rast\"", "did you mean \"rest\"?"},
  {"stop rule of no body", "set body = projectile\n  set window", "set body = bullet\n  set window", "bullet",
   "Stop/body", "no body \"bullet\"", "one of projectile"},
  {"no such mesh file", "set shape = cylinder\n    set base = 0, 0, 80.5 mm\n    set axis = 0, 0, -1\n    set radius = 10 mm\n"
   "    set length = 70 mm\n    set nose = conical\n    set nose length = 10 mm\n",
   "set shape = mesh\n    set mesh file = gone.msh\n", "gone.msh", "Bodies/projectile/mesh file", "no file", "gone.msh"},
  // geometry
  {"no thickness", "set thickness = 12 mm", "set thickness = 0 mm", "thickness = 0", "Bodies/zone/thickness",
   "out of bounds", "> 0"},
  {"smaller than its spacing", "set spacing = 1 mm", "set spacing = 20 mm", "spacing = 20", "Bodies/zone/spacing",
   "smaller than its spacing", "at most 12 mm"},
  {"empty ring", "set inner radius = 24 mm", "set inner radius = 124 mm", "inner radius", "Bodies/rest/inner radius",
   "empty", "less than 100 mm"},
  {"grading backwards", "set spacing far = 9 mm", "set spacing far = 1 mm", "spacing far", "Bodies/rest/spacing far",
   "finer", ""},
  {"overlap", "set base = 0, 0, 80.5 mm", "set base = 0, 0, 75 mm", "set base = 0, 0, -12 mm", "Bodies/zone/base",
   "overlaps \"projectile\"", "apart"},
  {"behind the wall", "set point = 0, 0, -50 mm", "set point = 0, 0, -5 mm", "shape = disc", "Bodies/zone/shape",
   "behind the wall \"floor\"", "7 mm"},
  {"cut away", "set base = 0, 0, 80.5 mm", "set base = -60, 0, 80.5 mm", "shape = cylinder", "Bodies/projectile/shape",
   "symmetry plane \"x\"", "x > 0"},
  {"half a doubling", "set spacing far = 9 mm", "set coarsen = 0.5", "coarsen", "Bodies/rest/coarsen",
   "a whole number of times", "0, 1, 2"},
  {"coarsened at no distance", "set spacing far = 9 mm", "set coarsen = 1", "subsection rest",
   "Bodies/rest/coarsen distance", "needs a distance", "a length > 0"},
  {"two gradings", "set spacing far = 9 mm", "set coarsen = 1\n    set coarsen distance = 40 mm\n    set spacing far = 9 mm",
   "spacing far", "Bodies/rest/spacing far", "coarsened by hanging nodes already", "one of the two"},
  {"coarser than the body", "set spacing far = 9 mm", "set coarsen distance = 40 mm\n    set coarsen = 3", "coarsen = 3",
   "Bodies/rest/coarsen", "coarsest element, 24 mm", "fewer doublings"},
  {"coarsened nose", "set nose = conical", "set nose = conical\n    set coarsen distance = 40 mm\n    set coarsen = 1",
   "coarsen = 1", "Bodies/projectile/coarsen", "with a nose", "without a nose"},
  {"coarsened particles", "set method = sph", "set method = sph\n    set coarsen = 1", "coarsen", "Bodies/zone/coarsen",
   "does not apply", "\"method\" is fem"},
  // motion
  {"across the symmetry plane", "0, 0, -303.5 m/s", "5, 0, -303.5 m/s", "-303.5", "Bodies/projectile/velocity",
   "symmetry plane \"x\"", "0 along x"},
  {"spin out of the symmetry plane", "set velocity = 0, 0, -303.5 m/s",
   "set velocity = 0, 0, -303.5 m/s\n    set spin = 0, 0, 100 rad/s", "spin", "Bodies/projectile/spin",
   "symmetry plane \"x\"", "no spin"},
  {"nothing moves", "    set velocity = 0, 0, -303.5 m/s\n", "", "subsection projectile",
   "Bodies/projectile/velocity", "nothing moves", "a velocity"},
  {"flies away", "0, 0, -303.5 m/s", "0, 0, 303.5 m/s", "303.5", "Bodies/projectile/velocity", "never hits",
   "\"zone\""},
  {"too slow to arrive", "set base = 0, 0, 80.5 mm", "set base = 0, 0, 180.5 mm", "-303.5",
   "Bodies/projectile/velocity", "never hits", "later end time"},
  // velocity fields and states at the start
  {"field without speed", "set method = sph", "set method = sph\n    set velocity field = converging", "subsection zone",
   "Bodies/zone/field speed", "missing", "a velocity"},
  {"slip in a field", "set method = sph", "set method = sph\n    set velocity field = closeing", "closeing",
   "Bodies/zone/velocity field", "not known", "did you mean \"closing\"?"},
  {"field of another shape", "set method = sph",
   "set method = sph\n    set field speed = 1 m/s\n    set velocity field = closing", "velocity field",
   "Bodies/zone/velocity field", "no meaning for this shape", "\"box\""},
  {"half waves of another field", "set method = sph",
   "set method = sph\n    set field speed = 1 m/s\n    set velocity field = converging\n    set half waves = 2",
   "half waves", "Bodies/zone/half waves", "does not apply", "standing-wave"},
  {"no half waves", zone_disc,
   "set shape = box\n    set lower = -15, -15, -12 mm\n    set upper = 15, 15, 0 mm\n    set field speed = 1 m/s\n"
   "    set velocity field = standing-wave\n    set half waves = 0\n", "half waves", "Bodies/zone/half waves",
   "out of bounds", "> 0"},
  {"half a half wave", zone_disc,
   "set shape = box\n    set lower = -15, -15, -12 mm\n    set upper = 15, 15, 0 mm\n    set field speed = 1 m/s\n"
   "    set velocity field = standing-wave\n    set half waves = 1.5\n", "half waves", "Bodies/zone/half waves",
   "no mode of 1.5", "a whole number"},
  {"shear across the symmetry plane", zone_disc,
   "set shape = box\n    set lower = -15, -15, -12 mm\n    set upper = 15, 15, 0 mm\n    set field speed = 1 m/s\n"
   "    set velocity field = shear\n", "velocity field", "Bodies/zone/velocity field", "symmetry plane \"x\"",
   "no such plane"},
  {"saw-tooth at the symmetry plane", zone_disc,
   "set shape = box\n    set lower = -15, -15, -12 mm\n    set upper = 15, 15, 0 mm\n    set field speed = 1 m/s\n"
   "    set velocity field = saw-tooth\n", "velocity field", "Bodies/zone/velocity field", "symmetry plane \"x\"",
   "no such plane"},
  {"pressure of elements", "set velocity = 0, 0, -303.5 m/s",
   "set velocity = 0, 0, -303.5 m/s\n    set pressure = 1 MPa", "set pressure", "Bodies/projectile/pressure",
   "for particles only", "method sph"},
  {"negative pressure", "set method = sph", "set method = sph\n    set pressure = -1 MPa", "pressure = -1",
   "Bodies/zone/pressure", "out of bounds", ">= 0"},
  {"pressure without unit", "set method = sph", "set method = sph\n    set pressure = 1", "pressure = 1",
   "Bodies/zone/pressure", "has no unit", "a pressure"},
  {"density past no plane", "set method = sph", "set method = sph\n    set density beyond = 1 kg/m^3", "density beyond",
   "Bodies/zone/density beyond", "does not apply", "step plane"},
  {"step to no pressure", "set method = sph",
   "set method = sph\n    set step plane = 1 mm\n    set density beyond = 1 kg/m^3", "subsection zone",
   "Bodies/zone/pressure beyond", "missing", "a pressure > 0"},
  {"step outside the body", "set method = sph",
   "set method = sph\n    set density beyond = 1 kg/m^3\n    set pressure beyond = 1 Pa\n    set step plane = 50 mm",
   "step plane", "Bodies/zone/step plane", "does not cut the body", "less than 0.024 m"},
};
const std::size_t wrong_scene_count = std::size(wrong_scenes);
} // namespace ogive::input::testing
