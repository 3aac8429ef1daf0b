// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/viscosity/pair.h"

#include <Eigen/Dense>

namespace ogive::sph
{
/// Owen's tensor viscosity, J. Comput. Phys. 201 (2004) 601, as restated in the
/// source paper. With n = x_ij/r, the gradient that end i sees is
/// S_ij = S_i (I - n n^T) + u n^T; M = h S_ij and
/// Q_i/rho_i^2 = (-alpha c_i M^T + beta M M)/rho_i; the pair has the mean of its
/// two ends, where it approaches. S_i, the background, keeps the compressive
/// eigenvalues of the symmetric velocity gradient. The restatement adds the spin
/// W_i to S_i and takes u = r v_ij/(r^2 + .01 h^2); then S_ij of a rigid rotation
/// is W_i, and M^T and M M press on bodies that only turn (a block gained 30
/// times its kinetic energy). Here W_i is taken from both: u = r (v_ij - W_i
/// x_ij)/(r^2 + .01 h^2), S_i without spin; n.u is the same. In one dimension it
/// is Monaghan's form. Forces are not along the line: torque is not zero, and
/// dissipation is not promised pair by pair.
template <int dim>
struct Owen
{
  static constexpr const char *name       = "owen";
  static constexpr bool        dissipates = false;
  static constexpr bool        central    = false;
  static constexpr int         n_terms    = dim;
  static constexpr int         n_fields   = dim * dim; ///< S symmetric, W antisymmetric: their sum holds both

  double alpha = 1, beta = 2, h = 0;

  void prepare(const ViscousPoint<dim> &p, double *fields) const
  {
    using Matrix = typename ViscousPoint<dim>::Matrix;
    const Matrix                          rate = .5 * (p.gradient + p.gradient.transpose());
    Eigen::SelfAdjointEigenSolver<Matrix> solver;
    solver.computeDirect(rate);
    const Matrix background = solver.eigenvectors() * solver.eigenvalues().cwiseMin(0.).asDiagonal() *
                                solver.eigenvectors().transpose() +
                              .5 * (p.gradient - p.gradient.transpose());
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        fields[a * dim + b] = background(a, b);
  }

  ViscousTerms<dim> operator()(const ViscousPair<dim> &p, const double *own, const VDouble *other) const
  {
    const VDouble inverse = 1. / (p.r2 + .01 * h * h);
    const VDouble r = p.r2 * p.inv_r, near = r * r * inverse;
    VDouble       n[dim], u[dim], along = 0.;
    for (int a = 0; a < dim; ++a)
    {
      n[a] = p.dx[a] * p.inv_r;
      u[a] = p.dv[a] * (r * inverse);
      along += n[a] * u[a];
    }
    const VDouble     close = stdx::min(p.vx, VDouble(0.)) * inverse; // n.u where it approaches
    VDouble           qi[dim], qj[dim];
    end(n, u, along, near, own, p.c_i, p.rho_i, qi);
    end(n, u, along, near, other, p.c_j, p.rho_j, qj);
    // -m_i m_j (Q_i + Q_j)/2 . gradW, gradW = g x_ij = g r n.
    const VDouble     half_r = .5 * r, share = p.jump_share();
    ViscousTerms<dim> terms;
    for (int a = 0; a < dim; ++a)
    {
      terms.raw[a]  = select(p.vx < 0., VDouble((qi[a] + qj[a]) * half_r), VDouble(0.));
      terms.weak[a] = terms.raw[a] * share;
    }
    terms.rate = viscous_rate(alpha, beta, h, -h * close, p.r2, p.c2, p.rho2);
    return terms;
  }

private:
  /// Q n/rho^2 of one end: M^T n = h [(S n) across n + n (n.u)] and
  /// M M n = h^2 [S (u across n) + u (n.u)].
  template <class Field>
  void end(const VDouble *n, const VDouble *whole, const VDouble &along, const VDouble &near, const Field *field,
           const VDouble &c, const VDouble &rho, VDouble *q) const
  {
    VDouble back[dim], u[dim], back_along = 0.;
    for (int a = 0; a < dim; ++a)
    {
      back[a]      = 0.;
      VDouble spin = 0.;
      for (int b = 0; b < dim; ++b)
      {
        const auto ab = field[a * dim + b], ba = field[b * dim + a];
        back[a] += .5 * (ab + ba) * n[b];
        spin += .5 * (ab - ba) * n[b];
      }
      back_along += back[a] * n[a];
      u[a] = whole[a] - near * spin;
    }
    const VDouble linear = -alpha * h * c / rho, quadratic = beta * h * h / rho;
    for (int a = 0; a < dim; ++a)
    {
      VDouble sheared = 0.;
      for (int b = 0; b < dim; ++b)
        sheared += .5 * (field[a * dim + b] + field[b * dim + a]) * (u[b] - along * n[b]);
      q[a] = linear * (back[a] - back_along * n[a] + along * n[a]) + quadratic * (sheared + along * u[a]);
    }
  }
};
} // namespace ogive::sph
