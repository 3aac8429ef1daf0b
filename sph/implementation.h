// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/parallel/halo.h"
#include "sph/axis_factor.h"
#include "sph/ghosts.h"
#include "sph/images.h"
#include "sph/neighbours.h"
#include "sph/solver.h"
#include "sph/step_bound.h"
#include "sph/store.h"
#include "sph/sweep.h"
#include "sph/territory.h"
#include "sph/viscosity/pair.h"

#include <Eigen/Core>

#include <algorithm>
#include <optional>

namespace ogive::sph
{
/// Amounts that prescribed motion and walls did so far, J, and the impulse that
/// they and the symmetry planes gave, N s.
struct Works
{
  double external = 0, wall_loss = 0, friction = 0;
  Vec3   impulse  = Vec3::Zero();
  /// Pull of each wall's images not yet made good by later pressure, N s, <= 0:
  /// friction waits for it, so that in the sum it is mu times the net impulse.
  std::vector<double> pull{};
  std::vector<double> seam{}; ///< by body of particles, see Solver::seam_work
  /// Energy that steps in parts gave the particles and took from no pair, J.
  double parts_error = 0;
};

/// What the reference configuration keeps; empty in the current one. But for
/// the deformation all of it follows from the first state.
struct ReferenceState
{
  bool                  on = false;
  AlignedVector<double> deformation;    ///< F = dx/dX, column by column
  AlignedVector<double> inverse_moment; ///< B0, column by column
  std::size_t           own = 0; ///< particles of this rank, in the next three before those of other ranks
  AlignedVector<double> volume, density, modulus; ///< V0, m^dim; rho0; c of reference/sweeps.h at first, Pa
  AlignedVector<double> wave_number;    ///< step_bound.h, of the lattice at rest, 1/m
  AlignedVector<double> stiffness;      ///< of the hourglass potential over mass, 1/s^2
  AlignedVector<double> records, slope, viscous_slope; ///< see Sweep
  std::size_t           fallbacks = 0;  ///< particles with B0 = I
};

/// Blocks of particles and what they see, see rest.cc.
struct Rest
{
  static constexpr std::size_t block = 64; ///< particles

  bool                       on = false;
  std::vector<std::size_t>   row{0}; ///< block k sees the blocks sees[row[k] .. row[k+1])
  std::vector<std::uint32_t> sees;
  std::vector<char>          bound;   ///< has pairs with images of walls or riders: swept always
  std::vector<char>          has_guests; ///< has pairs with particles of other ranks: the same
  std::vector<char>          changed; ///< since the last gradient sweep
};

/// Inside the solver. rest.cc: sweeps left out; solver.cc: the public face; phases.cc: the phases of a
/// step; viscous.cc, correct.cc, support.cc: forces, the correction and its
/// support; motion.cc: kick, boundaries, drift; lists.cc: rebuild and records;
/// images.cc: images behind rigid walls; surface.cc: what contact sees;
/// exchange.cc, migrate.cc, stale.cc: particles of other ranks, whose a particle
/// is, and when lists are too old;
/// substeps.cc: steps in parts; reference/reference.cc: the reference configuration; axis.cc: axial symmetry;
/// state.cc: snapshots and checkpoints.
template <int dim>
struct Solver<dim>::Implementation
{
  using L = Layout<dim>;
  using V = ViscousLayout<dim>;
  using Function = typename SweepFunctions::Function SweepFunctions::*;
  template <class T>
  using PerAxis = std::array<T, dim>;
  using Vector  = Eigen::Matrix<double, dim, 1>;
  using Matrix  = Eigen::Matrix<double, dim, dim>;

  struct Body
  {
    int                                        scene = 0; ///< index into Scene::bodies
    std::size_t                                first = 0, last = 0;
    std::size_t                                first_rider = 0, last_rider = 0; ///< behind all particles of all bodies
    std::size_t                                all = 0, all_riders = 0; ///< of all ranks
    double                                     spacing = 0, h = 0, skin = 0;
    PerAxis<double>                            half_cell{}; ///< at the start, m
    std::shared_ptr<const materials::Material> material;
    SweepFunctions                             sweeps;
    double                                     list_radius = 0;
    double                                     self_value  = 0; ///< W(0; h_c)
    double                                     centre_value = 0; ///< W(0; h)
    PerAxis<std::vector<double>>               rider_velocity; ///< of the step, by rider
    materials::Points                          rider_state;
    double                                     seam_hourglass = 1; ///< factor of the hourglass control next to riders
    bool                                       grows = false; ///< particles may come in
  };

