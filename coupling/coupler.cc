// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/coupler.h"

#include "core/base/error.h"
#include "coupling/common_particles.h"

#include <algorithm>

namespace ogive::coupling
{
namespace
{
int body_named(const input::Scene &scene, const std::string &name, const std::string &who)
{
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (scene.bodies[b].name == name)
      return static_cast<int>(b);
  throw InputError({scene.file, 0, who}, "there is no body \"" + name + "\"");
}

Party party_of(const input::Scene &scene, int body)
{
  return scene.bodies[body].method == input::Method::sph ? particle_party : mesh_party;
}

/// What a body is made of, or may be in time.
std::vector<Party> parties_of(const input::Scene &scene, int body)
{
  return scene.bodies[body].method == input::Method::automatic ? std::vector<Party>{mesh_party, particle_party} :
                                                                 std::vector<Party>{party_of(scene, body)};
}

/// Of the particles that a body's elements may turn into, m; 0 for other bodies.
double coming_radius(const input::Body &body)
{
  return body.method == input::Method::automatic ? .5 * body.spacing / body.conversion.per_edge : 0.;
}

/// Which pairs of a body of particles are the particle solver's: within its
/// support, by places of now; or by those of t = 0, with room for what a contact
/// sees of a lattice that is bent and squeezed.
void set_joined(const input::Scene &scene, ContactSpec &spec)
{
  const input::SphOptions options = scene.sph.settled();
  const input::Body      &body    = scene.bodies[spec.first];
  const double            spacing =
    body.method == input::Method::automatic ? body.spacing / body.conversion.per_edge : body.spacing;
  spec.joined_at_start = options.configuration == "reference";
  spec.joined_within   = (options.kernel == "quintic" ? 3 : 2) * options.h_over_dx * spacing;
  if (spec.joined_at_start)
    spec.joined_within = std::max(spec.joined_within, 3.5 * spacing);
}

/// Seams of particles and elements: those of the scene, and one within each body
/// with method auto that the scene says nothing of.
std::vector<input::Interface> seams_of(const input::Scene &scene)
{
  std::vector<input::Interface> seams;
  for (const auto &entry : scene.interfaces)
    if (!entry.joins_meshes()) // else the mesh solver's own affair
      seams.push_back(entry);
  for (const auto &body : scene.bodies)
    if (body.method == input::Method::automatic &&
        std::none_of(seams.begin(), seams.end(), [&](const auto &i) { return i.body == body.name; }))
    {
      input::Interface seam;
      seam.name   = body.name + "-seam";
      seam.body   = body.name;
      seam.method = "pair-flux";
      seams.push_back(seam);
    }
  return seams;
}

/// Cuts of the model: symmetry planes and the axis of rotation.
std::vector<int> cut_axes(const input::Scene &scene)
{
  std::vector<int> axes;
  for (const auto &plane : scene.symmetry)
    axes.push_back(plane.axis);
  if (scene.dimension == input::Dimension::axisymmetric)
    axes.push_back(0);
  return axes;
}
} // namespace

template <int dim>
Coupler<dim>::Coupler(const input::Scene &scene, std::unique_ptr<MeshPort<dim>> mesh,
                      std::unique_ptr<ParticlePort<dim>> particles, const Ranks &ranks)
  : ranks_(ranks)
  , mesh_(std::move(mesh))
  , particles_(std::move(particles))
  , axisymmetric_(scene.dimension == input::Dimension::axisymmetric)
{
  if (particles_ && !ranks_.alone())
    particles_ = std::make_unique<CommonParticles<dim>>(ranks_, std::move(particles_));
  build_interfaces(scene);
  build_contacts(scene);
}

template <int dim>
Coupler<dim>::~Coupler() = default;

template <int dim>
void Coupler<dim>::build_interfaces(const input::Scene &scene)
{
  for (const input::Interface &entry : seams_of(scene))
  {
    InterfaceSpec spec;
    const bool    within = !entry.body.empty();
    spec.name           = entry.name;
    spec.method         = entry.method;
    spec.particle_body  = within ? entry.body : entry.particles;
    spec.mesh_body      = within ? entry.body : entry.mesh;
    spec.particles      = body_named(scene, spec.particle_body, entry.name);
    spec.mesh           = body_named(scene, spec.mesh_body, entry.name);
    spec.symmetry_axes  = cut_axes(scene);
    spec.axisymmetric   = axisymmetric_;
    spec.damping        = entry.damping;
    spec.pair_viscosity = entry.pair_viscosity;
    spec.per_edge       = within ? static_cast<int>(scene.bodies[spec.mesh].conversion.per_edge) : 0;
    if (within && spec.method != "pair-flux")
      throw InputError({scene.file, 0, "Interfaces/" + entry.name},
                       "the seam of a body whose elements turn into particles moves, and \"" + spec.method +
                         "\" does not follow",
                       "method = pair-flux");
    if (!within && (party_of(scene, spec.particles) != particle_party || party_of(scene, spec.mesh) != mesh_party))
      throw InputError({scene.file, 0, entry.name},
                       "an interface joins a body of particles and a body of elements",
                       "\"" + entry.particles + "\" with method sph and \"" + entry.mesh +
                         "\" with method fem");
    require(mesh_ && particles_, "an interface needs both solvers");
    interfaces_.push_back(make_interface(spec, *mesh_, *particles_, slaves_));
    interface_names_.push_back(entry.name);
  }
  if (!slaves_.id.empty())
    particles_->set_slaves(slaves_.id);
}

template <int dim>
void Coupler<dim>::build_contacts(const input::Scene &scene)
{
  std::vector<ContactSpec> specs;
  for (const auto &entry : scene.contacts)
  {
    ContactSpec spec;
    spec.name      = entry.name;
    spec.first     = body_named(scene, entry.first, entry.name);
    spec.second    = body_named(scene, entry.second, entry.name);
    spec.friction  = entry.friction;
    spec.stiffness = entry.stiffness;
    spec.overlap   = entry.overlap;
    if (!(entry.stiffness > 0 && entry.stiffness <= .1))
      throw InputError({scene.file, 0, entry.name},
                       "contact stiffness " + std::to_string(entry.stiffness) + " is out of range",
                       "more than 0 and at most .1, so that contact does not set the step");
    if (!(entry.friction >= 0))
      throw InputError({scene.file, 0, entry.name}, "negative friction", "a coefficient >= 0");
    spec.first_radius  = coming_radius(scene.bodies[spec.first]);
    spec.second_radius = coming_radius(scene.bodies[spec.second]);
    for (const Party first : parties_of(scene, spec.first))
      for (const Party second : parties_of(scene, spec.second))
      {
        // Within a body of both kinds the seam joins them.
        if (spec.first == spec.second && first != second)
          continue;
        spec.first_party  = first;
        spec.second_party = second;
        if (spec.meets_itself() && first == particle_party)
          set_joined(scene, spec);
        specs.push_back(spec);
      }
  }
  // The tied masses are on the nodes by now, so this is the step of the run.
  StepLimit limit;
  double    share = 0;
  if (mesh_)
  {
    limit.tighten(mesh_->stable_dt());
    share = std::max(share, scene.fem.step_factor);
  }
  if (particles_)
  {
    limit.tighten(particles_->stable_dt());
    share = std::max(share, scene.sph.step_factor);
  }
  contacts_ = std::make_unique<ContactSet<dim>>(std::move(specs), cut_axes(scene), limit.dt,
                                                std::min(share, .95), ranks_);
  const auto faces = Faces<dim>::look(mesh_.get(), particles_.get());
  moves_           = contacts_->healing(faces, healed_);
  contacts_->start(faces);
  if (particles_)
    particles_->attend(contacts_->attention());
}

template <int dim>
void Coupler<dim>::renew()
{
  for (auto &interface : interfaces_)
    interface->renew();
}

template <int dim>
void Coupler<dim>::gather(double own_share)
{
  auto faces = Faces<dim>::look(mesh_.get(), particles_.get());
  faces.particle_share = own_share;
  faces.clear_forces();
  contacts_->gather(faces);
  if (const auto pieces = contacts_->new_pieces(); !pieces.empty())
    particles_->set_pieces(pieces);
  if (particles_)
    particles_->give_forces();
  if (interfaces_.empty())
    return;
  std::array<std::span<double>, dim> force;
  for (int a = 0; a < dim; ++a)
    force[a] = slaves_.force[a];
  particles_->slave_forces(force);
  if (own_share != 1)
    share_slave_forces(faces, own_share);
  for (auto &interface : interfaces_)
    interface->gather(faces, slaves_);
}

/// Contact acts in every part of a step, the particles' own forces once.
template <int dim>
void Coupler<dim>::share_slave_forces(const Faces<dim> &faces, double own_share)
{
  const auto &particles = faces[particle_party];
  for (std::size_t s = 0; s < slaves_.id.size(); ++s)
  {
    const std::uint32_t i = faces.particle_index[slaves_.id[s]];
    for (int a = 0; a < dim; ++a)
    {
      const double contact  = particles.force[a][i];
      slaves_.force[a][s] = contact + own_share * (slaves_.force[a][s] - contact);
    }
  }
}

template <int dim>
void Coupler<dim>::drive()
{
  if (interfaces_.empty())
    return;
  const auto faces = Faces<dim>::look(mesh_.get(), nullptr);
  for (const auto &interface : interfaces_)
    interface->drive(faces, slaves_);
  std::array<std::span<const double>, dim> velocity;
  for (int a = 0; a < dim; ++a)
    velocity[a] = slaves_.velocity[a];
  particles_->drive_slaves(velocity);
}

template <int dim>
void Coupler<dim>::close(const TimeStep &step)
{
  const auto faces = Faces<dim>::look_again(mesh_.get(), particles_.get());
  contacts_->close(faces, step);
  for (auto &interface : interfaces_)
    interface->close(faces, slaves_, step);
}

template <int dim>
StepLimit Coupler<dim>::stable_dt() const
{
  return contacts_->stable_dt();
}

template <int dim>
CouplingBalance Coupler<dim>::balance() const
{
  const auto     &contact = contacts_->energy();
  CouplingBalance balance;
  balance.contact_stored    = contact.stored;
  balance.friction_heat     = contact.friction_heat;
  balance.contact_taken     = contact.taken;
  balance.contact_eroded    = contact.eroded;
  balance.contact_loss      = contact.loss();
  balance.work_on_mesh      = contact.work[mesh_party];
  balance.work_on_particles = contact.work[particle_party];
  balance.contact_impulse   = contacts_->impulse();
  balance.plane_impulse.head<dim>() = contacts_->plane_impulse();
  if (axisymmetric_) // the radial momenta of a ring cancel
    balance.plane_impulse[0] = 0;
  for (const auto &interface : interfaces_)
  {
    balance.interface_work += interface->energy().residue();
    balance.work_on_mesh += interface->energy().work_on_mesh;
    balance.work_on_particles += interface->energy().work_on_particles;
  }
  return balance;
}

template <int dim>
void Coupler<dim>::snapshot()
{
  contacts_->snapshot();
  for (auto &interface : interfaces_)
    interface->snapshot();
}

template <int dim>
void Coupler<dim>::restore()
{
  if (particles_)
    particles_->forget();
  contacts_->restore();
  for (auto &interface : interfaces_)
    interface->restore();
}

template <int dim>
void Coupler<dim>::save(ArchiveWriter &archive, const std::string &prefix) const
{
  contacts_->save(archive, prefix);
  for (std::size_t i = 0; i < interfaces_.size(); ++i)
    interfaces_[i]->save(archive, prefix + "/" + interface_names_[i]);
}

template <int dim>
void Coupler<dim>::load(const ArchiveReader &archive, const std::string &prefix)
{
  if (particles_)
    particles_->forget();
  contacts_->load(archive, prefix);
  for (std::size_t i = 0; i < interfaces_.size(); ++i)
    interfaces_[i]->load(archive, prefix + "/" + interface_names_[i]);
}

template class Coupler<1>;
template class Coupler<2>;
template class Coupler<3>;
} // namespace ogive::coupling
