// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "sph/viscosity/pair.h"

#include <algorithm>
#include <cmath>

/// Switches: factors 0 to 1 on the viscosity of a particle; a pair has the mean
/// of its ends. Any viscosity may wear them.
namespace ogive::sph
{
/// Size of the antisymmetric part of a gradient as a rotation, |curl v|, 1/s.
template <int dim>
double curl(const Eigen::Matrix<double, dim, dim> &gradient)
{
  return std::sqrt(.5) * (gradient - gradient.transpose()).norm();
}

/// Balsara, J. Comput. Phys. 121 (1995) 357: |div v|/(|div v| + |curl v| + 1e-4 c/h).
template <int dim>
double balsara(const ViscousPoint<dim> &p)
{
  const double d = std::abs(p.divergence());
  return d / (d + curl<dim>(p.gradient) + 1e-4 * p.sound / p.h);
}

/// Share of the compression that changes over h: near 1 in a front, h k for a
/// smooth wave of wave number k. In the spirit of Owen's limiter by the
/// gradient of div v; the form is ours.
template <int dim>
double divergence_gradient(const ViscousPoint<dim> &p)
{
  const double change = p.h * p.divergence_gradient.norm();
  return change / (change + std::abs(p.divergence()) + 1e-6 * p.sound / p.h);
}

/// Cullen and Dehnen, MNRAS 408 (2010) 669, doi:10.1111/j.1365-2966.2010.17158.x,
/// without their neighbour-summed shock indicator: a factor that jumps to
/// h^2 A/(h^2 A + c^2), A = xi max(0, -d(div v)/dt), where that is more and
/// decays over h/(2 l c), l = .05, where it is less. xi = (div v)^2/((div v)^2 +
/// |curl v|^2) keeps shear out.
template <int dim>
double cullen_dehnen(const ViscousPoint<dim> &p, double factor, double divergence_before, double dt)
{
  constexpr double memory = .05;
  const double     d = p.divergence(), w = curl<dim>(p.gradient);
  const double     xi   = d * d > 0 ? d * d / (d * d + w * w) : 0;
  const double     a    = d < 0 ? p.h * p.h * xi * std::max(0., (divergence_before - d) / dt) : 0;
  const double     here = a / (a + p.sound * p.sound);
  return here >= factor ? here : here + (factor - here) * std::exp(-2 * memory * p.sound * dt / p.h);
}
} // namespace ogive::sph
