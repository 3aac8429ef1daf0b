// SPDX-License-Identifier: LGPL-2.1-or-later
// Every registered kernel, in every dimension: the definition of a kernel.
#include "sph/kernels/kernels.h"

#include <gtest/gtest.h>

namespace
{
using namespace ogive::sph;

template <class Kernel, int dim>
void conformance()
{
  SCOPED_TRACE(std::string(Kernel::name) + " in " + std::to_string(dim) + "-D");
  const double                h = .37;
  const KernelAt<Kernel, dim> kernel(h);
  const double                end = Kernel::support * h;

  // Unity: Simpson over the radius, surface of the unit sphere 2, 2 pi, 4 pi.
  // The kinks sit on the grid, so the rule's error is O(n^-4).
  const int    n     = 4000;
  double       total = 0;
  const double shell = dim == 1 ? 2 : dim == 2 ? 2 * M_PI : 4 * M_PI;
  for (int k = 0; k <= n; ++k)
  {
    const double r = end * k / n;
    total += (k == 0 || k == n ? 1 : k % 2 ? 4 : 2) * shell * std::pow(r, dim - 1) * kernel.value(r);
  }
  EXPECT_NEAR(total * end / (3 * n), 1, 1e-10);

  // Gradient against a central difference of the value.
  for (double q : {.05, .31, .77, .99, 1.01, 1.3, 1.71, 1.98})
  {
    const double r = q * h, d = 1e-5 * h;
    const double difference = (kernel.value(r + d) - kernel.value(r - d)) / (2 * d);
    EXPECT_NEAR(kernel.slope(r, 1 / r) * r, difference, 1e-8 * kernel.value(0.) / h) << q;
    EXPECT_LT(kernel.slope(r, 1 / r), 0) << q;
    EXPECT_GT(kernel.value(r), 0) << q;
  }
  // Nothing beyond the support; finite at the centre.
  for (double q : {1.0001 * Kernel::support, 2 * Kernel::support, 1e6})
  {
    EXPECT_EQ(kernel.value(q * h), 0);
    EXPECT_EQ(kernel.slope(q * h, 1 / (q * h)), 0);
  }
  EXPECT_TRUE(std::isfinite(kernel.slope(0., kernel.inverse_distance(0.))));
  // Registers give what numbers give.
  const ogive::VDouble r(.6 * h);
  EXPECT_NEAR(ogive::VDouble(kernel.value(r))[0], kernel.value(.6 * h), 1e-14 * kernel.value(0.));
}

template <std::size_t k = 0>
void all_kernels()
{
  if constexpr (k < std::tuple_size_v<Kernels>)
  {
    using Kernel = std::tuple_element_t<k, Kernels>;
    conformance<Kernel, 1>();
    conformance<Kernel, 2>();
    conformance<Kernel, 3>();
    EXPECT_EQ(with_kernel(Kernel::name, [](auto found) { return std::is_same_v<decltype(found), Kernel>; }), true);
    all_kernels<k + 1>();
  }
}

TEST(Kernels, UnityGradientSupport)
{
  all_kernels();
}

TEST(Kernels, UnknownNameIsAnInputError)
{
  EXPECT_THROW(with_kernel("gauss", [](auto) {}), ogive::InputError);
}
} // namespace
