// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/tensor.h"
#include "core/input/history.h"
#include "core/materials/parameters.h"

#include <limits>
#include <string>
#include <vector>

/// A scene as plain numbers, SI. Filled by the reader (core/input/reader.h), or
/// by hand in a test. Nothing here knows ParameterHandler.
namespace ogive::input
{
enum class Dimension
{
  uniaxial,      ///< x; per square metre; strain only along x
  plane_strain,  ///< x, y; per metre of thickness
  axisymmetric,  ///< x = r, y = z (axis); whole ring
  three_d
};
int         space_dimension(Dimension); ///< 1, 2, 2, 3
std::string describe(Dimension);        ///< as in a scene file: "plane-strain"

enum class Method
{
  fem,
  sph,
  automatic ///< elements that turn into particles where they must
};

enum class Nose
{
  blunt,
  hemispherical,
  conical,
  ogive
};

enum class ShapeKind
{
  box,      ///< lower, upper
  cylinder, ///< base, axis, radius, length (without the nose), nose, nose_length; the nose points along +axis
  disc,     ///< a cylinder without nose: base, axis, radius, length = thickness; in plane strain a circle about base
  ring,     ///< base, axis, inner_radius, radius, length; in plane strain an annulus about base
  sphere,   ///< base = centre, radius
  shell,    ///< base = centre, inner_radius, radius
  mesh      ///< mesh_file
};

struct Shape
{
  ShapeKind   kind = ShapeKind::box;
  Vec3        lower = Vec3::Zero(), upper = Vec3::Zero();
  Vec3        base = Vec3::Zero(), axis = Vec3::UnitZ();
  double      radius = 0, inner_radius = 0, length = 0;
  Nose        nose        = Nose::blunt;
  double      nose_length = 0;
  std::string mesh_file;
  std::string mesh_part;     ///< group of its cells; empty: all
  double      mesh_unit = 1; ///< m, of the file's coordinates
};

/// When an element dies. Off: never.
struct Erosion
{
  bool   on     = false; ///< dies when its points have failed (damage 1), or
  double strain = 0;     ///< at this plastic strain (0: not by it), or
  double step   = 0;     ///< once its bound of the step is less than this, s (0: not by it)
};

/// When an element turns into particles: where any of the measures reaches 1,
///   strain/strain', damage/damage', |ln J|/volume', bound of the step below `step`,
/// and what lies within `layers` elements of it. A limit of 0 switches its measure off.
struct Conversion
{
  double per_edge = 1; ///< particles an edge, 1 to 3
  double strain   = .25;
  double damage   = .1;
  double volume   = .3;
  double step     = 0; ///< s
  double layers   = 2;
  /// Converted at the start: centres of elements within zone_radius of the point
  /// zone_centre, or, unless zone_along is zero, of the line through it.
  double zone_radius = 0; ///< m
  Vec3   zone_centre = Vec3::Zero(), zone_along = Vec3::Zero();
};

struct Body
{
  std::string name;
  Shape       shape;
  std::string material; ///< a name in Scene::materials
  Method      method  = Method::fem;
  double      spacing = 0; ///< particle spacing (sph) or target element edge (fem), m
  /// fem: element edge at the outer radius of a disc or ring, or far end of the
  /// grading; 0: as `spacing`.
  double spacing_far = 0;
  std::string element; ///< fem: formulation; empty: FemOptions::element
  /// fem, generated shapes: how often the edge doubles with distance, a whole
  /// number; each time the distance grows by coarsen_distance. Distance is from
  /// the point coarsen_from, or, unless coarsen_along is zero, from the line
  /// through it.
  double coarsen          = 0;
  double coarsen_distance = 0; ///< m
  Vec3   coarsen_from = Vec3::Zero(), coarsen_along = Vec3::Zero();
  /// sph: particles stand off their lattice by up to this share of the spacing
  /// along each axis, the same ones in every run.
  double jitter      = 0;
  Erosion erosion; ///< fem
  Conversion conversion; ///< automatic
  Vec3   velocity    = Vec3::Zero(); ///< m/s
  Vec3   spin        = Vec3::Zero(); ///< rad/s about the centre of mass
  /// Initial velocity field beyond translation and spin; empty for none:
  /// "radial-inverse" (cylinder, v = speed R/r), "radial-inverse-square"
  /// (sphere), "twist", "bend", "bending-mode", "closing", "converging",
  /// "standing-wave", "shear", "saw-tooth", "stretch", "draw" (velocity_field.h).
  std::string velocity_field;
  double      velocity_field_speed = 0;
  double      half_waves           = 1; ///< "standing-wave": half wavelengths along x, a whole number
  /// State at the start, particles only: a density (kg/m^3, NaN: the material's),
  /// a pressure that heat makes (Pa), and past step_plane along x, unless that is
  /// NaN, another pressure and density.
  double      start_density = std::numeric_limits<double>::quiet_NaN();
  double      pressure   = 0;
  double      step_plane = std::numeric_limits<double>::quiet_NaN(); ///< m
  double      density_beyond  = std::numeric_limits<double>::quiet_NaN(); ///< kg/m^3
  double      pressure_beyond = std::numeric_limits<double>::quiet_NaN(); ///< Pa

