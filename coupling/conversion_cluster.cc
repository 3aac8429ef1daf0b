// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/conversion_cluster.h"

#include "fem/embedding.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ogive::coupling
{
namespace
{
using Matrix3 = Eigen::Matrix3d;

/// Every column once, of `Event` or const Event.
template <class Event, class F>
void for_each_column(Event &e, F &&f)
{
  f("step [-]", e.step);
  f("time [s]", e.time);
  f("body [-]", e.body);
  f("elements [-]", e.elements);
  f("particles [-]", e.particles);
  for (const auto &[when, s] : {std::pair{"_before", &e.before}, std::pair{"_after", &e.after}})
  {
    const std::string after(when);
    f("mass" + after + " [kg]", s->mass);
    for (int i = 0; i < 3; ++i)
      f(std::string("momentum_") + "xyz"[i] + after + " [N s]", s->momentum[i]);
    for (int i = 0; i < 3; ++i)
      f(std::string("angular_momentum_") + "xyz"[i] + after + " [N m s]", s->angular_momentum[i]);
    f("kinetic" + after + " [J]", s->kinetic);
    f("internal" + after + " [J]", s->internal);
    f("plastic_work" + after + " [J]", s->plastic_work);
    f("damage" + after + " [-]", s->damage);
    f("temperature" + after + " [K]", s->temperature);
  }
  f("hourglass_before [J]", e.hourglass);
  f("conversion_heat [J]", e.heat);
  f("turn [rad/s]", e.turn);
}

template <int dim>
Vec3 spatial(const std::array<double, dim> &x)
{
  Vec3 v = Vec3::Zero();
  for (int i = 0; i < dim; ++i)
    v[i] = x[i];
  return v;
}

template <int dim>
Vec3 spatial(const std::array<std::vector<double>, dim> &x, std::size_t k)
{
  Vec3 v = Vec3::Zero();
  for (int i = 0; i < dim; ++i)
    v[i] = x[i][k];
  return v;
}

void count(ConversionSums &s, double m, const Vec3 &x, const Vec3 &v, bool axisymmetric)
{
  s.mass += m;
  s.kinetic += .5 * m * v.squaredNorm();
  if (axisymmetric)
  {
    s.momentum[1] += m * v[1];
    return;
  }
  s.momentum += m * v;
  s.angular_momentum += m * x.cross(v);
}

/// Of mass m at an arm r.
Matrix3 inertia(double m, const Vec3 &r)
{
  return m * (r.squaredNorm() * Matrix3::Identity() - r * r.transpose());
}

/// Reference point of a lattice position: xi_k = (2k + 1)/n - 1, k from 0.
template <int dim>
Eigen::Matrix<double, dim, 1> lattice_point(const Lattice<dim> &n, int k)
{
  Eigen::Matrix<double, dim, 1> xi;
  for (int i = 0; i < dim; ++i, k /= n[i - 1])
    xi[i] = (2. * (k % n[i]) + 1) / n[i] - 1;
  return xi;
}

template <int dim>
int size_of(const Lattice<dim> &n)
{
  int size = 1;
  for (const int along : n)
    size *= along;
  return size;
}

/// Where a lattice position lies, and the volume that it stands for but for a
/// common factor.
template <int dim>
struct Spot
{
  std::array<double, 1 << dim>    weight{};
  Eigen::Matrix<double, dim, dim> J; ///< dx/dxi, m
  Vec3                            x = Vec3::Zero();
  double                          volume = 0;
};

template <int dim>
Spot<dim> spot_of(const fem::Departure<dim> &d, const Lattice<dim> &n, int k, bool axisymmetric)
{
  Spot<dim>                                              s;
  std::array<Eigen::Matrix<double, dim, 1>, 1 << dim> slope;
  fem::shape_functions<dim>(lattice_point<dim>(n, k), s.weight, slope);
  s.J.setZero();
  for (int a = 0; a < d.corners; ++a)
    for (int i = 0; i < dim; ++i)
    {
      s.J.row(i) += d.x[a][i] * slope[a].transpose();
      s.x[i] += s.weight[a] * d.x[a][i];
    }
  s.volume = s.J.determinant() * (axisymmetric ? s.x[0] : 1.);
  return s;
}

/// The spots of an element; masses that add up to what left the nodes. Where
/// the map is folded at one of them all get the same.
template <int dim>
std::pair<std::vector<Spot<dim>>, std::vector<double>> spread(const fem::Departure<dim> &d, const Lattice<dim> &n,
                                                              bool axisymmetric)
{
  std::vector<Spot<dim>> spots;
  double                 volume = 0, mass = 0, least = 1;
  for (int k = 0; k < size_of<dim>(n); ++k)
  {
    spots.push_back(spot_of<dim>(d, n, k, axisymmetric));
    volume += spots.back().volume;
    least = std::min(least, spots.back().volume);
  }
  for (const double m : d.mass)
    mass += m;
  std::vector<double> share;
  for (const auto &spot : spots)
    share.push_back(mass * (least > 0 ? spot.volume / volume : 1. / static_cast<double>(spots.size())));
  return {std::move(spots), std::move(share)};
}
} // namespace

std::vector<std::string> ConversionEvent::columns()
{
  std::vector<std::string> names;
  const ConversionEvent    event;
  for_each_column(event, [&](const std::string &name, double) { names.push_back(name); });
  return names;
}

std::vector<double> ConversionEvent::values() const
{
  std::vector<double> numbers;
  for_each_column(*this, [&](const std::string &, double value) { numbers.push_back(value); });
  return numbers;
}

template <int dim>
Lattice<dim> lattice_of(const fem::Departure<dim> &d, double spacing)
{
  Lattice<dim> n;
  for (int i = 0; i < dim; ++i)
  {
    // an edge joins two corners whose signs differ along one axis; the mean of all
    double length = 0;
    for (int a = 0; a < d.corners; ++a)
      for (int b = 0; b < a; ++b)
      {
        bool edge = true;
        for (int j = 0; j < dim; ++j)
          edge = edge && (fem::corner_sign[a][j] != fem::corner_sign[b][j]) == (j == i);
        if (edge)
          length += (spatial<dim>(d.x0[a]) - spatial<dim>(d.x0[b])).norm() / (d.corners / 2);
      }
    n[i] = std::max(1, static_cast<int>(std::lround(length / spacing)));
  }
  return n;
}

template <int dim>
void add_particles(const fem::Departure<dim> &d, const Lattice<dim> &n, materials::Points &from, std::size_t e,
                   bool axisymmetric, sph::Newcomers<dim> &to)
{
  const auto [spots, mass] = spread<dim>(d, n, axisymmetric);
  for (std::size_t k = 0; k < spots.size(); ++k)
  {
    const auto &spot = spots[k];
    for (int i = 0; i < dim; ++i)
    {
      double x0 = 0, v = 0;
      for (int a = 0; a < d.corners; ++a)
      {
        x0 += spot.weight[a] * d.x0[a][i];
        v += spot.weight[a] * d.v[a][i];
      }
      double square = 0; // of half the cell across axis i: exact for bricks along the axes, and blind to their turn
      for (int j = 0; j < dim; ++j)
        square += spot.J(i, j) * spot.J(i, j) / (n[j] * n[j]);
      to.x[i].push_back(spot.x[i]);
      to.x0[i].push_back(x0);
      to.v[i].push_back(v);
      to.half_cell[i].push_back(std::sqrt(square));
    }
    to.mass.push_back(mass[k]);
  }
  const std::size_t first = to.points.size();
  to.points.resize(first + spots.size());
  std::vector<double> state;
  from.for_each_array([&](const char *, AlignedVector<double> &a) { state.push_back(a[e]); });
  std::size_t next = 0;
  to.points.for_each_array([&](const char *, AlignedVector<double> &a) {
    std::fill(a.begin() + static_cast<std::ptrdiff_t>(first), a.end(), state[next++]);
  });
}

template <int dim>
double repair_momenta(const ConversionSums &nodes, bool axisymmetric, sph::Newcomers<dim> &to, std::size_t first)
{
  const auto move = [&](const Vec3 &change, const Vec3 &turn, const Vec3 &centre) {
    for (std::size_t k = first; k < to.mass.size(); ++k)
    {
      const Vec3 dv = change + turn.cross(spatial<dim>(to.x, k) - centre);
      for (int i = 0; i < dim; ++i)
        to.v[i][k] += dv[i];
    }
  };
  Vec3 centre = Vec3::Zero(), whole = Vec3::Zero();
  // Twice: the second pass takes what rounding left of the first.
  for (int pass = 0; pass < 2; ++pass)
  {
    ConversionSums now = sums_of(to, first, axisymmetric);
    move((nodes.momentum - now.momentum) / now.mass, Vec3::Zero(), centre);
    if (axisymmetric || dim == 1)
      continue;
    centre.setZero();
    for (std::size_t k = first; k < to.mass.size(); ++k)
      centre += to.mass[k] / now.mass * spatial<dim>(to.x, k);
    Matrix3 I = Matrix3::Zero();
    for (std::size_t k = first; k < to.mass.size(); ++k)
      I += inertia(to.mass[k], spatial<dim>(to.x, k) - centre);
    now = sums_of(to, first, axisymmetric);
    const Vec3 lost = nodes.angular_momentum - now.angular_momentum;
    Vec3       turn = Vec3::Zero();
    if constexpr (dim == 2)
      turn[2] = I(2, 2) > 0 ? lost[2] / I(2, 2) : 0.;
    else
    {
      const Eigen::SelfAdjointEigenSolver<Matrix3> axes(I);
      for (int i = 0; i < 3; ++i)
        if (axes.eigenvalues()[i] > 1e-9 * axes.eigenvalues()[2])
          turn += axes.eigenvectors().col(i).dot(lost) / axes.eigenvalues()[i] * axes.eigenvectors().col(i);
    }
    move(Vec3::Zero(), turn, centre);
    whole += turn;
  }
  return whole.norm();
}

template <int dim>
double inertia_ratio(std::span<const fem::Departure<dim>> elements, double spacing, bool axisymmetric)
{
  if (axisymmetric || dim == 1)
    return 1;
  struct Body
  {
    double               mass   = 0;
    Vec3                 centre = Vec3::Zero();
    std::vector<double>  masses;
    std::vector<Vec3>    places;
    void                 add(double m, const Vec3 &x)
    {
      mass += m;
      centre += m * x;
      masses.push_back(m);
      places.push_back(x);
    }
    Matrix3 turned() const
    {
      Matrix3 I = Matrix3::Zero();
      for (std::size_t k = 0; k < masses.size(); ++k)
        I += inertia(masses[k], places[k] - centre / mass);
      return I;
    }
  } corners, particles;
  for (const auto &d : elements)
  {
    for (int a = 0; a < d.corners; ++a)
      corners.add(d.mass[a], spatial<dim>(d.x[a]));
    const auto [spots, mass] = spread<dim>(d, lattice_of(d, spacing), axisymmetric);
    for (std::size_t k = 0; k < spots.size(); ++k)
      particles.add(mass[k], spots[k].x);
  }
  const Matrix3 now = particles.turned(), was = corners.turned();
  if constexpr (dim == 2)
    return now(2, 2) / was(2, 2);
  return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix3>(now, was, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

template <int dim>
ConversionSums sums_of(std::span<const fem::Departure<dim>> elements, const materials::Points &points,
                       bool axisymmetric)
{
  ConversionSums s;
  for (std::size_t e = 0; e < elements.size(); ++e)
  {
    const auto &d      = elements[e];
    const double before = s.mass;
    for (int a = 0; a < d.corners; ++a)
      count(s, d.mass[a], spatial<dim>(d.x[a]), spatial<dim>(d.v[a]), axisymmetric);
    s.internal += d.internal;
    s.plastic_work += d.plastic_work;
    s.damage += (s.mass - before) * points.damage[e];
    s.temperature += (s.mass - before) * points.temperature[e];
  }
  s.damage /= s.mass;
  s.temperature /= s.mass;
  return s;
}

template <int dim>
ConversionSums sums_of(const sph::Newcomers<dim> &particles, std::size_t first, bool axisymmetric)
{
  ConversionSums s;
  for (std::size_t k = first; k < particles.mass.size(); ++k)
  {
    const double m = particles.mass[k];
    count(s, m, spatial<dim>(particles.x, k), spatial<dim>(particles.v, k), axisymmetric);
    s.internal += m * particles.points.energy[k];
    s.plastic_work += m * particles.points.plastic_work[k];
    s.damage += m * particles.points.damage[k];
    s.temperature += m * particles.points.temperature[k];
  }
  s.damage /= s.mass;
  s.temperature /= s.mass;
  return s;
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template Lattice<d> lattice_of<d>(const fem::Departure<d> &, double);                                        \
  template void add_particles<d>(const fem::Departure<d> &, const Lattice<d> &, materials::Points &,            \
                              std::size_t, bool, sph::Newcomers<d> &);                                       \
  template double repair_momenta<d>(const ConversionSums &, bool, sph::Newcomers<d> &, std::size_t);            \
  template double inertia_ratio<d>(std::span<const fem::Departure<d>>, double, bool);                        \
  template ConversionSums sums_of<d>(std::span<const fem::Departure<d>>, const materials::Points &, bool);   \
  template ConversionSums sums_of<d>(const sph::Newcomers<d> &, std::size_t, bool);
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::coupling
