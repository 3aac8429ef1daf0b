// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/model.h"

#include "core/base/error.h"
#include "core/base/log.h"
#include "core/materials/hugoniot.h"
#include "core/materials/started_material.h"
#include "fem/mesh.h"
#include "sph/fill.h"

#include <ctime>
#include <map>
#include <utility>

namespace ogive::coupling
{
namespace
{
/// Adds the processor time of its life to a counter.
class Stopwatch
{
public:
  explicit Stopwatch(double &seconds)
    : seconds_(seconds)
    , start_(std::clock())
  {}
  ~Stopwatch() { seconds_ += static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

private:
  double      &seconds_;
  std::clock_t start_;
};

std::map<std::string, std::shared_ptr<const materials::Material>> build_materials(const input::Scene &scene)
{
  std::map<std::string, std::shared_ptr<const materials::Material>> built;
  for (const materials::Parameters &p : scene.materials)
    built[p.name] = materials::make_material(p);
  return built;
}

int body_index(const input::Scene &scene, const std::string &name)
{
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (scene.bodies[b].name == name)
      return static_cast<int>(b);
  throw InputError("no body \"" + name + "\" in the scene");
}

std::vector<int> boundary_bodies(const input::Scene &scene)
{
  std::vector<int> bodies;
  for (const input::Boundary &boundary : scene.boundaries)
    bodies.push_back(body_index(scene, boundary.body));
  return bodies;
}

std::vector<fem::Tie> mesh_ties(const input::Scene &scene)
{
  std::vector<fem::Tie> ties;
  for (const input::Interface &i : scene.interfaces)
    if (i.joins_meshes())
      ties.push_back({i.name, body_index(scene, i.slave), body_index(scene, i.master), i.tolerance});
  return ties;
}

/// Gives the particles of a body the density and pressure that it starts with.
template <int dim>
void start(sph::BodyParticles<dim> &particles, const input::Body &body)
{
  if (!body.has_initial_state())
    return;
  const double rest    = particles.material->density();
  const double density = body.has_start_density() ? body.start_density : rest;
  const double pressure = body.pressure > 0 ? body.pressure :
                                              materials::cold_pressure(particles.material->parameters(), density);
  std::vector<materials::StartState> states;
  for (std::size_t i = 0; i < particles.x.size(); ++i)
  {
    const bool beyond = body.has_step() && particles.x[i][0] > body.step_plane;
    states.push_back(beyond ? materials::StartState{body.density_beyond, body.pressure_beyond} :
                              materials::StartState{density, pressure});
    particles.mass[i] *= states.back().density / rest;
  }
  try
  {
    particles.material = std::make_shared<const materials::StartedMaterial>(particles.material, std::move(states));
  }
  catch (const InputError &e)
  {
    const char *entry = body.pressure > 0 ? "/pressure" : body.has_step() ? "/step plane" : "/start density";
    throw InputError({"", 0, "Bodies/" + body.name + entry}, e.complaint());
  }
}
} // namespace

template <int dim>
Model<dim>::Model(const input::Scene &scene)
  : n_walls_(scene.walls.size())
{
  const auto                              materials = build_materials(scene);
  std::vector<fem::BodyMesh<dim>>         meshes;
  std::vector<sph::BodyParticles<dim>>    clouds;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
  {
    const input::Body &body     = scene.bodies[b];
    const auto         material = materials.at(body.material);
    if (body.method == input::Method::fem)
    {
      meshes.push_back(fem::make_mesh<dim>(body, scene, static_cast<int>(b), material));
      for (const std::string &note : meshes.back().notes)
        mesh_notes_.push_back("body \"" + body.name + "\": " + note);
    }
    else
    {
      clouds.push_back(sph::fill<dim>(body, scene, static_cast<int>(b), material));
      start(clouds.back(), body);
    }
  }
  if (!meshes.empty())
    fem_ = std::make_unique<fem::Solver<dim>>(
      fem::Parameters{scene.fem, scene.dimension == input::Dimension::axisymmetric, scene.symmetry, scene.walls,
                      scene.boundaries, boundary_bodies(scene), mesh_ties(scene)},
      std::move(meshes));
  if (!clouds.empty())
    sph_ = std::make_unique<sph::Solver<dim>>(
      sph::Parameters{scene.sph, scene.dimension == input::Dimension::axisymmetric, scene.symmetry, scene.walls,
                      scene.boundaries, boundary_bodies(scene)},
      std::move(clouds));
  coupler_    = std::make_unique<Coupler<dim>>(scene, fem_.get(), sph_.get());
  subcycling_ = Subcycling(scene.subcycling, fem_ && sph_);
  if (subcycling_.mesh_is_coarse())
    fem_->allow_parts();
  if (subcycling_.particles_are_coarse())
    sph_->allow_parts();
  if (subcycling_.on())
    subcycling_.measure(ledger().kinetic);
  for (const input::Contact &contact : scene.contacts)
    contact_bodies_.emplace_back(body_index(scene, contact.first), body_index(scene, contact.second));
}

/// Of what steps more often, contact among it.
template <int dim>
StepLimit Model<dim>::fine_limit() const
{
  StepLimit limit = coupler_->stable_dt();
  if (fem_ && !subcycling_.mesh_is_coarse())
    limit.tighten(fem_->stable_dt());
  if (sph_ && !subcycling_.particles_are_coarse())
    limit.tighten(sph_->stable_dt());
  return limit;
}

template <int dim>
StepLimit Model<dim>::coarse_limit() const
{
  return subcycling_.mesh_is_coarse()       ? fem_->stable_dt() :
         subcycling_.particles_are_coarse() ? sph_->stable_dt() :
                                              StepLimit();
}

template <int dim>
StepLimit Model<dim>::stable_dt() const
{
  return subcycling_.limit(fine_limit(), coarse_limit());
}

namespace
{
/// A part of a step: for a solver that steps finely a step, for the other one
/// the beginning, the middle or the end of one.
template <class Solver>
StepStatus take(Solver &solver, bool coarse, const TimeStep &whole, const TimeStep &part, bool first, bool last)
{
  if (!coarse)
    return solver.step(part);
  const StepStatus status = first ? solver.begin(whole, part) : solver.go_on(part);
  return last && status.ok ? solver.finish(whole) : status;
}
} // namespace

template <int dim>
StepStatus Model<dim>::step(const TimeStep &step)
{
  parts_ = subcycling_.on() ? subcycling_.parts(step, fine_limit().dt) : 1;
  StepStatus status;
  for (std::size_t j = 0; j < parts_ && status.ok; ++j)
    status = take_part(step, j);
  return status;
}

template <int dim>
StepStatus Model<dim>::take_part(const TimeStep &whole, std::size_t j)
{
  const bool     first = j == 0, last = j + 1 == parts_;
  const TimeStep part = subcycling_.part(whole, parts_, j);
  // Coarse particles push what carries them once, over their own kick.
  coupler_->gather(!subcycling_.particles_are_coarse() ? 1. : first ? whole.kick / part.kick : 0.);
  StepStatus status;
  if (fem_)
  {
    const Stopwatch watch(fem_seconds_);
    status = take(*fem_, subcycling_.mesh_is_coarse(), whole, part, first, last);
  }
  coupler_->drive();
  if (sph_ && status.ok)
  {
    const Stopwatch watch(sph_seconds_);
    status = take(*sph_, subcycling_.particles_are_coarse(), whole, part, first, last);
  }
  if (status.ok)
    coupler_->close(part);
  subcycling_.took(part);
  return status;
}

template <int dim>
double Model<dim>::parts_error(Party party) const
{
  return party == mesh_party ? (subcycling_.mesh_is_coarse() ? fem_->parts_error() : 0.) :
                               (subcycling_.particles_are_coarse() ? sph_->parts_error() : 0.);
}

template <int dim>
std::string Model<dim>::review()
{
  if (!subcycling_.on())
    return {};
  const double error = coupler_->balance().interface_work + parts_error(particle_party) + parts_error(mesh_party);
  if (!subcycling_.review(error, [this] { return ledger().kinetic; }))
    return {};
  return "the error of the interfaces has come to " + engineering(error) +
         " J by steps in parts, more than Subcycling/energy limit allows: particles and elements step alike from now on";
}

template <int dim>
void Model<dim>::snapshot()
{
  if (fem_)
    fem_->snapshot();
  if (sph_)
    sph_->snapshot();
  coupler_->snapshot();
  subcycling_.snapshot();
}

template <int dim>
void Model<dim>::restore()
{
  if (fem_)
    fem_->restore();
  if (sph_)
    sph_->restore();
  coupler_->restore();
  subcycling_.restore();
}

template <int dim>
void Model<dim>::save(ArchiveWriter &archive) const
{
  if (fem_)
    fem_->save(archive, "fem");
  if (sph_)
    sph_->save(archive, "sph");
  coupler_->save(archive, "coupling");
  subcycling_.save(archive, "coupling");
}

template <int dim>
void Model<dim>::load(const ArchiveReader &archive)
{
  if (fem_)
    fem_->load(archive, "fem");
  if (sph_)
    sph_->load(archive, "sph");
  coupler_->load(archive, "coupling");
  subcycling_.load(archive, "coupling");
}

template <int dim>
LedgerRow Model<dim>::ledger() const
{
  CouplingBalance coupling = coupler_->balance();
  for (const Party party : {mesh_party, particle_party})
  {
    const double error = parts_error(party);
    coupling.interface_work += error;
    (party == mesh_party ? coupling.work_on_mesh : coupling.work_on_particles) += error;
  }
  return ledger_row(fem_ ? fem_->balance() : Balance(), sph_ ? sph_->balance() : Balance(), coupling);
}

template <int dim>
Sample Model<dim>::sample(int body) const
{
  Sample sample;
  if (fem_)
    sample = fem_->sample(body);
  if (sph_ && sample.mass.empty())
    sample = sph_->sample(body);
  return sample;
}

template <int dim>
std::vector<fem::TieReport> Model<dim>::ties() const
{
  return fem_ ? fem_->ties() : std::vector<fem::TieReport>();
}

template <int dim>
std::vector<fem::MeshQuality> Model<dim>::mesh_qualities(const input::Scene &scene) const
{
  const auto                    materials = build_materials(scene);
  std::vector<fem::MeshQuality> qualities;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (const input::Body &body = scene.bodies[b]; body.method == input::Method::fem)
      qualities.push_back(fem::measure_quality(
        fem::make_mesh<dim>(body, scene, static_cast<int>(b), materials.at(body.material)), body.name, scene.fem));
  return qualities;
}

template <int dim>
std::vector<double> Model<dim>::wall_forces() const
{
  std::vector<double> force(n_walls_, 0.);
  for (std::size_t w = 0; w < n_walls_; ++w)
    force[w] = (fem_ ? fem_->wall_force(w) : 0.) + (sph_ ? sph_->wall_force(w) : 0.);
  return force;
}

template <int dim>
double Model<dim>::contact_force() const
{
  double force = 0;
  for (const auto &[first, second] : contact_bodies_)
    force += coupler_->contact_force(first, second).norm();
  return force;
}

template class Model<1>;
template class Model<2>;
template class Model<3>;
} // namespace ogive::coupling
