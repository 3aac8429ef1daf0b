// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/reflection.h"

#include "core/base/error.h"
#include "core/materials/material.h"
#include "coupling/model.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>

namespace ogive::coupling
{
namespace
{
constexpr double pi = std::numbers::pi;

/// Velocities over sound speed: displacements stay below 1e-4 of a spacing, so
/// that lists, viscosity's square and geometry play no part.
constexpr double amplitude = 1e-6;

struct Speeds
{
  double p = 0, s = 0;
};

materials::Parameters elastic_part(const materials::Parameters &given, Speeds &speeds)
{
  const auto            material = materials::make_material(given);
  materials::Parameters p;
  p.name             = "seam";
  p.density          = material->density();
  p.shear_modulus    = material->shear_modulus();
  p.eos.law          = "linear";
  p.eos.bulk_modulus = material->bulk_modulus();
  p.strength.law     = p.shear_modulus > 0 ? "elastic" : "fluid";
  speeds.p           = std::sqrt((p.eos.bulk_modulus + 4 * p.shear_modulus / 3) / p.density);
  speeds.s           = std::sqrt(p.shear_modulus / p.density);
  return p;
}

/// Lengths of a measurement, m, s. The packet parts in two halves; the one that
/// runs away from the seam reaches the end of the strip when all is over.
struct Strip
{
  double width  = 0; ///< along the seam
  double start  = 0; ///< from the seam to the middle of the packet
  double path   = 0; ///< that the echo goes, at most
  double sigma  = 0;
  double time   = 0;
};

double whole(double length, double size)
{
  return size * std::ceil(length / size - 1e-9);
}

input::Body strip_body(const SeamSide &side, double from, double to, double width)
{
  input::Body body;
  body.name        = side.body;
  body.material    = "seam";
  body.method      = side.method;
  body.element     = side.element;
  body.spacing     = side.size;
  body.shape.lower = {from, 0, 0};
  body.shape.upper = {to, width, 0};
  return body;
}

input::Scene strip_scene(const SeamSpec &seam)
{
  Speeds       speeds;
  input::Scene scene;
  scene.dimension         = seam.line ? input::Dimension::uniaxial : input::Dimension::plane_strain;
  scene.materials         = {elastic_part(seam.material, speeds)};
  scene.sph               = seam.sph;
  scene.sph.configuration = "current"; // the same for waves this small, and it has mirrors
  scene.fem               = seam.fem;
  scene.fem.mass_scaling_step = 0;
  scene.end_time          = 1;
  return scene;
}

/// Nodes on the long sides of a strip move along them (odd: across them) alone.
void hold_sides(input::Scene &scene, bool odd)
{
  for (const input::Body &body : scene.bodies)
    for (const char *face : {"y-", "y+"})
      if (body.method == input::Method::fem && scene.dimension == input::Dimension::plane_strain)
      {
        input::Boundary b;
        b.name   = body.name + " " + face;
        b.body   = body.name;
        b.face   = face;
        b.kind   = input::BoundaryKind::velocity;
        b.fix[0] = odd;
        b.fix[1] = !odd;
        b.fix[2] = false;
        scene.boundaries.push_back(b);
      }
}

/// How far the particles reach into the elements: least of what the method takes.
double overlap(const SeamSpec &seam)
{
  const auto &[a, b] = seam.side;
  return seam.join.method == "blended" ? whole(std::max(4 * seam.sph.h_over_dx * a.size, 2 * b.size), a.size) : 0.;
}

/// The seam at x = 0, side 0 below it.
input::Scene with_seam(const SeamSpec &seam, const Strip &strip, int from, bool odd)
{
  input::Scene scene = strip_scene(seam);
  const double in = 2 * strip.start + strip.path, out = .5 * strip.path + 4 * strip.sigma;
  const auto  &a = seam.side[0], &b = seam.side[1];
  scene.bodies.push_back(strip_body(a, -whole(from == 0 ? in : out, a.size), overlap(seam), strip.width));
  scene.bodies.push_back(strip_body(b, 0, whole(from == 1 ? in : out, b.size), strip.width));
  input::Interface join = seam.join;
  join.body.clear();
  join.particles = join.mesh = join.slave = join.master = "";
  if (a.method == input::Method::sph)
  {
    join.particles = a.body;
    join.mesh      = b.body;
  }
  else
  {
    join.slave  = a.body;
    join.master = b.body;
  }
  scene.interfaces.push_back(join);
  hold_sides(scene, odd);
  return scene;
}

/// One method from end to end.
input::Scene without_seam(const SeamSpec &seam, const Strip &strip, int from, bool odd)
{
  input::Scene scene = strip_scene(seam);
  const auto  &side  = seam.side[from];
  const double in = whole(2 * strip.start + strip.path, side.size), out = whole(strip.path + 4 * strip.sigma, side.size);
  scene.bodies.push_back(strip_body(side, from == 0 ? -in : -out, from == 0 ? out : in, strip.width));
  hold_sides(scene, odd);
  return scene;
}

Setup start(const Strip &strip, bool odd, bool line, std::function<Vec3(const Vec3 &)> velocity)
{
  Setup setup;
  setup.velocity = [velocity = std::move(velocity)](int, const Vec3 &x) { return velocity(x); };
  if (!line)
    setup.mirrors = {{.axis = 1, .odd = odd}, {.axis = 1, .at = strip.width, .below = true, .odd = odd}};
  return setup;
}

template <int dim>
void go(Model<dim> &model, double dt, int steps)
{
  double time = 0;
  for (int n = 0; n < steps; ++n, time += dt)
    if (const StepStatus status = model.step({time, n == 0 ? .5 * dt : dt, dt}); !status.ok)
      throw RunError("the strip that measures a seam fails at " + std::to_string(time) + " s: " + status.culprit.why);
}

/// The two runs after the same time.
struct Pair
{
  Sample              single; ///< the run without the seam
  std::vector<double> mass;   ///< of the points below, of the single run
  std::vector<Vec3>   x, echo; ///< points of the incident side and the difference of their velocities
};

Vec3 at(const std::array<std::vector<double>, 3> &v, std::size_t i, int dim)
{
  Vec3 r = Vec3::Zero();
  for (int a = 0; a < dim; ++a)
    r[a] = v[a][i];
  return r;
}

template <int dim>
Pair run_both(const SeamSpec &seam, const Strip &strip, int from, bool odd,
              const std::function<Vec3(const Vec3 &)> &velocity)
{
  const Setup setup = start(strip, odd, seam.line, velocity);
  Model<dim>  joined(with_seam(seam, strip, from, odd), setup), single(without_seam(seam, strip, from, odd), setup);
  const double bound = .98 * std::min(joined.stable_dt().dt, single.stable_dt().dt);
  const int    steps = static_cast<int>(std::ceil(strip.time / bound));
  go(joined, strip.time / steps, steps);
  go(single, strip.time / steps, steps);

  Pair         pair{single.sample(0), {}, {}, {}};
  const Sample now  = joined.sample(from);
  const double size = seam.side[from].size;
  // Equal but for rounding, which the odd shift keeps from deciding.
  const auto name = [&](const Vec3 &x) {
    return std::pair(std::lround(1000 * x[0] / size + .237), std::lround(1000 * x[1] / size + .237));
  };
  std::map<std::pair<long, long>, std::size_t> single_at;
  for (std::size_t i = 0; i < pair.single.mass.size(); ++i)
    single_at[name(at(pair.single.x0, i, dim))] = i;
  for (std::size_t i = 0; i < now.mass.size(); ++i)
  {
    const Vec3 x     = at(now.x0, i, dim);
    if (from == 0 && x[0] > 0) // within the elements
      continue;
    const auto found = single_at.find(name(x));
    require(found != single_at.end(), "both runs have the same points on the incident side");
    pair.mass.push_back(pair.single.mass[found->second]);
    pair.x.push_back(x);
    pair.echo.push_back(at(now.v, i, dim) - at(pair.single.v, found->second, dim));
  }
  return pair;
}

Pair run_both(const SeamSpec &seam, const Strip &strip, int from, bool odd,
              const std::function<Vec3(const Vec3 &)> &velocity)
{
  return seam.line ? run_both<1>(seam, strip, from, odd, velocity) : run_both<2>(seam, strip, from, odd, velocity);
}

/// Mirrors of one axis stand further apart than a neighbourhood.
double least_width(const SeamSpec &seam)
{
  const double support = seam.sph.kernel == "quintic" ? 3 : 2; // over h
  double       width   = 0;
  for (const SeamSide &side : seam.side)
    if (side.method == input::Method::sph)
      width = side.size * (1 + 1.1 * support * seam.sph.h_over_dx * std::max(1., seam.sph.correction_support));
  return width;
}

/// A width along the seam of whole elements and whole spacings near `least`.
double whole_width(const SeamSpec &seam, double least)
{
  const double large = std::max(seam.side[0].size, seam.side[1].size);
  return whole(std::max(least, least_width(seam)), large);
}

void check(const SeamSpec &seam, const SeamWave &wave)
{
  require(wave.from == 0 || wave.from == 1, "a seam has two sides");
  require(seam.side[1].method == input::Method::fem, "side 1 is a mesh");
  require(!(seam.line && (wave.shear || wave.angle != 0)), "a line carries P waves along it");
}

/// -1 on side 0, 1 on side 1: where the packet comes from.
double sign_of(int from)
{
  return from == 0 ? -1 : 1;
}
} // namespace

double shortest_wavelength(const SeamSpec &seam)
{
  return 4 * std::max(seam.side[0].size, seam.side[1].size);
}

double reflection(const SeamSpec &seam, const SeamWave &wave, double wavelength)
{
  check(seam, wave);
  require(wave.angle == 0 && wavelength > 0, "normal incidence");
  Speeds speeds;
  elastic_part(seam.material, speeds);
  const double small = std::min(seam.side[0].size, seam.side[1].size);
  const double large = std::max(seam.side[0].size, seam.side[1].size);
  Strip        strip;
  strip.sigma = .375 * wavelength;
  strip.start = 3.5 * strip.sigma;
  strip.path  = std::max(3.5 * wavelength, 16 * large);
  strip.time  = (strip.start + strip.path) / (wave.shear ? speeds.s : speeds.p);
  strip.width = seam.line ? 0 : whole_width(seam, 4 * small);
  const double side     = sign_of(wave.from);
  const int    along    = wave.shear ? 1 : 0;
  const double k        = 2 * pi / wavelength;
  const auto   velocity = [&](const Vec3 &x) {
    const double s = x[0] - side * strip.start;
    Vec3         v = Vec3::Zero();
    v[along]       = amplitude * speeds.p * std::sin(k * s) * std::exp(-.5 * s * s / (strip.sigma * strip.sigma));
    return v;
  };
  const Pair           pair = run_both(seam, strip, wave.from, wave.shear, velocity);
  std::complex<double> back = 0, packet = 0;
  for (std::size_t i = 0; i < pair.mass.size(); ++i)
    back += pair.mass[i] * pair.echo[i][along] * std::polar(1., -k * pair.x[i][0]);
  for (std::size_t i = 0; i < pair.single.mass.size(); ++i)
    if (side * pair.single.x0[0][i] < strip.start)
      packet += pair.single.mass[i] * pair.single.v[along][i] * std::polar(1., -k * pair.single.x0[0][i]);
  return std::abs(back) / std::abs(packet);
}

double oblique_reflection(const SeamSpec &given, const SeamWave &wave, double wavelength)
{
  SeamSpec seam        = given;
  seam.fem.bulk_linear = seam.fem.bulk_quadratic = 0;
  check(seam, wave);
  require(!seam.line && wave.angle > 0 && wave.angle < .5 * pi, "an angle between the normal and the seam");
  Speeds speeds;
  elastic_part(seam.material, speeds);
  Strip strip;
  strip.width      = whole_width(seam, .5 * wavelength / std::sin(wave.angle));
  const double ky  = pi / strip.width, kx = ky / std::tan(wave.angle);
  strip.sigma      = 5 / kx;
  strip.start      = 3.5 * strip.sigma;
  strip.path       = 7 * strip.sigma;
  strip.time       = (strip.start + strip.path) / ((wave.shear ? speeds.s : speeds.p) * std::cos(wave.angle));
  const double side     = sign_of(wave.from);
  // Of a potential f(x) cos(ky y) its gradient, or of f(x) sin(ky y) its curl.
  const auto velocity = [&](const Vec3 &x) {
    const double s = x[0] - side * strip.start, envelope = amplitude * speeds.p / kx * std::exp(-.5 * s * s / (strip.sigma * strip.sigma));
    const double f = envelope * std::sin(kx * s), slope = envelope * (kx * std::cos(kx * s) - s / (strip.sigma * strip.sigma) * std::sin(kx * s));
    const double c = std::cos(ky * x[1]), n = std::sin(ky * x[1]);
    return wave.shear ? Vec3(ky * f * c, -slope * n, 0) : Vec3(slope * c, -ky * f * n, 0);
  };
  const Pair pair = run_both(seam, strip, wave.from, false, velocity);
  double     back = 0, packet = 0;
  for (std::size_t i = 0; i < pair.mass.size(); ++i)
    back += pair.mass[i] * pair.echo[i].squaredNorm();
  for (std::size_t i = 0; i < pair.single.mass.size(); ++i)
    if (side * pair.single.x0[0][i] < strip.start)
      packet += pair.single.mass[i] * at(pair.single.v, i, 2).squaredNorm();
  return std::sqrt(back / packet);
}
} // namespace ogive::coupling