  bool has_step() const { return step_plane == step_plane; }
  bool has_start_density() const { return start_density == start_density; }
  bool has_initial_state() const { return pressure > 0 || has_step() || has_start_density(); }
};

/// Keeps the half x_axis >= 0 of everything.
struct SymmetryPlane
{
  int axis = 0;
};

/// A flat rigid wall. Material stays on the side that `normal` points to.
struct RigidWall
{
  std::string name;
  Vec3        point = Vec3::Zero(), normal = Vec3::UnitX(); ///< normal: unit vector into the material
  Vec3        velocity = Vec3::Zero();                       ///< m/s, constant
  double      friction = 0;                                  ///< Coulomb coefficient
};

enum class BoundaryKind
{
  fixed,
  velocity,     ///< prescribed velocity, components marked by `fix`
  displacement, ///< prescribed displacement from the start, components marked by `fix`; meshes only
  pressure,     ///< pressure on the present shape; meshes only
  body_force,   ///< acceleration of the whole body; meshes only
  absorbing     ///< dashpots of the material's impedances (Lysmer); meshes only
};

struct Boundary
{
  std::string  name, body;
  std::string  face; ///< "x-", "x+", "y-", ... (box); "bottom", "top", "side", "inner", "outer" (round shapes); "all"; or a group of a mesh file, by name or number
  BoundaryKind kind     = BoundaryKind::fixed;
  Vec3         velocity     = Vec3::Zero(); ///< m/s
  Vec3         displacement = Vec3::Zero(); ///< m
  Vec3         acceleration = Vec3::Zero(); ///< m/s^2
  bool         fix[3]       = {true, true, true};
  double       pressure     = 0; ///< Pa
  History      history;          ///< factor in time of what is prescribed

  bool prescribes_motion() const
  {
    return kind == BoundaryKind::fixed || kind == BoundaryKind::velocity || kind == BoundaryKind::displacement;
  }
};

/// Joins a body of particles to one of elements, or two bodies of elements, or
/// the particles and the elements of one body with method automatic.
struct Interface
{
  std::string name;
  std::string method = "pair-flux"; ///< "tied", "pair-flux", "blended"
  std::string particles, mesh; ///< bodies
  std::string body{};          ///< one body with method automatic, in place of the two above
  double      damping = .1;    ///< of the elements at the seam: stress over that of strain in the time H/c; pair flux
  double      pair_viscosity = 1; ///< on what a pair at the seam has left of its velocities; pair flux
  std::string certificate = "check"; ///< "check", "warn", "skip": what a run makes of too strong a reflection
  double      reflection_limit = .1; ///< amplitude of the echo of a wave of certificate_wavelength
  double      certificate_wavelength = 0; ///< m; 0: 32 particle spacings
  std::string slave{}, master{}; ///< bodies of elements, in place of the two above
  double      tolerance = .1;  ///< gap that a tie of elements closes, in edges of the master's facet

  bool joins_meshes() const { return !slave.empty() || !master.empty(); }
};

struct Contact
{
  std::string name;
  std::string first, second; ///< bodies
  double      friction = 0;
  double      stiffness = .1; ///< penalty k = stiffness m_eff/dt^2, <= .1
  std::string overlap = "rest"; ///< at the start: "rest" (counts as zero until it opens), "heal" (moved apart), "refuse"
};

enum class ReferenceKind
{
  exact,
  code,
  test,
  memory
};

struct Observer
{
  std::string name;     ///< also the quantity's name in summary.json, unless `quantity` says otherwise
  std::string quantity; ///< snake_case, e.g. "final_length"
  std::string body;
  Vec3        direction = Vec3::UnitX(); ///< axis along which it measures
  Vec3        point     = Vec3::Zero();  ///< gauges
  double      parameter = 0;             ///< per quantity, e.g. a threshold stress, Pa
  bool        has_reference = false;
  double      reference     = 0;
  std::string reference_unit;
  ReferenceKind kind = ReferenceKind::memory;
  std::string   source;
};

/// SPH choices for the whole scene.
struct SphOptions
{
  std::string form       = "corrected"; ///< "standard", "corrected"
  std::string configuration = "current"; ///< "current", "reference": where neighbours and kernel are those of t = 0
  std::string kernel     = "cubic";     ///< "cubic", "quintic", "wendland-c2", "wendland-c4"
  double      h_over_dx  = 1.3;
  std::string density    = "continuity"; ///< "continuity", "summation"
  std::string viscosity  = "monaghan";  ///< "monaghan", "hernquist-katz", "owen"
  double      alpha      = 1, beta = 2;
  std::string limiter    = "auto";      ///< "none", "linear": weak viscosity sees the reconstructed jump; see settled
  std::string viscosity_switch = "none"; ///< "none", "balsara", "cullen-dehnen", "divergence-gradient"
  std::string correction = "pairwise";  ///< "none", "pairwise", "shepard"
  double      correction_support = 1;   ///< s = h_c/h; the greatest one of rules that choose
  std::string support_rule = "fixed";   ///< "fixed", "total-variation", "minimal-dissipation", "monotonicity"
  std::string shock_split = "auto";     ///< "none", "compression", "sharp", "curvature"; see settled
  double      split_compression = .02;  ///< M0: h |div v|/c at which all viscosity stays
  double      split_bend  = .06;        ///< the same for its curvature, over the cube of that offset
  double      split_ratio = .2;         ///< R0 over the mean neighbour offset of the lattice
  std::string energy_form = "compatible"; ///< "compatible"; "working", "averaged" (shepard)
  double      artificial_stress = 0;    ///< epsilon of Gray, Monaghan and Swift
  double      hourglass  = .2;          ///< coefficient z of numerics.md section 2
  double      hourglass_stiffness = .2; ///< its modulus over that of plane waves, in the reference configuration
  double      step_factor = .7;         ///< share of the stability bound
  std::string quiescent_skip = "on";    ///< "on", "off": particles that nothing has reached yet are not computed

