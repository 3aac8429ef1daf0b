// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/absorbing.h"
#include "fem/all_elements.h"
#include "fem/boundary.h"
#include "fem/constraints.h"
#include "fem/critical_step.h"
#include "fem/distribution.h"
#include "fem/element_group.h"
#include "fem/element_store.h"
#include "fem/erosion.h"
#include "fem/loads.h"
#include "fem/local_steps.h"
#include "fem/nodes.h"
#include "fem/solver.h"
#include "fem/substeps.h"

#include <map>
#include <string>
#include <vector>

namespace ogive::fem
{
template <int dim>
struct Solver<dim>::Implementation
{
  /// A body: its nodes [first_node, last_node) and its elements.
  struct Part
  {
    std::size_t first_node, last_node, first_element;
  };

  Parameters                                      parameters;
  Nodes<dim>                                      nodes;
  std::vector<std::unique_ptr<ElementGroup<dim>>> groups; ///< one a body
  std::vector<Part>                               parts;  ///< beside groups
  PrescribedMotion<dim>                           prescribed;
  Constraints<dim>                                constraints;
  Loads<dim>                                      loads;
  AbsorbingFaces<dim>                             absorbing;
  RigidWalls<dim>                                 walls;
  Erosion<dim>                                    erosion;
  BoundaryWork                                    work;
  std::array<AlignedVector<double>, dim>          v_old, load; ///< m/s; N, pressures and body forces at t_n
  Surface<dim>                                    face;        ///< lists only; spans are set on demand
  std::vector<AddedMass>                          added_masses; ///< in the order of groups
  std::uint64_t                                   updates = 0, skipped = 0;
  CriticalStep<dim>                               critical;
  /// Critical step over the elements' bound when last looked at, and the steps
  /// since then.
  AlignedVector<double>                           sharpening{1., 0.};
  std::vector<AlignedVector<double>>              mark;        ///< the snapshot
  Substeps<dim>                                   parts_of_step;
  LocalSteps<dim>                                 local;
  std::map<std::uint32_t, double>                 mass_factor;      ///< over their own, of nodes that carry others
  double                                          least_factor = 1; ///< of these, or 1

  // On ranks (solver_ranks.cc)
  /// What the coupling layer asked of a body's elements: again due where groups are built anew.
  struct Order
  {
    int                        body = -1;
    std::vector<std::uint32_t> elements;
    std::vector<double>        shares;
  };
  Distribution<dim>                      distribution;
  std::vector<GroupPlace>                places; ///< beside groups
  typename Distribution<dim>::NodeList   shown;  ///< nodes that all ranks know of
  std::map<std::string, std::vector<std::uint32_t>> followed; ///< some of them, by who asks
  std::array<AlignedVector<double>, dim> total;  ///< N: of the elements of all ranks at t_n, slaves' with their masters
  std::vector<Order>                     weighed, damped;
  std::vector<int>                       mark_owners; ///< ranks of elements at the snapshot
  AlignedVector<double>                  age{0.};     ///< steps since the shares were looked at
  std::size_t                            moves = 0;

  AllElements<dim> all() const { return {groups, distribution}; }
  /// Component i of the forces of the elements at the nodes of body g, N.
  const double *element_forces(std::size_t g, int i) const
  {
    return distribution.alone() ? groups[g]->nodal_forces(i).data() : total[i].data() + parts[g].first_node;
  }
  /// Calls f(first, last) for runs of nodes that this rank keeps up.
  template <class F>
  void for_each_run(F &&f) const
  {
    if (distribution.alone())
      return f(std::size_t(0), nodes.size());
    for (std::size_t g = 0; g < parts.size(); ++g)
      for (const Run &run : distribution.runs(g))
        f(run.first, run.last);
  }
  template <class F>
  void for_each_run(std::size_t g, F &&f) const
  {
    if (distribution.alone())
      return f(parts[g].first_node, parts[g].last_node);
    for (const Run &run : distribution.runs(g))
      f(run.first, run.last);
  }

  // solver_ranks.cc: nothing where this process is alone
  std::vector<std::size_t> own_of(std::size_t g, std::span<const std::uint32_t> elements) const;
  void              weigh_own(std::size_t g, std::span<const std::uint32_t> elements, std::span<const double> shares);
  template <class F>
  std::vector<Departure<dim>> departures(std::span<const std::uint32_t> elements, F &&remains_of) const;
  using Corner = std::array<std::array<double, dim>, ElementGroup<dim>::corners>;
  /// Notes motion that the owner of an element told.
  void know(const std::array<std::uint32_t, ElementGroup<dim>::corners> &node, const Corner &x, const Corner &v)
  {
    for (std::size_t a = 0; a < node.size(); ++a)
      for (int i = 0; i < dim; ++i)
      {
        nodes.x[i][node[a]] = x[a][i];
        nodes.v[i][node[a]] = v[a][i];
      }
  }
  void              share_out();
  std::vector<int>  partition() const;
  double            own_work() const;
  std::vector<double> work_of_elements() const; ///< of all ranks
  void              add_up(std::size_t first, std::size_t last);
  void              rebuild_groups(std::span<const int> owners);
  void              complete_forces();
  void              complete_motion(); ///< x and v of all nodes on all ranks
  void              fold_total();
  void              find_shown();
  void              show();
  StepStatus        agree(const StepStatus &) const;
  Culprit           numbered(Culprit) const;
  StepLimit         agree(const StepLimit &) const;
  StepStatus        conclude(const StepStatus &);
  void              bury(const std::vector<std::vector<std::size_t>> &failed);
  void              look_at_shares();
  Balance           sum(const Balance &) const;
  double            sum(double x) const { return distribution.ranks().sum(x); }