  /// A particle of another rank, as it is first told of (exchange.cc).
  struct Guest
  {
    PerAxis<double> x{};
    std::int64_t    id    = 0;
    std::int32_t    body  = 0; ///< index into bodies
    std::int32_t    rides = 0;
  };

  Parameters        parameters;
  Ranks             ranks;
  bool              standard = false, correction = false, summation = false;
  bool              variable = false; ///< support of the correction
  bool              sensed   = false; ///< something asks for the sums of the sensor sweep
  bool              joint    = false; ///< each pair once, forces in one sweep (half/)
  LatticeShares     shares;
  std::optional<AxisFactor> axis_factor; ///< where the scene turns about an axis
  int               viscous_terms  = 1; ///< numbers a pair that a viscosity keeps
  std::size_t       viscous_stride = 0; ///< of its records
  std::vector<Body> bodies;
  Store<dim>        store;
  ReferenceState    reference;

  // Ranks: what a run's course decides, part of the state.
  Territory<dim> territory;
  std::size_t    cut_at = 0; ///< particles of all ranks when it was cut
  std::uint64_t  steps  = 0;

  Rest           rest;

  // Follow from the store.
  Halo                                    halo;
  std::vector<std::int64_t>               guest_id; ///< by ghost; of images 0
  std::vector<std::vector<Guest>>         guests;   ///< by rank, while lists are built
  std::vector<std::vector<std::uint32_t>> give, take; ///< beside them: records that go and come
  std::vector<char>          near_wall;  ///< by body and wall, at the positions of the lists
  Ghosts                     ghosts;
  Pairs                      pairs;
  std::vector<Images>        images;
  std::vector<int>           wall_axis; ///< of walls across an axis, or -1
  std::vector<std::int64_t>  active;    ///< bit w: images behind wall w act; by record, of images unused
  std::vector<double>        friction_share; ///< see share_friction(), of each wall
  std::vector<double>        press;     ///< velocity that wall w's images gave particle i in the kick
  AlignedVector<double>      force_records, viscous_records, sensor_records, stress_records, correction_records,
    energy_records, record_damage;
  AlignedVector<double> gradient_sums, mass_sums, sensor_sums, force_sums, viscous_sums, mean_sums, power_sums;
  AlignedVector<double> unasked = AlignedVector<double>(simd_width); ///< see Sweep::viscosity_step
  AlignedVector<double> velocity_gradient; ///< column by column, corrected where the form is, 1/s
  AlignedVector<double> reach;             ///< h_c of each particle, where supports vary, m
  AlignedVector<double> corrected;         ///< force of the correction alone, where the energy form asks, N
  AlignedVector<double> hoop_force, hoop_viscosity, hoop_weak; ///< radial forces of axis.cc, N
  AlignedVector<double>      wave_number; ///< step_bound.h, 1/m, of the last gradient sweep
  std::vector<std::uint32_t> index_of_id; ///< of particles of other ranks Solver::elsewhere
  std::vector<std::int64_t>  near_surface; ///< kept through a rebuild's first sweep: part of the state
  std::vector<std::uint32_t> contact_points;
  std::vector<std::int64_t>  pieces; ///< by id, see set_pieces(): part of the state
  bool                       pieces_stale = false; ///< the lists are of others
  AlignedVector<double>      radius;
  bool                       surface_stale = true;
  std::int64_t               failed        = 0; ///< particles with damage >= 1, of all ranks

  std::vector<std::int64_t>           slave_ids;
  std::vector<char>                   is_slave; ///< by id
  std::vector<double>                 energy_share; ///< by id, see Solver::weigh; empty: 1
  PerAxis<std::vector<double>>        slave_velocity; ///< by id

  PerAxis<AlignedVector<double>>      part_first, part_path, part_shift; ///< within a step in parts (substeps.cc)

  double              time = 0, time_listed = 0; ///< of x and of x_listed, s
  Works               works;
  std::vector<double> wall_forces;
  std::uint64_t       updates  = 0;
  std::uint64_t       topology = 1;
  Diagnostics         diagnostics;

