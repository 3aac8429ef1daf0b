// SPDX-License-Identifier: LGPL-2.1-or-later
// A clamped plate in the reference configuration against the matrix of its
// potential, written down from the sums alone.
#include "sph/kernels/kernels.h"
#include "support.h"

#include <gtest/gtest.h>

namespace
{
using namespace ogive;
using namespace ogive::sph;
using namespace ogive::sph::test;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double spacing = 2e-3, h = 1.3 * spacing, density = 1000, bulk = 9e6, shear = 3e6, stiffness = .2;
constexpr double volume = spacing * spacing, modulus = bulk + 4. / 3 * shear;

/// Stiffness of particle i's own potential: stress of its gradient, B0 sum w
/// (u_j - u_i) (x) X, and what the gradient does not see.
void add_particle(std::size_t i, const std::vector<Vector2d> &x, MatrixXd &k)
{
  const KernelAt<CubicSpline, 2> kernel(h);
  std::vector<std::size_t>       near;
  std::vector<double>            w;
  Eigen::Matrix2d                moment = Eigen::Matrix2d::Zero();
  for (std::size_t j = 0; j < x.size(); ++j)
  {
    const Vector2d y = x[j] - x[i];
    const double   r = y.norm();
    if (j == i || r >= 2 * h)
      continue;
    near.push_back(j);
    w.push_back(-volume * kernel.slope(r, 1 / r));
    moment += w.back() * y * y.transpose();
  }
  const Eigen::Matrix2d b = moment.inverse();
  const auto            m = static_cast<Eigen::Index>(near.size());
  MatrixXd              difference = MatrixXd::Zero(m, x.size()), fit = MatrixXd::Zero(m, x.size());
  MatrixXd              gradient = MatrixXd::Zero(2, x.size());
  for (Eigen::Index p = 0; p < m; ++p)
  {
    difference(p, near[p]) = 1;
    difference(p, i)       = -1;
    gradient += w[p] * b * (x[near[p]] - x[i]) * difference.row(p);
  }
  for (Eigen::Index p = 0; p < m; ++p)
    fit.row(p) = (x[near[p]] - x[i]).transpose() * gradient;
  const Eigen::Index n = std::ssize(x);
  MatrixXd           strain = MatrixXd::Zero(3, 2 * n); // xx yy 2xy of (u_x, u_y)
  strain.topLeftCorner(1, n) = strain.bottomRightCorner(1, n) = gradient.row(0);
  strain.block(1, n, 1, n) = strain.bottomLeftCorner(1, n) = gradient.row(1);
  const double    lame = bulk - 2. / 3 * shear;
  Eigen::Matrix3d law;
  law << lame + 2 * shear, lame, 0, lame, lame + 2 * shear, 0, 0, 0, shear;
  k += volume * strain.transpose() * law * strain;
  const MatrixXd unseen = difference - fit;
  const MatrixXd own    = volume * stiffness * modulus * unseen.transpose() *
                       VectorXd(Eigen::Map<const VectorXd>(w.data(), m)).asDiagonal() * unseen;
  k.topLeftCorner(n, n) += own;
  k.bottomRightCorner(n, n) += own;
}

TEST(ReferencePlate, SwingsAsItsMatrixSays)
{
  auto p = box<2>(Vec3::Zero(), spacing * Vec3(20, 4, 0), spacing, material(density, bulk, shear));
  std::vector<Vector2d> x;
  for (const auto &c : p.x)
    x.emplace_back(c[0], c[1]);
  const Eigen::Index n = std::ssize(x);
  MatrixXd           k = MatrixXd::Zero(2 * n, 2 * n);
  for (std::size_t i = 0; i < x.size(); ++i)
    add_particle(i, x, k);
  std::vector<Eigen::Index> free;
  for (Eigen::Index d = 0; d < 2 * n; ++d)
    if (x[d % n][0] > 2 * h) // as mark_boundaries holds them
      free.push_back(d);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(k(free, free));
  const double   frequency = std::sqrt(modes.eigenvalues()[0] / (density * volume));
  const VectorXd mode      = modes.eigenvectors().col(0);

  for (std::size_t q = 0; q < free.size(); ++q)
    p.v[free[q] % n][free[q] / n] = 1e-4 * mode[static_cast<Eigen::Index>(q)];
  Parameters q;
  q.options.configuration       = "reference";
  q.options.correction          = "none";
  q.options.hourglass_stiffness = stiffness;
  q.options.alpha = q.options.beta = q.options.hourglass = 0;
  q.boundaries.push_back({});
  q.boundaries.back().kind = input::BoundaryKind::fixed;
  q.boundaries.back().face = "x-";
  q.boundary_bodies.push_back(0);
  Solver<2>    solver(q, {p});
  Runner<2>    run{solver};
  const double dt = .2 * solver.stable_dt().dt;
  // The mode's coordinate passes through zero after half a period.
  double before = 0, now = 0;
  while (run.time < 1.2 * M_PI / frequency && !(now < 0))
  {
    ASSERT_TRUE(run.step(dt).ok);
    before         = now;
    now            = 0;
    const Sample s = solver.sample(0);
    for (std::size_t c = 0; c < s.id.size(); ++c)
      for (std::size_t f = 0; f < free.size(); ++f)
        if (free[f] % n == s.id[c])
          now += mode[static_cast<Eigen::Index>(f)] * (s.x[free[f] / n][c] - s.x0[free[f] / n][c]);
  }
  const double half = run.time - dt * now / (now - before);
  // (w dt)^2/24 of the leapfrog is 1e-7, the amplitude 1e-6 of the length.
  EXPECT_NEAR(half * frequency / M_PI, 1, 1e-5);
}
} // namespace
