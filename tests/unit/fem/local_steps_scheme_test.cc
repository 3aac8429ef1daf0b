// SPDX-License-Identifier: LGPL-2.1-or-later
// Which scheme of local steps is stable: eigenvalues of one whole step on random
// bars, the measurement behind fem/local_steps.h. Prints the table of
// docs/local_steps.md.
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

namespace
{
using Eigen::MatrixXd;

/// How the force of an element acts on a node that steps more often than it.
enum class Scheme
{
  impulses, ///< at once, at the beginning of the element's step
  nodes,    ///< classes of nodes; an element is evaluated with the finest of its own
  held,     ///< constant over the element's step
  settled   ///< the same, and half a step of its change as an impulse
};

struct Rule
{
  double linear;     ///< bulk viscosity
  double margin;     ///< of the bound of an element that enters a class
  bool   neighbours; ///< differ by at most one class
  bool   overlap;    ///< each class reaches one layer into the next
};

struct Bar
{
  std::vector<double> length; ///< with E = rho = A = 1: mass, 1/stiffness and bound of an element
};

constexpr double step_factor = .9;
constexpr int    most        = 3; ///< classes beyond 0

double bound(double length, double linear) { return length * (std::sqrt(1 + linear * linear) - linear); }

std::vector<int> classes_of(const Bar &bar, const Rule &rule)
{
  const int    n     = static_cast<int>(bar.length.size());
  const double least = *std::min_element(bar.length.begin(), bar.length.end());
  std::vector<int> c(n, 0);
  for (int e = 0; e < n; ++e)
    while (c[e] < most && std::ldexp(least, c[e] + 1) <= rule.margin * bar.length[e] * (1 + 1e-12))
      ++c[e];
  const auto pull = [&](int level, int to) {
    const auto before = c;
    for (int e = 0; e < n; ++e)
      for (const int other : {e - 1, e + 1})
        if (other >= 0 && other < n && before[other] <= level)
          c[e] = std::min(c[e], to);
  };
  for (int level = 0; level < most; ++level)
  {
    if (rule.overlap)
      pull(level, level);
    if (rule.neighbours)
      pull(level, level + 1);
  }
  return c;
}

/// The bar during a step: each row is linear in the state before it.
struct Motion
{
  MatrixXd x, v, force, before, stretch;
};

/// Greatest modulus of an eigenvalue of one whole step; the left end is held.
double radius(const Bar &bar, Scheme scheme, const Rule &rule)
{
  const int        n = static_cast<int>(bar.length.size());
  std::vector<int> of = classes_of(bar, rule), node(n + 1, most);
  for (int e = 0; e < n; ++e)
    for (const int a : {e, e + 1})
      node[a] = std::min(node[a], of[e]);
  const int parts = 1 << *std::max_element(of.begin(), of.end());
  if (scheme == Scheme::nodes)
    for (int e = 0; e < n; ++e)
      of[e] = std::min(node[e], node[e + 1]);
  const double   h    = step_factor * bound(*std::min_element(bar.length.begin(), bar.length.end()), rule.linear);
  const int      size = 2 * (n + 1) + 2 * n;
  const MatrixXd one  = MatrixXd::Identity(size, size);
  Motion m{one.topRows(n + 1), one.middleRows(n + 1, n + 1), one.middleRows(2 * n + 2, n), one.bottomRows(n), {}};
  m.x.row(0).setZero();
  m.stretch = m.x.bottomRows(n) - m.x.topRows(n);
  for (int j = 0; j < parts; ++j)
  {
    for (int e = 0; e < n; ++e)
      for (const int a : {e, e + 1})
      {
        const double mass = .5 * ((a > 0 ? bar.length[a - 1] : 0) + (a < n ? bar.length[a] : 0));
        const double sign = a == e ? 1 : -1, long_step = std::ldexp(h, of[e]), own = std::ldexp(h, node[a]);
        const bool   starts = j % (1 << of[e]) == 0, kicks = j % (1 << node[a]) == 0;
        if (scheme == Scheme::impulses ? starts : kicks)
          m.v.row(a) += sign / mass * (scheme == Scheme::impulses ? long_step : own) * m.force.row(e);
        if (scheme == Scheme::settled && starts)
          m.v.row(a) += sign / mass * .5 * (long_step - own) * (m.force.row(e) - m.before.row(e));
      }
    m.v.row(0).setZero();
    m.x += h * m.v;
    for (int e = 0; e < n; ++e)
      if ((j + 1) % (1 << of[e]) == 0)
      {
        const Eigen::RowVectorXd now = m.x.row(e + 1) - m.x.row(e);
        m.before.row(e)              = m.force.row(e);
        m.force.row(e) = now / bar.length[e] + 2 * rule.linear * (now - m.stretch.row(e)) / std::ldexp(h, of[e]);
        m.stretch.row(e) = now;
      }
  }
  MatrixXd step(size, size);
  step << m.x, m.v, m.force, m.before;
  return Eigen::EigenSolver<MatrixXd>(step, false).eigenvalues().cwiseAbs().maxCoeff();
}

/// Elements of 1 to 1.5 with one sliver, with a fine zone, graded, or of any length.
Bar random_bar(int kind, std::mt19937 &random)
{
  std::uniform_real_distribution<double> u(0, 1);
  Bar                                    bar;
  const auto add = [&](int n, double scale) {
    for (int k = 0; k < n; ++k)
      bar.length.push_back(scale * (1 + .5 * u(random)));
  };
  if (kind == 0)
  {
    add(24, 1);
    bar.length[4 + static_cast<int>(16 * u(random))] = .12 + .3 * u(random);
  }
  else if (kind == 1)
  {
    const double scale = .125 + .4 * u(random);
    add(10, 1);
    add(12, scale);
    add(6, 1);
  }
  else if (kind == 2)
  {
    const double shrink = .75 + .15 * u(random);
    double       length = 1;
    add(8, 1);
    for (int k = 0; k < 14; ++k, length *= shrink)
      bar.length.push_back(length * (.9 + .2 * u(random)));
    bar.length.insert(bar.length.end(), 6, length);
  }
  else
    for (int k = 0; k < 24; ++k)
      bar.length.push_back(std::pow(2., -3.5 * u(random)));
  return bar;
}

struct Outcome
{
  int    bars = 0, unstable = 0;
  double worst = 0; ///< growth of a whole step
};

Outcome measure(Scheme scheme, const Rule &rule)
{
  constexpr int bars_a_kind = 40;
  std::mt19937  random(42);
  Outcome       out;
  for (int kind = 0; kind < 4; ++kind)
    for (int k = 0; k < bars_a_kind; ++k)
    {
      const double growth = radius(random_bar(kind, random), scheme, rule) - 1;
      ++out.bars;
      out.unstable += growth > 1e-7; // 1 % over 1e5 steps
      out.worst = std::max(out.worst, growth);
    }
  return out;
}
} // namespace