  /// With what "auto" stands for. A correction takes the viscosity of shocks too,
  /// so it goes with a split; what a split leaves is weak by a limiter. Plain
  /// viscosity needs neither.
  SphOptions settled() const
  {
    SphOptions o = *this;
    if (o.shock_split == "auto")
      o.shock_split = o.correction == "none" ? "none" : "curvature";
    if (o.limiter == "auto")
      o.limiter = o.shock_split == "sharp" || o.shock_split == "curvature" ? "linear" : "none";
    return o;
  }
};

struct FemOptions
{
  std::string element           = "one-point"; ///< "one-point", "b-bar", "full", "spectral"
  int         degree            = 4;           ///< of spectral elements, 2 to 4
  std::string hourglass         = "stiffness"; ///< "stiffness", "viscous"
  double      hourglass_coefficient = .05;
  std::string bulk_viscosity    = "neumann-richtmyer"; ///< fem/viscosity/
  double      bulk_quadratic    = 1.5, bulk_linear = .06;
  std::string correction        = "none"; ///< of the acceleration by viscosity: "none", "pairwise"
  std::string shock_split       = "none"; ///< "none", "compression"
  double      split_compression = .02;    ///< M0: L |div v|/c at which all viscosity stays
  double      mass_scaling_step = 0;      ///< s; 0: no mass is added
  std::string step_bound        = "element"; ///< "element", "power-iteration"
  double      step_factor       = .9;
  std::string quiescent_skip    = "on"; ///< "on", "off": elements that nothing has reached yet are not computed
  std::string local_steps       = "none"; ///< "none", "auto", "2", "4", "8": longest step of an element over the shortest
};

/// One solver takes `steps` steps in one of the other.
struct Subcycling
{
  std::string who   = "none"; ///< "none", "auto", "particles", "elements"
  double      steps = 1;
  double      energy_limit = .005; ///< error of the energy, of the initial kinetic energy, above which it falls back to 1
};

/// How the work is shared among ranks.
struct ParallelOptions
{
  std::string partition = "rcb"; ///< of elements: "rcb" (recursive coordinate bisection), "p4est"
  double      imbalance = 1.05;  ///< most over mean measured cost above which particles and elements are shared anew
  double      interval  = 200;   ///< steps between looks at it
};

struct StopRule
{
  bool        active = false;
  std::string body;                 ///< the projectile
  double      tolerance = .005;     ///< relative change of its velocity over the window
  double      window    = 0;        ///< s
};

struct Limits
{
  double energy_drift = .05; ///< relative; a run beyond it stops with the culprit named
  double smallest_step_ratio = 1e-3; ///< of the first step
};

struct Output
{
  double history_interval    = 0; ///< s
  double field_interval      = 0; ///< s; 0: first and last state only
  double checkpoint_interval = 0; ///< s; 0: last state only
};

struct Scene
{
  std::string                        name, title, file;
  Dimension                          dimension = Dimension::three_d;
  double                             end_time  = 0; ///< s
  std::vector<materials::Parameters> materials;
  std::vector<Body>                  bodies;
  std::vector<SymmetryPlane>         symmetry;
  std::vector<RigidWall>             walls;
  std::vector<Boundary>              boundaries;
  std::vector<Interface>             interfaces;
  std::vector<Contact>               contacts;
  std::vector<Observer>              observers;
  SphOptions                         sph;
  FemOptions                         fem;
  Subcycling                         subcycling;
  ParallelOptions                    parallel;
  StopRule                           stop;
  Limits                             limits;
  Output                             output;
};
} // namespace ogive::input
