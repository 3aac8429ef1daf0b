// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/certificate.h"

#include "core/base/error.h"
#include "core/materials/material.h"

#include <algorithm>
#include <cstdio>

namespace ogive::coupling
{
namespace
{
const input::Body &body_named(const input::Scene &scene, const std::string &name)
{
  const auto found = std::find_if(scene.bodies.begin(), scene.bodies.end(), [&](const auto &b) { return b.name == name; });
  require(found != scene.bodies.end(), "the reader knows the bodies of an interface");
  return *found;
}

SeamSide side_of(const input::Body &body)
{
  return {body.name, body.method == input::Method::sph ? input::Method::sph : input::Method::fem, body.spacing,
          body.element};
}

/// Neither side carries waves of less than four sizes; the strip, and its price,
/// grow with the wave.
void check_wavelength(const input::Interface &join, double size)
{
  constexpr double least = 4, most = 256;
  const double     wave  = join.certificate_wavelength;
  if (wave > 0 && (wave < least * size * (1 - 1e-9) || wave > most * size))
    throw InputError({"", 0, "Interfaces/" + join.name + "/certificate wavelength"},
                     wave < least * size ? "elements or particles of " + engineering(size) + " m carry no wave of " +
                                             engineering(wave) + " m" :
                                           "a wave of " + engineering(wave) + " m is longer than need be measured",
                     "from " + engineering(least * size) + " m to " + engineering(most * size) + " m");
}

CertifiedSeam make_seam(const input::Scene &scene, const input::Interface &join, const SeamSide &a, const SeamSide &b,
                        const std::string &material)
{
  CertifiedSeam seam;
  seam.spec.side = {a, b};
  seam.spec.join = join;
  seam.spec.sph  = scene.sph;
  seam.spec.fem  = scene.fem;
  seam.spec.line = scene.dimension == input::Dimension::uniaxial;
  for (const auto &m : scene.materials)
    if (m.name == material)
      seam.spec.material = m;
  check_wavelength(join, std::max(a.size, b.size));
  seam.wavelength = join.certificate_wavelength > 0 ? join.certificate_wavelength : 32 * std::min(a.size, b.size);
  return seam;
}

/// The seam within a body that converts: its elements, and the particles that
/// they turn into.
CertifiedSeam seam_within(const input::Scene &scene, const input::Interface &join, const input::Body &body)
{
  SeamSide particles = side_of(body), mesh = side_of(body);
  particles.body += " (particles)";
  mesh.body += " (elements)";
  particles.method = input::Method::sph;
  particles.size   = body.spacing / body.conversion.per_edge;
  return make_seam(scene, join, particles, mesh, body.material);
}

std::string percent(double share)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100 * share);
  return text;
}

std::string describe(const io::Summary::Certificate &c)
{
  std::string text = "interface \"" + c.interface + "\" (" + c.method + ") reflects, at a wavelength of " +
                     engineering(c.wavelength) + " m,";
  for (const auto &f : c.figures)
    if (f.wavelength == c.wavelength)
      text += (f.wave == c.figures.front().wave && f.from == c.figures.front().from ? " " : ", ") + percent(f.reflection) +
              " of a " + f.wave + " wave from \"" + f.from + "\"";
  return text;
}

/// What would bring the reflection down.
std::string remedy(const CertifiedSeam &seam)
{
  const auto &[a, b] = seam.spec.side;
  const auto &join   = seam.spec.join;
  std::string text   = "at most \"reflection limit\" = " + std::to_string(join.reflection_limit) + "; ";
  if (b.size > 1.01 * a.size)
    text += "elements of " + engineering(a.size) + " m, ";
  if (join.method == "tied" && a.method == input::Method::sph)
    text += "method = pair-flux, ";
  return text + "a smaller spacing on both sides, a longer \"certificate wavelength\" if the waves that matter are longer, "
                "or certificate = warn or skip";
}
} // namespace

std::vector<CertifiedSeam> seams_of(const input::Scene &scene)
{
  std::vector<CertifiedSeam> seams;
  std::vector<std::string>   named;
  for (const input::Interface &join : scene.interfaces)
  {
    if (!join.body.empty())
    {
      named.push_back(join.body);
      seams.push_back(seam_within(scene, join, body_named(scene, join.body)));
      continue;
    }
    const auto &a = body_named(scene, join.joins_meshes() ? join.slave : join.particles);
    const auto &b = body_named(scene, join.joins_meshes() ? join.master : join.mesh);
    seams.push_back(make_seam(scene, join, side_of(a), side_of(b), a.material));
  }
  for (const input::Body &body : scene.bodies)
    if (body.method == input::Method::automatic && std::find(named.begin(), named.end(), body.name) == named.end())
    {
      input::Interface join;
      join.name   = body.name;
      join.method = "pair-flux";
      join.body   = body.name;
      seams.push_back(seam_within(scene, join, body));
    }
  return seams;
}

std::vector<double> certificate_wavelengths(const CertifiedSeam &seam)
{
  std::vector<double> all;
  for (const double n : {8, 12, 16, 24, 32, 48, 64})
    all.push_back(n * std::min(seam.spec.side[0].size, seam.spec.side[1].size));
  if (std::find(all.begin(), all.end(), seam.wavelength) == all.end())
    all.push_back(seam.wavelength);
  std::sort(all.begin(), all.end());
  return all;
}

io::Summary::Certificate certify(const CertifiedSeam &seam, const std::vector<double> &wavelengths)
{
  io::Summary::Certificate c;
  const SeamSpec          &spec = seam.spec;
  c.interface                   = spec.join.name;
  c.method                      = spec.join.joins_meshes() ? "tie of elements" : spec.join.method;
  for (int s = 0; s < 2; ++s)
  {
    c.bodies[s] = spec.side[s].body;
    c.sizes[s]  = spec.side[s].size;
  }
  c.wavelength      = seam.wavelength;
  c.limit           = spec.join.reflection_limit;
  const bool shears = !spec.line && materials::make_material(spec.material)->shear_modulus() > 0;
  for (const bool shear : {false, true})
    for (int from = 0; from < 2 && (shears || !shear); ++from)
      for (const double wavelength : wavelengths)
        if (wavelength >= 4 * spec.side[from].size * (1 - 1e-9))
        {
          c.figures.push_back({shear ? "S" : "P", spec.side[from].body, wavelength,
                               reflection(spec, {.shear = shear, .from = from}, wavelength)});
          if (wavelength == seam.wavelength)
            c.worst = std::max(c.worst, c.figures.back().reflection);
        }
  return c;
}

std::vector<io::Summary::Certificate> certify_before_run(const input::Scene &scene, Log &log)
{
  std::vector<io::Summary::Certificate> all;
  for (const CertifiedSeam &seam : seams_of(scene))
  {
    const auto &join = seam.spec.join;
    if (join.certificate == "skip")
      continue;
    all.push_back(certify(seam, {seam.wavelength}));
    const std::string text = describe(all.back());
    if (all.back().worst <= join.reflection_limit)
      log.note(text);
    else if (join.certificate == "warn")
      log.warn(text + "; the limit is " + percent(join.reflection_limit));
    else
      throw InputError({"", 0, "Interfaces/" + join.name + "/reflection limit"}, text, remedy(seam));
  }
  return all;
}
} // namespace ogive::coupling
