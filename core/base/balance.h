// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/tensor.h"

namespace ogive
{
/// What a solver owns at the end of a step, for the ledger. SI units; with
/// symmetry planes the amounts of the modelled part, in plane strain per metre
/// of thickness, in one dimension per square metre, in axial symmetry of the
/// whole ring (2 pi r). Nodes and particles that another solver carries (tied
/// slaves) count there and not here.
///
/// Energies in J that add up: kinetic + elastic + plastic_work +
/// viscosity_heat + bulk_viscosity_heat + hourglass. `elastic` is the rest of
/// the internal energy: what stress did reversibly.
struct Balance
{
  double mass                = 0;
  Vec3   momentum            = Vec3::Zero();
  Vec3   angular_momentum    = Vec3::Zero(); ///< about the origin
  /// given by rigid walls, prescribed motion, pressure and symmetry planes, N s
  Vec3   external_impulse    = Vec3::Zero();
  double kinetic             = 0;
  double elastic             = 0;
  double plastic_work        = 0;
  double viscosity_heat      = 0; ///< SPH artificial viscosity
  double bulk_viscosity_heat = 0; ///< elements
  double hourglass_fem       = 0;
  double hourglass_sph       = 0;
  double external_work       = 0; ///< work done on the bodies by prescribed motion and pressure
  double wall_loss           = 0; ///< kinetic energy lost as nodes land on rigid walls
  double friction_heat       = 0; ///< slip on rigid walls
  double absorbed            = 0; ///< left through absorbing boundaries
  double thermal             = 0; ///< memo: share of plastic_work that became heat (Taylor-Quinney)
  /// Left with dead elements: kg, N s, N m s; energies in J, kinetic and internal.
  /// Not part of the amounts above.
  double eroded_mass             = 0;
  Vec3   eroded_momentum         = Vec3::Zero();
  Vec3   eroded_angular_momentum = Vec3::Zero();
  double eroded_energy           = 0;
  double eroded_elements         = 0; ///< memo: how many
  double gradient_fallbacks  = 0; ///< memo: particles whose gradient was not corrected in the last step

  double internal() const
  {
    return elastic + plastic_work + viscosity_heat + bulk_viscosity_heat + hourglass_fem +
           hourglass_sph;
  }

  Balance &operator+=(const Balance &b)
  {
    mass += b.mass;
    momentum += b.momentum;
    angular_momentum += b.angular_momentum;
    external_impulse += b.external_impulse;
    kinetic += b.kinetic;
    elastic += b.elastic;
    plastic_work += b.plastic_work;
    viscosity_heat += b.viscosity_heat;
    bulk_viscosity_heat += b.bulk_viscosity_heat;
    hourglass_fem += b.hourglass_fem;
    hourglass_sph += b.hourglass_sph;
    external_work += b.external_work;
    wall_loss += b.wall_loss;
    friction_heat += b.friction_heat;
    absorbed += b.absorbed;
    thermal += b.thermal;
    eroded_mass += b.eroded_mass;
    eroded_momentum += b.eroded_momentum;
    eroded_angular_momentum += b.eroded_angular_momentum;
    eroded_energy += b.eroded_energy;
    eroded_elements += b.eroded_elements;
    gradient_fallbacks += b.gradient_fallbacks;
    return *this;
  }
};
} // namespace ogive