  struct State;
  std::unique_ptr<State> kept;

  Implementation(const Parameters &, std::vector<BodyParticles<dim>>);
  ~Implementation();

  // growth.cc
  void   size_arrays();
  Body  &body_of(int scene);
  void   check_growth() const;
  void   rearrange(const std::vector<std::size_t> &from);
  void   put(const Newcomers<dim> &, const std::vector<std::size_t> &which, std::size_t first);
  std::vector<std::size_t> own_of(const Newcomers<dim> &) const;
  void   settle();
  void   fit_between_walls(const Body &, std::size_t first, std::size_t last);
  void   prepare_riders(Body &);
  void   kick_riders();
  void   take_rider_states();
  void   unit_seam(const Body &, const std::array<std::span<double>, dim> &area);
  /// Power of the pairs with riders in the sums of the last energy sweep, and,
  /// where asked, of their forces on the particles, W.
  void add_power_at_seam(bool with_forces, double kick);
  /// Particles without riders: [0, n_own()).
  std::size_t n_own() const { return bodies.empty() ? 0 : bodies.back().last; }
  /// Particles of all ranks.
  std::size_t n_all() const
  {
    std::size_t n = 0;
    for (const auto &b : bodies)
      n += b.all;
    return n;
  }
  /// On any rank.
  bool any_riders() const
  {
    return std::any_of(bodies.begin(), bodies.end(), [](const Body &b) { return b.all_riders > 0; });
  }
  /// The pairs of particles with riders; images without a wall.
  Images       &seam() { return images.back(); }
  const Images &seam() const { return images.back(); }
  bool          seam_pairs(const Body &b, std::size_t i) const
  {
    return b.all_riders > 0 && seam().pairs.rows.row[i] < seam().pairs.rows.row[i + 1];
  }
  template <class F>
  void for_each_rider_range(F &&f) const
  {
    for (const auto &b : bodies)
      if (b.first_rider < b.last_rider)
        f(b, b.first_rider, b.last_rider);
  }

  // exchange.cc
  void         call_guests();
  std::array<std::size_t, 2> place_guests(std::size_t body, bool rides, PerAxis<std::vector<double>> &x);
  void         seat_guests();
  std::int64_t id_of_record(std::uint32_t record) const; ///< of images that of what they mirror
  /// Fields [first, last) of the records of guests, from their owners.
  void exchange(AlignedVector<double> &records, std::size_t stride, std::size_t first, std::size_t last) const;
  void exchange(std::vector<std::int64_t> &bits) const; ///< by record

  // migrate.cc
  std::vector<std::vector<std::int64_t>> take_own(std::vector<BodyParticles<dim>> &);
  void   cut(const PerAxis<std::vector<double>> &x, const std::vector<double> &weight, std::size_t of);
  double work_of(std::size_t i) const; ///< counted, in directed pairs
  double own_work() const;             ///< of all particles of this rank
  bool   is_uneven();
  bool   has_grown() const;
  void   share_out(bool anew);
  void   move_to(const std::vector<int> &owner);

  // stale.cc
  bool   lists_are_stale() const;
  double least_gap(const Body &, std::size_t w, const PerAxis<AlignedVector<double>> &x, double at) const;
  void   find_near_walls();
  /// Whether a particle is closer to wall w than a spacing, at the positions of the lists.
  bool   is_near(std::size_t body, std::size_t w) const { return near_wall[body * wall_axis.size() + w]; }
  bool   is_mirrored(std::size_t body, int axis) const;
  std::vector<double> drift_of_bodies() const;
  double most_moved(std::size_t first, std::size_t last, const PerAxis<double> &drifted, const PerAxis<double> &apart) const;

  // rest.cc
  void              find_blocks(); ///< on fresh lists
  std::vector<char> who_sees(const std::vector<char> &blocks) const;
  /// Blocks that see a vector other than zero in field `first` of the records.
  std::vector<char> blocks_with(const AlignedVector<double> &records, std::size_t stride, std::size_t first) const;
  void              note_motion(std::size_t i, const double *fresh); ///< the first fields of its force record
  /// A sweep over the pairs of all bodies, but for blocks that are not awake.
  void sweep_awake(Function, AlignedVector<double> &sums, const std::vector<char> *awake);

