// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/uniform.h"

#include "core/materials/elastic_constants.h"
#include "core/materials/eos/linear.h"
#include "coupling/observers/shape.h"

#include <algorithm>
#include <cmath>

namespace ogive::coupling
{
namespace
{
Sym3 stress(const Sample &s, std::size_t i)
{
  return {s.sigma[0][i], s.sigma[1][i], s.sigma[2][i], s.sigma[3][i], s.sigma[4][i], s.sigma[5][i]};
}

const materials::Parameters &material_of(const input::Body &b, const input::Scene &scene)
{
  return *std::find_if(scene.materials.begin(), scene.materials.end(),
                       [&](const materials::Parameters &m) { return m.name == b.material; });
}
} // namespace

PatchError::PatchError(const input::Observer &o, const input::Scene &scene)
    : BodyObserver(o, scene), dim_(input::space_dimension(scene.dimension))
{
  const input::Body           &b = scene.bodies[static_cast<std::size_t>(body())];
  const materials::Parameters &m = material_of(b, scene);
  if (b.velocity_field != "stretch" || m.eos.law != materials::LinearEos::name || m.strength.law != "elastic")
    throw InputError({"", 0, "Observers/" + o.name + "/quantity"},
                     "the exact stress of the body \"" + b.name + "\" is not known",
                     "velocity field \"stretch\" and a linear elastic material");
  const materials::ElasticConstants c = materials::ElasticConstants::of(m);
  shear_                              = c.shear;
  bulk_                               = c.bulk;
  rate_  = 2 * b.velocity_field_speed / (b.shape.upper[0] - b.shape.lower[0]);
  lower_ = b.shape.lower.array() + parameter();
  upper_ = b.shape.upper.array() - parameter();
  for (int a = 0; a < dim_; ++a)
    if (!(lower_[a] < upper_[a]))
      throw InputError({"", 0, "Observers/" + o.name + "/parameter"},
                       "no point lies that far from all faces of the body \"" + b.name + "\"", "a smaller distance");
}

bool PatchError::inside(const Vec3 &x0) const
{
  for (int a = 0; a < dim_; ++a)
    if (!(x0[a] > lower_[a] && x0[a] < upper_[a]))
      return false;
  return true;
}

double PatchError::measure(const Sample &s, double time)
{
  const double e = std::log1p(rate_ * time), p = bulk_ * std::expm1(-e), across = -2. / 3 * shear_ * e - p;
  const Sym3   exact{4. / 3 * shear_ * e - p, across, across, 0, 0, 0};
  double       sum = 0, n = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i)
    if (inside(at(s.centre0, i)))
    {
      sum += (stress(s, i).matrix() - exact.matrix()).squaredNorm();
      n += 1;
    }
  return std::sqrt(sum / n / exact.matrix().squaredNorm());
}

double FractureStrain::measure(const Sample &s, double)
{
  const double length = extent_along(s, direction());
  if (std::isnan(first_length_))
    first_length_ = length;
  if (!std::isnan(value()))
    return value();
  double sum = 0, volume = 0;
  for (std::size_t i = 0; i < s.volume.size(); ++i)
  {
    sum += s.volume[i] * direction().dot(stress(s, i).matrix() * direction());
    volume += s.volume[i];
  }
  const double mean = sum / volume;
  greatest_         = std::max(greatest_, mean);
  return mean < .1 * greatest_ ? (length - first_length_) / parameter() : std::numeric_limits<double>::quiet_NaN();
}

void FractureStrain::recall(const std::vector<double> &numbers)
{
  BodyObserver::recall(numbers);
  first_length_ = numbers.at(1);
  greatest_     = numbers.at(2);
}
} // namespace ogive::coupling
