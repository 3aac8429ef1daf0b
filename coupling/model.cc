// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/model.h"

#include "core/base/error.h"
#include "core/materials/hugoniot.h"
#include "core/materials/started_material.h"
#include "coupling/healing.h"
#include "coupling/joined_sample.h"
#include "coupling/stopwatch.h"
#include "fem/mesh.h"
#include "sph/fill.h"

#include <algorithm>
#include <map>
#include <utility>

namespace ogive::coupling
{
namespace
{
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

/// Elements at the faces that boundaries act on: those stay elements.
template <int dim>
std::vector<std::uint32_t> held_elements(const input::Scene &scene, const input::Body &body,
                                         const fem::BodyMesh<dim> &mesh)
{
  std::vector<std::uint32_t> held;
  for (const input::Boundary &boundary : scene.boundaries)
    for (const auto &facet : mesh.facets)
      if (boundary.body == body.name && boundary.kind != input::BoundaryKind::body_force &&
          mesh.is_called(facet.boundary, boundary.face))
        held.push_back(facet.cell);
  return held;
}

/// Room for the particles of a body that has none yet.
template <int dim>
sph::BodyParticles<dim> no_particles(const input::Body &body, int index,
                                     std::shared_ptr<const materials::Material> material)
{
  sph::BodyParticles<dim> cloud;
  cloud.body     = index;
  cloud.material = std::move(material);
  cloud.spacing  = body.spacing / body.conversion.per_edge;
  cloud.shape    = body.shape;
  cloud.grows    = true;
  return cloud;
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

/// Contact pushes once a step, with a stiffness that goes with 1/step^2: where a
/// body of elements is in contact, elements part their steps only if told to.
input::FemOptions fem_options(const input::Scene &scene)
{
  input::FemOptions options = scene.fem;
  for (const input::Contact &contact : scene.contacts)
    for (const std::string &name : {contact.first, contact.second})
      if (options.local_steps == "auto" && scene.bodies[body_index(scene, name)].method != input::Method::sph)
        options.local_steps = "none";
  return options;
}

template <int dim>
void set_velocity(sph::BodyParticles<dim> &particles, const Setup &setup)
{
  for (std::size_t i = 0; setup.velocity && i < particles.x.size(); ++i)
  {
    Vec3 x = Vec3::Zero();
    std::copy(particles.x[i].begin(), particles.x[i].end(), x.data());
    const Vec3 v = setup.velocity(particles.body, x);
    std::copy_n(v.data(), dim, particles.v[i].begin());
  }
}

template <int dim>
void set_velocity(fem::BodyMesh<dim> &mesh, const Setup &setup)
{
  for (std::size_t i = 0; setup.velocity && i < mesh.n_nodes(); ++i)
  {
    Vec3 x = Vec3::Zero();
    for (int a = 0; a < dim; ++a)
      x[a] = mesh.x[a][i];
    const Vec3 v = setup.velocity(mesh.body, x);
    for (int a = 0; a < dim; ++a)
      mesh.v[a][i] = v[a];
  }
}
} // namespace

template <int dim>
Model<dim>::Model(const input::Scene &scene, const Setup &setup, const Ranks &ranks)
  : ranks_(ranks)
  , n_walls_(scene.walls.size())
{
  build(scene, setup, {});
  if (const auto moves = coupler_->moves(); !moves.empty())
  {
    const auto healed = coupler_->healed();
    coupler_.reset();
    conversion_.reset();
    mesh_notes_.clear();
    contact_bodies_.clear();
    build(scene, setup, moves);
    coupler_->report_healed(healed);
  }
}

template <int dim>
void Model<dim>::build(const input::Scene &scene, const Setup &setup, const std::vector<Move> &moves)
{
  const auto                              materials = build_materials(scene);
  std::vector<fem::BodyMesh<dim>>         meshes;
  std::vector<sph::BodyParticles<dim>>    clouds;
  std::vector<std::pair<int, std::vector<std::uint32_t>>> held; // of bodies that convert
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
  {
    const input::Body &body     = scene.bodies[b];
    const auto         material = materials.at(body.material);
    if (body.method != input::Method::sph)
    {
      meshes.push_back(fem::make_mesh<dim>(body, scene, static_cast<int>(b), material));
      set_velocity(meshes.back(), setup);
      for (const std::string &note : meshes.back().notes)
        mesh_notes_.push_back("body \"" + body.name + "\": " + note);
    }
    if (body.method == input::Method::automatic)
    {
      held.emplace_back(static_cast<int>(b), held_elements(scene, body, meshes.back()));
      clouds.push_back(no_particles<dim>(body, static_cast<int>(b), material));
    }
    if (body.method == input::Method::sph)
    {
      clouds.push_back(sph::fill<dim>(body, scene, static_cast<int>(b), material));
      set_velocity(clouds.back(), setup);
      start(clouds.back(), body);
    }
  }
  if (!moves.empty())
    move_points<dim>(moves, scene, meshes, clouds);
  if (!meshes.empty())
    fem_ = std::make_unique<fem::Solver<dim>>(
      fem::Parameters{fem_options(scene), scene.dimension == input::Dimension::axisymmetric, scene.symmetry, scene.walls,
                      scene.boundaries, boundary_bodies(scene), mesh_ties(scene), ranks_, scene.parallel},
      std::move(meshes));
  if (!clouds.empty())
    sph_ = std::make_unique<sph::Solver<dim>>(
      sph::Parameters{scene.sph, scene.dimension == input::Dimension::axisymmetric, scene.symmetry, scene.walls,
                      scene.boundaries, boundary_bodies(scene), setup.mirrors, scene.parallel, ranks_},
      std::move(clouds));
  if (!held.empty())
  {
    conversion_ = std::make_unique<Conversion<dim>>(scene, *fem_, *sph_, held);
    conversion_->begin();
  }
  coupler_ = std::make_unique<Coupler<dim>>(scene, fem_.get(), sph_.get(), ranks_);
  begin_parts(scene);
  for (const input::Contact &contact : scene.contacts)
    contact_bodies_.emplace_back(body_index(scene, contact.first), body_index(scene, contact.second));
}

template <int dim>
std::vector<ConversionEvent> Model<dim>::convert(std::int64_t step, double time)
{
  if (!conversion_)
    return {};
  const Stopwatch watch(sph_seconds_);
  auto            events = conversion_->convert(step, time);
  if (!events.empty())
  {
    fem_->refresh_all(); // riders find their places in elements that lie deep
    coupler_->renew();
  }
  return events;
}

template <int dim>
void Model<dim>::snapshot()
{
  if (conversion_)
    conversion_->snapshot();
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
  if (conversion_)
    conversion_->restore();
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
  if (conversion_)
    conversion_->save(archive, "conversion");
  if (fem_)
    fem_->save(archive, "fem");
  if (sph_)
    sph_->save(archive, "sph");
  coupler_->save(archive, "coupling");
  subcycling_.save(archive, "coupling");
  if (fem_ && fem_->local_plan().on)
    archive.write("coupling/local_reference", local_reference_);
}

template <int dim>
void Model<dim>::load(const ArchiveReader &archive)
{
  if (conversion_)
    conversion_->load(archive, "conversion");
  if (fem_)
    fem_->load(archive, "fem");
  if (sph_)
    sph_->load(archive, "sph");
  coupler_->load(archive, "coupling");
  subcycling_.load(archive, "coupling");
  if (fem_ && fem_->local_plan().on)
    local_reference_ = archive.number("coupling/local_reference");
}

template <int dim>
LedgerRow Model<dim>::ledger() const
{
  CouplingBalance coupling = coupler_->balance();
  if (conversion_)
    coupling.conversion_heat += conversion_->heat();
  for (const Party party : {mesh_party, particle_party})
  {
    const double error = parts_error(party);
    coupling.interface_work += error;
    (party == mesh_party ? coupling.work_on_mesh : coupling.work_on_particles) += error;
  }
  return ledger_row(fem_ ? fem_->balance() : Balance(), sph_ ? sph_->balance() : Balance(), coupling);
}

template <int dim>
Sample Model<dim>::mesh_sample(int body) const
{
  return fem_ ? fem_->sample(body) : Sample();
}

template <int dim>
Sample Model<dim>::particle_sample(int body) const
{
  return sph_ ? sph_->sample(body) : Sample();
}

template <int dim>
Sample Model<dim>::sample(int body) const
{
  Sample mesh = mesh_sample(body), particles = particle_sample(body);
  if (particles.mass.empty())
    return mesh;
  return mesh.mass.empty() ? particles : joined(std::move(mesh), particles);
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
    if (const input::Body &body = scene.bodies[b]; body.method != input::Method::sph)
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
