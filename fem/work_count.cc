// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem/work_count.h"

#include "core/materials/laws.h"
#include "core/materials/rotation.h"
#include "fem/elements/hex8_modes.h"

namespace ogive::fem
{
namespace
{
/// A double that counts what is done to it.
struct Counted
{
  static inline std::size_t operations = 0;

  double value = 0;

  Counted() = default;
  Counted(double v)
    : value(v)
  {}
  Counted &operator+=(const Counted &o) { return *this = *this + o; }
  Counted &operator-=(const Counted &o) { return *this = *this - o; }
  Counted &operator*=(const Counted &o) { return *this = *this * o; }

  friend Counted operator+(const Counted &a, const Counted &b) { return done(a.value + b.value); }
  friend Counted operator-(const Counted &a, const Counted &b) { return done(a.value - b.value); }
  friend Counted operator*(const Counted &a, const Counted &b) { return done(a.value * b.value); }
  friend Counted operator/(const Counted &a, const Counted &b) { return done(a.value / b.value); }
  friend Counted operator-(const Counted &a) { return a.value * -1; }
  friend bool    operator<(const Counted &a, const Counted &b) { return a.value < b.value; }
  friend bool    operator>(const Counted &a, const Counted &b) { return a.value > b.value; }
  friend bool    operator<=(const Counted &a, const Counted &b) { return a.value <= b.value; }
  friend bool    operator>=(const Counted &a, const Counted &b) { return a.value >= b.value; }
  friend Counted abs(const Counted &a) { return std::abs(a.value); }
  friend Counted sqrt(const Counted &a) { return done(std::sqrt(a.value)); }
  friend Counted select(bool condition, const Counted &yes, const Counted &no) { return condition ? yes : no; }

  /// As many operations as the series for registers take (core/materials/lane_math.h).
  friend Counted lane_log(const Counted &a)
  {
    operations += 31;
    return std::log(a.value);
  }
  friend Counted lane_power(const Counted &a, double n)
  {
    operations += 31 + 1 + 34;
    return std::pow(a.value, n);
  }

private:
  static Counted done(double v)
  {
    ++operations;
    return v;
  }
};

void element_kernel()
{
  constexpr double corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                   {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  Counted          x[8][3], v[8][3], sigma[6], Q[4][3], force[8][3], ones[8];
  for (int a = 0; a < 8; ++a)
  {
    ones[a] = 1;
    for (int i = 0; i < 3; ++i)
      x[a][i] = corner[a][i], v[a][i] = .1 * corner[a][(i + 1) % 3];
  }
  ModalShape<Counted>        shape;
  Deformation<Hex8, Counted> motion;
  Counted                    X[7][3], V[7][3];
  modes_of(x, X);
  modes_of(v, V);
  power_taken(X, V, sigma, Q);
  deform_modes(X, V, Counted(1e-3), shape, motion);
  gram<Hex8, Counted>(shape, ones);
  turn<Hex8, Counted>(motion.spin, Q);
  corner_forces<Hex8, Counted>(shape, sigma, Q, force);
}

void material(const materials::Parameters &p)
{
  std::array<Counted, 6> s{};
  materials::rotate_hughes_winget(s, Counted(.1), Counted(.1), Counted(.1));
  if (p.eos.law == materials::MieGrueneisen::name)
    materials::MieGrueneisen::from(p).at(Counted(p.density * 1.01), Counted(100.));
  if (p.strength.law == materials::JohnsonCook::name)
  {
    // A strain of .05 that grows by .001 within .1 us, warm by 10 K.
    const auto   law = materials::JohnsonCook::from(p);
    const double strain = .05, grown = .001, dt = 1e-7, three_g = 3 * p.young_modulus / (2 + 2 * p.poisson_ratio);
    const double now = law.stress(strain, grown / dt, p.thermal.reference_temperature + 10);
    law.flow(materials::Trial<Counted>{now * 1.01 + three_g * grown, now, three_g, strain,
                                       p.thermal.reference_temperature + 10, dt, 2e-7});
  }
}
} // namespace

ElementWork count_work(std::size_t n, const materials::Parameters &p)
{
  Counted::operations = 0;
  element_kernel();
  material(p);
  // Between the templates. Strain half: rates times dt 12, work 3 x 24, books 33.
  // Material: deviators and three products 90, pressure 12, return 20, finish 24.
  // Stress half: viscosity 16, bound 24, hourglass 70, stress and power 21, sums 24.
  // Nodes: kick 5 and drift 4 a component.
  const double nodes = double(n + 1) * double(n + 1) * double(n + 1) / double(n * n * n);
  const double by_hand = 12 + 72 + 33 + 90 + 12 + 20 + 24 + 16 + 24 + 70 + 21 + 24 + nodes * 3 * 9;
  // Points 14, hourglass forces 12, books 6; mass and rows once.
  const double state = 2 * (14 + 12 + 6) + 1 + 4;
  // A node: x, v, forces of both kinds, mean and old velocity, both ways; loads and mass once.
  const double node  = 2 * 6 * 3 + 3 + 1;
  return {double(Counted::operations) + by_hand, 8 * (state + nodes * node)};
}
} // namespace ogive::fem
