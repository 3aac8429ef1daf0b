// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/surfaces.h"

#include <algorithm>
#include <cmath>

namespace ogive::coupling
{
/// The surface that the particles of a body show to a point of another body, as
/// a level of psi(x) = sum_j w(|x - x_j|/h), w of Wendland C2. The depth
///   d = (psi - psi_0)/slope_0
/// is zero where the point touches a lattice of the body's spacing from above,
/// r_point + r_body over the centres of the outermost layer, and grows by 1 m
/// per m there. It depends on distances alone, so the potential 1/2 k d^2
/// conserves energy, momentum and angular momentum whatever the surface does;
/// with h = 1.5 of that distance its level over a flat lattice is even to 3e-4
/// of the spacing. Edges are rounded inwards by about h/2, and a lone particle
/// shows next to nothing: it feels others by their field, at the contact of its
/// own point.
template <int dim>
class ParticleField
{
public:
  ParticleField() = default;
  /// `touch`: r_point + r_body; `spacing`: of the body. m
  ParticleField(double touch, double spacing) : h_(1.5 * std::max(touch, spacing))
  {
    // Mean over the places above a cell, and its derivative by difference.
    const double step = 1e-4 * touch;
    level_ = lattice_level(touch, spacing);
    slope_ = (lattice_level(touch - step, spacing) - lattice_level(touch + step, spacing)) / (2 * step);
    over_lattice(touch, spacing, Point<dim>::Zero(), [&](double r) {
      squares_ += slope(r) * slope(r);
      slopes_ += slope(r);
    });
  }

  double reach() const { return 2 * h_; }
  double depth(double psi) const { return (psi - level_) / slope_; }
  /// Sum over the carriers of their squared share of d, at touch.
  double sum_of_squares() const { return squares_; }
  /// Sum of their shares in magnitude, at touch.
  double sum_of_slopes() const { return slopes_; }

  static double value(double q)
  {
    const double a = std::max(0., 1 - .5 * q);
    return a * a * a * a * (1 + 2 * q);
  }
  /// Of d, away from particle j: -d'(r) (x - x_j)/r at r = |x - x_j|.
  double slope(double r) const
  {
    const double q = r / h_, a = std::max(0., 1 - .5 * q);
    return 5 * q * a * a * a / (h_ * slope_);
  }
  double weight(double r) const { return value(r / h_); }

private:
  template <class F>
  void over_lattice(double height, double spacing, const Point<dim> &shift, F &&f) const
  {
    const int n = static_cast<int>(std::ceil(2 * h_ / spacing)) + 1;
    int       across = 1;
    for (int a = 1; a < dim; ++a)
      across *= 2 * n + 1;
    for (int layer = 0; layer <= n; ++layer)
      for (int k = 0; k < across; ++k)
      {
        double square = (height + layer * spacing) * (height + layer * spacing);
        for (int a = 1, rest = k; a < dim; ++a, rest /= 2 * n + 1)
        {
          const double x = (rest % (2 * n + 1) - n + shift[a]) * spacing;
          square += x * x;
        }
        f(std::sqrt(square));
      }
  }

  double lattice_level(double height, double spacing) const
  {
    constexpr int samples = 4;
    double        sum     = 0;
    int           count   = 0;
    for (int k = 0; k < samples; ++k)
      for (int l = 0; l < (dim == 3 ? samples : 1); ++l, ++count)
      {
        Point<dim> shift = Point<dim>::Zero();
        if constexpr (dim > 1)
          shift[1] = (k + .5) / samples;
        if constexpr (dim > 2)
          shift[2] = (l + .5) / samples;
        over_lattice(height, spacing, shift, [&](double r) { sum += value(r / h_); });
      }
    return sum / count;
  }

  double h_ = 0, level_ = 0, slope_ = 0, squares_ = 0, slopes_ = 0;
};
} // namespace ogive::coupling
