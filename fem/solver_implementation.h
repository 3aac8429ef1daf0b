// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/absorbing.h"
#include "fem/boundary.h"
#include "fem/constraints.h"
#include "fem/critical_step.h"
#include "fem/element_group.h"
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
  std::uint64_t                                   updates = 0;
  CriticalStep<dim>                               critical;
  /// Critical step over the elements' bound when last looked at, and the steps
  /// since then.
  AlignedVector<double>                           sharpening{1., 0.};
  std::vector<AlignedVector<double>>              mark;        ///< the snapshot
  Substeps<dim>                                   parts_of_step;
  LocalSteps<dim>                                 local;
  std::map<std::uint32_t, double>                 mass_factor;      ///< over their own, of nodes that carry others
  double                                          least_factor = 1; ///< of these, or 1

  /// An element among its group.
  struct Place
  {
    std::size_t group, element;
  };
  Place      find(std::uint32_t element) const;
  void       build(std::vector<BodyMesh<dim>>);
  std::vector<std::uint32_t> wall_nodes(const std::vector<BodyMesh<dim>> &) const;
  void       review_erosion();
  /// After state was taken back or read.
  void state_was_changed()
  {
    if (local.on)
      list_local_nodes();
    if (!erosion.any())
      return;
    for (auto &group : groups)
      group->rebury();
    review_erosion();
  }
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
