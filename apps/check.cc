// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/commands.h"

#include "apps/certificate.h"

#include "core/base/error.h"
#include "core/base/log.h"
#include "core/input/reader.h"
#include "core/io/files.h"
#include "coupling/certificate.h"
#include "coupling/run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

namespace ogive::apps
{
namespace
{
const char *rung(input::Dimension d)
{
  switch (d)
  {
    case input::Dimension::uniaxial:
      return "uniaxial (1-D)";
    case input::Dimension::plane_strain:
      return "plane strain (2-D)";
    case input::Dimension::axisymmetric:
      return "axisymmetric (2-D)";
    default:
      return "3-D";
  }
}
std::string place(const fem::MeshQuality::Worst &w)
{
  return "element " + (w.number < 0 ? std::to_string(w.element) : std::to_string(w.number) + " of the file") + " at (" +
         engineering(w.where[0]) + ", " + engineering(w.where[1]) + ", " + engineering(w.where[2]) + ") m";
}

void print_mesh(const fem::MeshQuality &q)
{
  std::string faces;
  for (const auto &[name, n] : q.faces)
    faces += (faces.empty() ? "" : ", ") + name + " " + std::to_string(n);
  std::printf("  mesh       %-16s %zu elements, %zu nodes, edges %s to %s m\n", q.body.c_str(), q.elements, q.nodes,
              engineering(q.shortest).c_str(), engineering(q.longest).c_str());
  const auto line = [](const char *what, const std::string &text) { std::printf("    %-25s%s\n", what, text.c_str()); };
  line("facets", faces);
  line("least scaled Jacobian", engineering(q.jacobian.value) + ", " + place(q.jacobian));
  line("largest aspect ratio", engineering(q.aspect.value) + ", " + place(q.aspect));
  line("least step by element", engineering(q.step.value) + " s, " + place(q.step));
  line("  5 %, half of them", engineering(q.step_twentieth) + ", " + engineering(q.step_median) + " s or less; " +
                                engineering(100 * q.share_near) + " % within twice the least");
  for (const std::string &note : q.notes)
    line("note", note);
  for (const std::string &warning : q.warnings)
    line("warning", warning);
}

/// The bound of the worst element beside the critical step of all meshes.
void print_critical(const coupling::Plan &plan, const std::vector<std::string> &bodies)
{
  double worst = std::numeric_limits<double>::infinity();
  for (const fem::MeshQuality &q : plan.meshes)
    worst = std::min(worst, q.step.value);
  if (std::isfinite(plan.critical.dt))
    std::printf("  critical   %s s, %.3f of the least step by element; %s\n", engineering(plan.critical.dt).c_str(),
                plan.critical.dt / worst, describe(plan.critical.culprit, bodies).c_str());
  else if (!plan.meshes.empty())
    std::printf("  critical   not looked for in so many elements; \"step bound = power-iteration\" does\n");
}

/// Who steps more often than others, and what that saves.
void print_parts(const input::Scene &scene, const coupling::Plan &plan)
{
  if (!plan.local_classes.empty())
  {
    std::string classes;
    for (std::size_t c = 0; c < plan.local_classes.size(); ++c)
      classes += (c == 0 ? "" : ", ") + std::to_string(plan.local_classes[c]) + " every " + std::to_string(1u << c);
    std::printf("  local      ratio %u; elements by parts of %s s: %s; %.3f of the element updates of one step for all\n",
                1u << (plan.local_classes.size() - 1), engineering(plan.local_part).c_str(), classes.c_str(),
                plan.local_updates);
  }
  else if (scene.fem.local_steps != "none" && plan.elements > 0)
    std::printf("  local      elements step alike, for their kind or for contact: docs/local_steps.md\n");
  if (scene.subcycling.who == "none" || plan.particles == 0 || plan.elements == 0)
    return;
  const bool particles = plan.who == "particles";
  std::printf("  parts      %s; bounds: particles %s s, elements %s s\n",
              plan.who == "none" ? "none, particles and elements step alike" :
                                   (plan.who + " take up to " + std::to_string(plan.parts) + " steps in one of the " +
                                    (particles ? "elements" : "particles"))
                                     .c_str(),
              engineering(plan.particles_dt).c_str(), engineering(plan.elements_dt).c_str());
}

/// Measures the seams, prints tables, writes certificate.csv and certificate.svg.
void certify_seams(const input::Scene &scene, const CheckArguments &a)
{
  namespace fs         = std::filesystem;
  const auto     seams = coupling::seams_of(scene);
  const fs::path directory(a.directory.empty() ? "results/certificate-" + scene.name : a.directory);
  if (seams.empty())
    throw InputError(a.scene + ": --certificate: the scene has no seam; expected an interface between two bodies, or a "
                               "body with method = auto");
  for (const char *name : {"certificate.csv", "certificate.svg"})
    if (fs::exists(directory / name) && !a.force)
      throw InputError((directory / name).string() + ": exists already; give another directory with -o, or --force");
  std::vector<io::Summary::Certificate> certificates;
  for (const coupling::CertifiedSeam &seam : seams)
    try
    {
      certificates.push_back(coupling::certify(seam, coupling::certificate_wavelengths(seam)));
      print_certificate(certificates.back());
    }
    catch (const InputError &e)
    {
      input::rethrow_in_scene(a.scene, e);
    }
  fs::create_directories(directory);
  io::write_whole((directory / "certificate.csv").string(), certificate_csv(certificates));
  io::write_whole((directory / "certificate.svg").string(), certificate_svg(scene.title, certificates));
  std::printf("  written to %s: certificate.csv, certificate.svg\n", directory.string().c_str());
}
} // namespace

void check(const CheckArguments &a)
{
  const input::Scene scene = input::read_scene(a.scene, a.overrides);
  coupling::Plan     plan;
  try
  {
    plan = coupling::plan_scene(scene);
  }
  catch (const InputError &e)
  {
    input::rethrow_in_scene(a.scene, e);
  }

  std::printf("%s: %s\n", scene.name.c_str(), scene.title.c_str());
  std::string planes;
  for (const input::SymmetryPlane &p : scene.symmetry)
    planes += std::string(planes.empty() ? "" : ", ") + "xyz"[p.axis];
  std::printf("  dimension  %s%s%s\n", rung(scene.dimension), planes.empty() ? "" : ", symmetry planes ", planes.c_str());
  for (const input::Body &body : scene.bodies)
    std::printf("  body       %-16s %s, %s, spacing %s m, %.6g m/s\n", body.name.c_str(),
                body.method == input::Method::fem ? "elements" : "particles", body.material.c_str(),
                engineering(body.spacing).c_str(), body.velocity.norm());
  for (const input::Interface &i : scene.interfaces)
    std::printf("  interface  %-16s %s, %s | %s\n", i.name.c_str(), i.method.c_str(),
                (i.joins_meshes() ? i.slave : i.particles).c_str(), (i.joins_meshes() ? i.master : i.mesh).c_str());
  for (const fem::TieReport &t : plan.ties)
    std::printf("  tied nodes %-16s %zu, gap closed up to %s m\n", t.name.c_str(), t.nodes,
                engineering(t.largest_gap).c_str());
  for (const input::Contact &c : scene.contacts)
    std::printf("  contact    %-16s %s and %s, friction %g\n", c.name.c_str(), c.first.c_str(), c.second.c_str(),
                c.friction);
  for (const coupling::InitialOverlap &o : plan.overlaps)
    std::printf("  warning    %s\n", o.describe().c_str());
  std::printf("  counts     %zu particles, %zu elements, %.6g kg\n", plan.particles, plan.elements, plan.mass);

  for (const auto &[body, share] : plan.added_mass_fraction)
    std::printf("  added mass %-16s %.3g %% by mass scaling%s\n", body.c_str(), 100 * share,
                share > .05 ? ": more than 5 % moves results" : "");

  std::vector<std::string> bodies;
  for (const input::Body &body : scene.bodies)
    bodies.push_back(body.name);
  std::printf("  step       %s s, set by %s\n", engineering(plan.limit.dt).c_str(),
              describe(plan.limit.culprit, bodies).c_str());
  print_parts(scene, plan);
  for (const fem::MeshQuality &q : plan.meshes)
    print_mesh(q);
  print_critical(plan, bodies);
  std::printf("  to the end %s s: about %.0f steps, %.3g s of processor time (%s s a step on this machine)\n",
              engineering(scene.end_time).c_str(), plan.steps, plan.steps * plan.seconds_per_step,
              engineering(plan.seconds_per_step).c_str());
  std::printf("  memory     %.1f MiB\n", plan.memory_bytes / (1024. * 1024.));
  if (a.certificate)
    certify_seams(scene, a);
}
} // namespace ogive::apps