  // lists.cc
  std::size_t bytes() const;
  void sort_particles();
  void rebuild_lists(); ///< from store.x_listed
  void size_pairs(Pairs &) const;
  /// Ghosts of all bodies and riders, their positions behind those of the own in x.
  void list_ghosts(PerAxis<std::vector<double>> &x, std::vector<std::array<std::size_t, 2>> &images_of_riders);
  void list_images(const std::array<std::span<const double>, dim> &x);
  /// Drops the pairs of two pieces.
  void part_pieces(NeighbourRows &) const;
  void list_riders(const std::array<std::span<const double>, dim> &x, const std::vector<std::array<std::size_t, 2>> &images_of_riders);
  void pack_motion();
  void reflect_motion();
  void reflect_forces();
  void reflect_shares(); ///< sound speed and shock share of joint forces
  Sweep sweep_of(const Body &, Pairs &, double *sums);
  Sweep rider_sweep_of(const Body &, double *sums);

  // images.cc
  void   find_wall_axes();
  double gap(std::size_t w, double x, double at) const; ///< from wall w to coordinate x at a time, m
  /// Distance at which particle i lies on wall w, m: half of its cell at the start. Of rings
  /// half the height of their cell across the wall, if that is less, so that
  /// layers that are squeezed flat lie flat on it; without the hold of the hoop,
  /// in space or a plane, such layers run out as a film (the foot of the copper
  /// bar of 7.2 mm came out at 8.2 mm).
  double rest_gap(const Body &, std::size_t i, std::size_t w) const;
  void   begin_on_walls(); ///< moves what begins within its rest gap to it: jittered particles
  void   touch_walls(); ///< from x, v, time and the stress of the step before
  void   find_active();
  /// `guests`: records of other ranks' particles of each body.
  void   append_images(Images &, const std::array<std::span<const double>, dim> &x,
                       const std::vector<std::array<std::size_t, 2>> &guests);
  std::vector<std::array<std::int64_t, 4>> touched_cells() const;
  double shift(std::size_t g, int axis, double at) const; ///< x_image = sign x + shift
  double shift_rate(std::size_t g, int axis) const;
  double share(std::size_t g) const; ///< 1 where the image acts, 0 where not
  bool   acts(const Images &m, std::size_t i) const { return (active[i] & m.bits) == m.bits; }
  void   sweep_images(void (*SweepFunctions::*sweep)(const Sweep &), AlignedVector<double> Images::*sums);
  /// Adds the fields [first, last) of the images' sums.
  void   add_images(const AlignedVector<double> Images::*from, std::size_t stride, std::size_t first,
                    std::size_t last, AlignedVector<double> &to);
  void   book_images(double kick);

  /// A sweep over all bodies, images behind walls included, into or onto `sums`.
  /// `half`: what takes its place where each pair is seen once.
  void sweep_all(Function, AlignedVector<double> &sums, std::size_t stride, std::size_t n_fields, Function half = nullptr,
                 const std::vector<char> *awake = nullptr);
  void sweep_riders_too(Function, AlignedVector<double> &sums, std::size_t stride, std::size_t n_fields,
                        const std::vector<char> *awake = nullptr);
  void add_all(Function, AlignedVector<double> &sums, std::size_t stride, std::size_t n_fields);
  bool is_used(Function f) const { return bodies.front().sweeps.*f != nullptr; }
  /// Records of the images from those of their parents: `vectors` fields first,
  /// each of dim components.
  double *image_record(AlignedVector<double> &records, std::size_t stride, std::size_t g) const
  {
    return &records[(store.size() + g) * stride];
  }

  // solver.cc
  StepStatus arrive(const TimeStep &); ///< all that follows from new positions

  // phases.cc
  /// Gradients at x(t_n); with dt > 0 also the material's step.
  StepStatus advance_material(double dt);
  void       energy(double kick);
  void       sum_masses(); ///< sum m W, without self
  double     mass_sum(const Body &b, std::size_t i) const
  {
    return mass_sums[i * padded(1)] + store.mass[i] * b.centre_value;
  }