// Impulses are stable where neighbours differ by one class and there is a little
// linear viscosity, or classes overlap: the rules of fem/local_steps.h.
TEST(LocalStepsScheme, ImpulsesAreStableByTheRules)
{
  const Rule free{0, 1, false, false}, neighbours{0, .8, true, false}, overlap{0, .8, true, true},
    dull{.02, 1, true, false}, usual{.06, 1, true, false};
  const std::pair<const char *, Scheme> schemes[] = {
    {"impulses", Scheme::impulses}, {"nodes", Scheme::nodes}, {"held", Scheme::held}, {"settled", Scheme::settled}};
  const std::pair<const char *, Rule> rules[] = {{"any classes, undamped", free},
                                                 {"neighbours, undamped", neighbours},
                                                 {"neighbours, overlap, undamped", overlap},
                                                 {"neighbours, linear .02", dull},
                                                 {"neighbours, linear .06", usual}};
  for (const auto &[name, scheme] : schemes)
    for (const auto &[label, rule] : rules)
    {
      const Outcome out = measure(scheme, rule);
      std::printf("%-9s %-31s unstable %3d of %d, greatest growth %.1e\n", name, label, out.unstable, out.bars, out.worst);
      const bool ours = scheme == Scheme::impulses && (rule.overlap || rule.linear > 0);
      if (ours)
        EXPECT_EQ(out.unstable, 0) << label;
      if (scheme == Scheme::held || scheme == Scheme::settled)
        EXPECT_GT(out.unstable, rule.linear > 0 ? -1 : out.bars / 2) << label;
    }
}