  // shared_state.cc
  std::vector<std::uint32_t> own_elements(std::size_t g) const;
  std::vector<ElementStore>  layout();
  std::vector<ElementStore>  take_state();
  void                       give_state(const std::vector<ElementStore> &);
  std::vector<ElementStore>  move_state(const std::vector<ElementStore> &, const std::vector<int> &from) const;
  void                       complete_nodes();
  void                       complete_nodes_of(std::size_t g, ElementStore &) const;
  void                       move_elements(const std::vector<int> &owners);

  // shared_checkpoint.cc
  void                      save_shared(ArchiveWriter &, const std::string &prefix);
  void                      load_shared(const ArchiveReader &, const std::string &prefix);
  std::vector<ElementStore> read_stores(const ArchiveReader &, const std::string &prefix);

  /// An element among its group.
  struct Place
  {
    std::size_t group, element;
  };
  Place      find(std::uint32_t element) const;
  void       place_bodies(std::vector<BodyMesh<dim>> &);
  void       start_body(const BodyMesh<dim> &, std::size_t b);
  void       build(std::vector<BodyMesh<dim>>);
  std::vector<std::uint32_t> wall_nodes(const std::vector<BodyMesh<dim>> &) const;
  void       review_erosion();
  /// After state was taken back or read.
  void state_was_changed()
  {
    if (local.on)
      list_local_nodes();
    for (auto &group : groups)
      group->wake();
    if (!erosion.any())
      return;
    for (auto &group : groups)
      group->rebury();
    count_the_living();
    review_erosion();
  }
  void       count_the_living(); ///< of all ranks
  void       spread(typename Substeps<dim>::Pushed &, const TimeStep &whole, const TimeStep &part);
  void       place(const TimeStep &whole, const TimeStep &part);
  void       add_owed(Balance &) const;
  // local_classes.cc: who is of which class
  bool               may_step_locally(const std::vector<BodyMesh<dim>> &) const;
  void               begin_local_steps();
  ClassedGroup<dim> *classed(std::size_t g) const;
  std::vector<const ClassedGroup<dim> *>  all_classed() const;
  std::vector<std::vector<unsigned char>> choose_classes(double longest) const;
  void               spread_classes(std::vector<std::vector<unsigned char>> &, int most) const;
  void               arrange(const std::vector<std::vector<unsigned char>> &);
  void               settle_moved(const std::array<AlignedVector<double>, dim> &impulse);
  void               sum_half_kicks(std::array<AlignedVector<double>, dim> &, double sign) const;
  void               list_local_nodes();
  void               review_classes(double whole);
  StepLimit          local_limit() const;
  // local_steps.cc: their steps
  StepStatus step_locally(const TimeStep &);
  void       kick_locally(double h, int upto);
  void       constrain_locally(const TimeStep &whole, double time, double h, int upto);
  void       begin_units(double time, int upto);
  void       drift_locally(double h, int upto);
  bool       books_exactly(const typename LocalSteps<dim>::Unit &) const;
  StepStatus finish_units(std::size_t next, double h);
  void       note_pushes(double kick);
  void       finish_whole(const TimeStep &);
  StepStatus advance_elements(const TimeStep &);
  StepStatus review();
  void       kick(const TimeStep &);
  void       fold_forces();
  void       book_loads(double kick);
  void       drift(double dt);
  StepStatus check_nodes() const;
  StepLimit  element_limit() const;
  void       sharpen();
  typename CriticalStep<dim>::Answer find_critical(double tolerance, int most);

  template <class F>
  void for_each_state(F &&f)
  {
    static const char *axis[3] = {"x", "y", "z"};
    for (int i = 0; i < dim; ++i)
    {
      f(std::string("position_") + axis[i], nodes.x[i]);
      f(std::string("velocity_") + axis[i], nodes.v[i]);
      f(std::string("force_") + axis[i], nodes.force[i]);
    }
    for (int i = 0; i < dim && !distribution.alone(); ++i)
      f(std::string("element_force_") + axis[i], total[i]);
    if (!distribution.alone())
      f("age", age);
    f("mass", nodes.mass);
    if (parts_of_step.on())
    {
      for (int i = 0; i < dim; ++i)
      {
        f(std::string("shift_") + axis[i], parts_of_step.shift[i]);
        f(std::string("owed_") + axis[i], parts_of_step.owed[i]);
      }
      f("parts_error", parts_of_step.error);
    }
    if (local.on)
    {
      for (int i = 0; i < dim; ++i)
        f(std::string("seen_") + axis[i], local.seen[i]);
      auto                 &s = local.state;
      AlignedVector<double> kept{s.last, s.error, s.ended, s.count, s.moved, s.limit};
      f("local_steps", kept);
      s = {kept.at(0), kept.at(1), kept.at(2), kept.at(3), kept.at(4), kept.at(5)};
    }
    f("wall_force", walls.forces());
    if (parameters.options.step_bound == "power-iteration")
    {
      f("sharpening", sharpening);
      critical.for_each_state(
        [&](int i, AlignedVector<double> &u) { f(std::string("critical_motion_") + axis[i], u); });
    }
    AlignedVector<double> booked{work.external,   work.wall_loss,  work.friction,  work.absorbed,
                                 work.impulse[0], work.impulse[1], work.impulse[2]};
    f("work", booked);
    work = {booked.at(0), booked.at(1), booked.at(2), booked.at(3), {booked.at(4), booked.at(5), booked.at(6)}};
    f("eroded", erosion.state());
    for (std::size_t g = 0; g < groups.size(); ++g)
      groups[g]->for_each_state([&](const std::string &name, AlignedVector<double> &a) {
        f("group" + std::to_string(g) + "/" + name, a);
      });
  }
};
} // namespace ogive::fem