  // reference/reference.cc
  void check_reference() const; ///< InputError for what it cannot hold
  void begin_reference();       ///< from the first state
  /// On other ranks than those of the first state, which had the particles `ids`, rank after rank.
  void begin_reference_again(const ReferenceState &first, const std::vector<std::int64_t> &ids);
  void set_reference();         ///< all that follows, on fresh lists
  void pack_lattice();          ///< X, V0 and rho0 into the force records
  void slopes_of(const Body &); ///< of its pairs
  bool deform(std::size_t i, double dt, Matrix &l, Matrix &b);
  void pack_reference(const Body &, std::size_t i, const Matrix &b);
  void reflect_reference();

  // viscous.cc
  void              forces();
  bool              joint_possible() const; ///< for the choice of methods
  void              join_forces();
  ViscousPoint<dim> viscous_point(const Body &, std::size_t i) const;
  void              sense(); ///< sums of the sensor sweep
  void              advance_switch(double dt);
  double            shock_share(const Body &, std::size_t i, const ViscousPoint<dim> &) const;
  double            strength(std::size_t i, const ViscousPoint<dim> &) const;
  void              pack_viscosity();
  void              sweep_viscosity();
  void              stress_artificially();

  // axis.cc
  double ring(std::size_t i) const;      ///< 2 pi r, m; 1 without an axis
  double hoop_rate(std::size_t i) const; ///< v_r/r, 1/s; 0 without an axis
  double axis_share(const Body &, std::size_t i) const; ///< AxisFactor, 1 without an axis
  void   add_hoop_stress();
  void   add_hoop_viscosity();
  void   heat_hoops();
  double ring_frequency(const Body &, std::size_t i, double plane) const;
  double inward_step(std::size_t i) const; ///< longest step in which it stays clear of the axis, s

  // correct.cc
  void correct(); ///< adds what the correction makes of the weak viscous forces
  void pack_correction();
  void reflect_correction(bool is_velocity);
  void share_heat(); ///< of the energy forms of the Shepard correction

  // support.cc
  void choose_support();
  void set_kappa(); ///< of wide correction records, from `reach`

  // surface.cc
  void find_surface();
  void list_contact_points();

  // motion.cc
  void       kick(const TimeStep &);
  double     landing(const Body &, std::size_t i, std::size_t w, const TimeStep &) const;
  void       share_friction(const TimeStep &);
  void       land_on_walls(const Body &, std::size_t i, const TimeStep &);
  void       stay_on_side(std::size_t i, const TimeStep &);
  void       book_planes(double kick);
  StepStatus drift(double dt);
  void       mark_boundaries(const std::vector<BodyParticles<dim>> &);

  // state.cc
  void follow(bool lists);
  void keep();
  void go_back();
  void write(ArchiveWriter &, const std::string &prefix);
  void read(const ArchiveReader &, const std::string &prefix);
  std::vector<std::size_t> read_ranges(const ArchiveReader &, const std::string &prefix);
  void place_territory(const ArchiveReader &, const std::string &prefix, bool as_written, std::size_t total);
  void read_works(const ArchiveReader &, const std::string &prefix);

  Culprit culprit(std::size_t i, const char *why) const;
  /// F of the reference configuration.
  Matrix deformation(std::size_t i) const
  {
    return Eigen::Map<const Matrix>(&reference.deformation[i * dim * dim]);
  }
  /// Moment matrix -sum V_j gradW (x) x_ij of the last gradient sweep.
  Matrix moment(std::size_t i) const
  {
    const double *sums = &gradient_sums[i * L::gradient_stride + L::m_sum];
    Matrix        m;
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        m(a, b) = sums[L::sym(a, b)];
    return m;
  }
  /// Mass per volume of the space of the sweeps: kg/m^dim.
  double plane_density(std::size_t i) const { return ring(i) * store.swept_density[i]; }
  double shared(std::size_t i) const
  {
    const auto id = static_cast<std::size_t>(store.id[i]);
    return id < energy_share.size() ? energy_share[id] : 1.;
  }
  /// Of the pair forces on it, weighed for the step bound, 1/s times the mass.
  double damping(std::size_t i) const
  {
    const double *forces = &force_sums[i * L::forces_stride];
    if (joint)
      return forces[L::damping];
    const double *viscous = &viscous_sums[i * V::sums_stride];
    return shares.viscosity * viscous[V::direct_rate] + shares.weak * viscous[V::weak_rate] +
           shares.hourglass * forces[L::hourglass_rate];
  }
  double weight(std::size_t i) const { return standard ? store.mass[i] : store.mass[i] / plane_density(i); }
};
} // namespace ogive::sph
