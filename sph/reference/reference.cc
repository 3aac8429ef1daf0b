// SPDX-License-Identifier: LGPL-2.1-or-later
#include "sph/reference/layout.h"

#include "core/base/error.h"
#include "sph/corrector.h"
#include "sph/implementation.h"
#include "sph/kernels/kernels.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

/// The reference configuration: neighbours, kernel and volumes of t = 0. What a
/// pair is stays, so that stretching cannot part it.
namespace ogive::sph
{
namespace
{
/// Share of its Gershgorin sum by which the hourglass potential raises the
/// bound on the highest frequency squared. Fitted to when free blocks explode,
/// h = 1 to 2 spacings, hourglass stiffness up to .5: in one dimension .57 at h =
/// 1.3 and .5, less elsewhere.
constexpr double unseen_share = .6;

/// Secant modulus over that of elasticity, e_y/(e_y + e_p): e_p the plastic strain
/// and e_y the elastic one of the mean flow stress so far, plastic work over
/// plastic strain. The potential of material that flows fades with it, or the
/// hourglass control would hold up what the stress no longer does.
double secant_share(const materials::Points &points, std::size_t i, double shear_modulus)
{
  const double flow = points.plastic_strain[i];
  if (!(flow > 0))
    return 1;
  const double elastic = points.density[i] * points.plastic_work[i] / (3 * shear_modulus * flow);
  return elastic / (elastic + flow);
}
} // namespace

template <int dim>
void Solver<dim>::Implementation::check_reference() const
{
  const auto &o       = parameters.options;
  const auto  clashes = [](const std::string &entry, const std::string &value, const std::string &use) {
    throw InputError({"", 0, "SPH/" + entry}, "\"" + value + "\" does not go with configuration = reference", use,
                     "configuration = current");
  };
  if (parameters.axisymmetric)
    throw InputError({"", 0, "SPH/configuration"}, "rings have no reference configuration",
                     "current in an axisymmetric scene");
  if (o.form != "corrected")
    clashes("form", o.form, "corrected");
  if (o.density != "continuity")
    clashes("density", o.density, "continuity, which is rho0/J there");
  if (o.artificial_stress > 0)
    clashes("artificial stress", std::to_string(o.artificial_stress), "0: particles do not pair up there");
  for (const auto &b : bodies)
  {
    const auto &m = b.material->parameters();
    if (m.damage.law != "none")
      throw InputError({"", 0, "SPH/configuration"},
                       "\"reference\" keeps the neighbours of t = 0, but the material \"" + m.name +
                         "\" can break (Damage/law = " + m.damage.law + ")",
                       "current, or a material without damage");
  }
}

template <int dim>
void Solver<dim>::Implementation::begin_reference()
{
  check_reference();
  const std::size_t n = store.size();
  auto             &r = reference;
  r.density           = store.points.density;
  r.own               = n;
  for (auto *a : {&r.volume, &r.modulus, &r.wave_number, &r.stiffness})
    a->assign(n, 0.);
  r.deformation.assign(n * dim * dim, 0.);
  r.inverse_moment.assign(n * dim * dim, 0.);
  for (std::size_t i = 0; i < n; ++i)
  {
    const double c = store.points.sound_speed[i];
    r.volume[i]    = store.mass[i] / r.density[i];
    r.modulus[i]   = parameters.options.hourglass_stiffness * r.density[i] * c * c;
    for (int a = 0; a < dim; ++a)
      r.deformation[i * dim * dim + a * dim + a] = 1;
  }
}

template <int dim>
void Solver<dim>::Implementation::begin_reference_again(const ReferenceState &first, const std::vector<std::int64_t> &ids)
{
  auto             &r       = reference;
  const auto        as_they_were = [&](const AlignedVector<double> &of, AlignedVector<double> &to) {
    const auto          all = ranks.gather(std::span(of.data(), first.own));
    std::vector<double> by_id(ids.size());
    for (std::size_t k = 0; k < ids.size(); ++k)
      by_id[static_cast<std::size_t>(ids[k])] = all[k];
    to.resize(store.size());
    for (std::size_t i = 0; i < store.size(); ++i)
      to[i] = by_id.at(static_cast<std::size_t>(store.id[i]));
  };
  as_they_were(first.density, r.density);
  as_they_were(first.volume, r.volume);
  as_they_were(first.modulus, r.modulus);
  r.own = store.size();
  for (auto *a : {&r.wave_number, &r.stiffness})
    a->assign(store.size(), 0.);
  r.inverse_moment.assign(store.size() * dim * dim, 0.);
}

template <int dim>
void Solver<dim>::Implementation::slopes_of(const Body &b)
{
  const std::size_t n = store.size(), all = n + ghosts.size();
  auto             &r = reference;
  with_kernel(parameters.options.kernel, [&](auto k) {
    const KernelAt<decltype(k), dim> kernel(b.h);
    for (std::size_t i = b.first; i < b.last; ++i)
    {
      double sum = 0;
      for (std::size_t p = pairs.rows.row[i]; p < pairs.rows.row[i + 1]; ++p)
      {
        const std::size_t j = pairs.rows.index[p];
        if (j == all) // fills the row
          continue;
        const std::size_t parent = j < n ? j : ghosts.parent[j - n];
        double            r2     = 0;
        for (int a = 0; a < dim; ++a)
        {
          const double d = force_records[i * L::force_stride + L::x + a] - force_records[j * L::force_stride + L::x + a];
          r2 += d * d;
        }
        const double inv_r = kernel.inverse_distance(r2), g = kernel.slope(r2 * inv_r, inv_r);
        r.slope[p]         = g;
        r.viscous_slope[p] = g * r2 / (r.density[i] + r.density[parent]);
        sum -= g * r.volume[parent] * (r.modulus[i] + r.modulus[parent]);
      }
      r.stiffness[i] = unseen_share * 2 * sum * r.volume[i] / store.mass[i];
    }
  });
}

template <int dim>
void Solver<dim>::Implementation::pack_lattice()
{
  for (std::size_t i = 0; i < store.size(); ++i)
  {
    double *r = &force_records[i * L::force_stride];
    for (int a = 0; a < dim; ++a)
      r[L::x + a] = store.x0[a][i];
    r[L::weight]  = reference.volume[i];
    r[L::density] = reference.density[i];
  }
}

template <int dim>
void Solver<dim>::Implementation::set_reference()
{
  auto &r = reference;
  r.records.assign((store.size() + ghosts.size() + 1) * ReferenceLayout<dim>::stride, 0.);
  r.slope.assign(pairs.rows.index.size(), 0.);
  r.viscous_slope.assign(pairs.rows.index.size(), 0.);
  pack_motion();
  for (auto *a : {&r.volume, &r.density, &r.modulus}) // those of other ranks' particles behind
  {
    a->resize(store.size() + ghosts.size());
    exchange(*a, 1, 0, 1);
  }
  for (const auto &b : bodies)
    slopes_of(b);
  sweep_all(&SweepFunctions::gradient, gradient_sums, L::gradient_stride, L::n_gradient);
  std::int64_t fallbacks = 0;
  for (std::size_t i = 0; i < store.size(); ++i)
  {
    const double                  *sums = &gradient_sums[i * L::gradient_stride];
    const Eigen::Map<const Vector> normal(sums + L::normal_sum);
    Matrix                         b;
    fallbacks += !corrector<dim>(moment(i), b);
    std::copy(b.data(), b.data() + dim * dim, &r.inverse_moment[i * dim * dim]);
    r.wave_number[i] = b.cwiseAbs().rowwise().sum().maxCoeff() * sums[L::stiffness_sum] +
                       surface_share * (b * normal).norm();
  }
  r.fallbacks = ranks.sum(fallbacks);
}

/// From the sums `l` of the gradient sweep: F at the end of the step, exact
/// because x = F X moves with the same v; the velocity gradient into `l`, and
/// what makes it of such sums into `b`. False where F is no longer one to one.
template <int dim>
bool Solver<dim>::Implementation::deform(std::size_t i, double dt, Matrix &l, Matrix &b)
{
  Eigen::Map<Matrix>             f(&reference.deformation[i * dim * dim]);
  const Eigen::Map<const Matrix> b0(&reference.inverse_moment[i * dim * dim]);
  const Matrix                   rate = l * b0;
  f += dt * rate;
  if (!(f.determinant() > 0))
    return false;
  const Matrix inverse = f.inverse();
  b                    = b0 * inverse;
  l                    = rate * inverse;
  return true;
}

template <int dim>
void Solver<dim>::Implementation::pack_reference(const Body &body, std::size_t i, const Matrix &b)
{
  using R            = ReferenceLayout<dim>;
  const auto  &points = store.points;
  double      *motion = &force_records[i * L::force_stride];
  double      *to     = &reference.records[i * R::stride];
  const Matrix f      = deformation(i);
  const Mat3   sigma = points.stress(i).matrix();
  const double modulus = reference.modulus[i] * secant_share(points, i, body.material->shear_modulus());
  const Matrix p     = f.determinant() * sigma.template topLeftCorner<dim, dim>() * b.transpose();
  for (int a = 0; a < dim; ++a)
  {
    to[R::reference + a] = store.x0[a][i];
    to[R::x + a]         = store.x[a][i];
    to[R::v + a]         = store.v[a][i];
    for (int c = 0; c < dim; ++c)
    {
      motion[L::p + a * dim + c] = p(a, c);
      to[R::t + a * dim + c]     = p(a, c) - modulus * f(a, c);
    }
  }
  std::copy(motion + L::rate, motion + L::rate + L::n_sym, to + R::rate);
  const double sound = points.sound_speed[i];
  to[R::volume]      = reference.volume[i];
  to[R::density]     = store.swept_density[i];
  to[R::sound]       = sound;
  to[R::modulus]     = modulus;

  // The lattice at rest with the spacings of now, and the hourglass potential.
  Eigen::SelfAdjointEigenSolver<Matrix> stretch;
  stretch.computeDirect(f.transpose() * f, Eigen::EigenvaluesOnly);
  const double closer = 1 / std::sqrt(std::max(stretch.eigenvalues()[0], 1e-12));
  const double c2     = sound * sound;
  const double w2     = closer * closer * reference.wave_number[i] * reference.wave_number[i] * c2 +
                    reference.stiffness[i] / (shares.frequency * shares.frequency);
  wave_number[i]      = c2 > 0 ? std::sqrt(w2 / c2) : 0.;
}

template <int dim>
void Solver<dim>::Implementation::reflect_reference()
{
  using R = ReferenceLayout<dim>;
  exchange(reference.records, R::stride, 0, R::n_fields);
  for (std::size_t g = 0; g < ghosts.size(); ++g)
  {
    const double *from = &reference.records[ghosts.parent[g] * R::stride];
    double       *to   = image_record(reference.records, R::stride, g);
    const auto   &s    = ghosts.sign[g];
    if (from != to)
      std::copy(from, from + R::stride, to);
    for (int a = 0; a < dim; ++a)
    {
      for (const int at : {R::reference, R::x, R::v})
        to[at + a] = s[a] * from[at + a];
      for (int b = 0; b < dim; ++b)
      {
        to[R::t + a * dim + b]     = s[a] * s[b] * from[R::t + a * dim + b];
        to[R::rate + L::sym(a, b)] = s[a] * s[b] * from[R::rate + L::sym(a, b)];
      }
    }
  }
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void Solver<d>::Implementation::check_reference() const;                                          \
  template void Solver<d>::Implementation::begin_reference();                                                \
  template void Solver<d>::Implementation::begin_reference_again(const ReferenceState &,                     \
                                                                 const std::vector<std::int64_t> &);         \
  template void Solver<d>::Implementation::slopes_of(const Body &);                                          \
  template void Solver<d>::Implementation::pack_lattice();                                                   \
  template void Solver<d>::Implementation::set_reference();                                                  \
  template bool Solver<d>::Implementation::deform(std::size_t, double, Matrix &, Matrix &);                  \
  template void Solver<d>::Implementation::pack_reference(const Body &, std::size_t, const Matrix &);        \
  template void Solver<d>::Implementation::reflect_reference();
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::sph
