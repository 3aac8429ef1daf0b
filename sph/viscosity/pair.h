// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/lanes.h"

#include <Eigen/Core>

#include <string>

namespace ogive::sph
{
/// What a viscosity sees of its pairs, one a lane.
template <int dim>
struct ViscousPair
{
  VDouble dx[dim], dv[dim]; ///< x_i - x_j, v_i - v_j
  VDouble vx;               ///< v_ij.x_ij
  VDouble limited;          ///< the part of vx that is a jump, within [min(vx, 0), 0]
  VDouble r2, inv_r;
  VDouble c2, rho2; ///< twice the means of sound speed and density
  VDouble rho_i, rho_j, c_i, c_j;

  /// limited over vx where the pair approaches, 0 where it does not.
  VDouble jump_share() const
  {
    return select(vx < 0., VDouble(limited / select(vx < 0., vx, VDouble(-1.))), VDouble(0.));
  }
};

/// What a viscosity gives for a pair: the force on i is -m_i m_j g Pi with
/// gradW = x_ij g; Pi holds one number for central forces (times x_ij), dim for
/// others.
template <int n>
struct ViscousTerms
{
  VDouble raw[n];  ///< of the velocities as they are
  VDouble weak[n]; ///< of the limited jump; the same without a limiter
  VDouble rate;    ///< bound of -dPi/d(v_ij.x_ij), for the step bound
};

/// What a viscosity may ask of one particle before the pairs are visited.
template <int dim>
struct ViscousPoint
{
  using Vector = Eigen::Matrix<double, dim, 1>;
  using Matrix = Eigen::Matrix<double, dim, dim>;

  Matrix gradient = Matrix::Zero();            ///< of the velocity, corrected where the form is, 1/s
  Vector divergence_gradient = Vector::Zero(); ///< of its trace, 1/(m s)
  double hoop = 0; ///< v_r/r where the body turns about an axis, 1/s
  double density = 0, sound = 0, h = 0;

  double divergence() const { return gradient.trace() + hoop; }
};

/// Bound of -dPi/d(v_ij.x_ij) of the linear and quadratic pair viscosities,
/// where |mu| (m/s) is the greatest jump that they see. The linear part may act
/// on any pair in the next step, so it counts always.
inline VDouble viscous_rate(double alpha, double beta, double h, const VDouble &mu, const VDouble &r2,
                            const VDouble &c2, const VDouble &rho2)
{
  return (.5 * alpha * c2 + 2. * beta * mu) * (2. * h) / ((r2 + .01 * h * h) * rho2);
}
} // namespace ogive::sph
