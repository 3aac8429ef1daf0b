// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/materials/material.h"

#include "core/materials/composed_material.h"
#include "core/materials/rotation.h"

namespace ogive::materials
{
const char *describe(Status s)
{
  switch (s)
    {
      case Status::ok:
        return "ok";
      case Status::not_finite:
        return "a value of the material state is not finite";
      case Status::density_not_positive:
        return "the density is not positive";
      case Status::sound_speed_imaginary:
        return "the state lies outside the equation of state: its sound speed is not real";
    }
  return "unknown";
}

std::unique_ptr<const Material> make_material(const Parameters &p)
{
  return std::make_unique<const ComposedMaterial>(p);
}

namespace
{
const Parameters &checked(const Parameters &p)
{
  positive(p.density, "density", "every material");
  if (!std::isnan(p.thermal.specific_heat))
    {
      const char *why = "heating by plastic work";
      positive(p.thermal.specific_heat, "Thermal/specific heat", why);
      fraction(p.thermal.taylor_quinney, "Thermal/taylor-quinney", why);
      positive(p.thermal.reference_temperature, "Thermal/reference temperature", why);
    }
  return p;
}
} // namespace

ComposedMaterial::ComposedMaterial(const Parameters &p)
  : parameters_(checked(p))
  , eos_(Laws<AnyEos>::build(p.eos.law, p, "EOS/law"))
  , strength_(Laws<AnyStrength>::build(p.strength.law, p, "Strength/law"))
  , damage_(Laws<AnyDamage>::build(p.damage.law, p, "Damage/law"))
{
  solid_    = std::visit([](const auto &law) { return law.solid; }, strength_);
  can_fail_ = std::visit([](const auto &law) { return law.damages; }, damage_);
  if (solid_)
    shear_ = positive(ElasticConstants::of(p).shear, "shear modulus",
                      "a solid (or a young modulus and poisson ratio)");
  rest_ = std::visit([&](const auto &law) { return law.at(p.density, 0.); }, eos_).sound_speed_squared;
  tension_ = std::isnan(p.eos.tension_cutoff)
               ? std::numeric_limits<double>::infinity()
               : not_negative(p.eos.tension_cutoff, "EOS/tension cutoff", "the cutoff");
  if (!std::isnan(p.thermal.specific_heat))
    heating_ = p.thermal.taylor_quinney / p.thermal.specific_heat;
}

double ComposedMaterial::bulk_modulus() const
{
  return parameters_.density * rest_;
}

double ComposedMaterial::sound_speed() const
{
  return std::sqrt(rest_ + 4. / 3. * shear_ / parameters_.density);
}

void ComposedMaterial::initialise(Points &points, std::size_t begin, std::size_t end) const
{
  const double reference = parameters_.thermal.reference_temperature;
  for (std::size_t i = begin; i < end; ++i)
    {
      points.for_each_array([i](const char *, AlignedVector<double> &a) { a[i] = 0; });
      points.density[i]     = parameters_.density;
      points.temperature[i] = std::isnan(reference) ? 0 : reference;
      points.sound_speed[i] = sound_speed();
    }
}

/// What the stages of one chunk tell each other. Stresses are undamaged ones
/// (stored stress / (1 - D)) up to the finish.
struct ComposedMaterial::Chunk
{
  static constexpr std::size_t capacity = 64;
  using Row                             = double[capacity];

  std::size_t begin, n;  ///< first point, points
  std::size_t at;        ///< offset of the first point in the increments
  const double *density; ///< at the end of the step
  double        dt;

  alignas(64) Row s[6];                 ///< deviator
  alignas(64) Row old_stress, stress;   ///< von Mises, before and after the elastic step
  alignas(64) Row kept;                 ///< share of the trial deviator that the return keeps
  alignas(64) Row increment;            ///< of the plastic strain
  alignas(64) Row trace;                ///< of the strain increment
  alignas(64) Row old_power, add_power; ///< deviator : strain increment, of the old stress, and the elastic addition
  alignas(64) Row old_pressure;         ///< as stored
  alignas(64) Row pressure;             ///< after the tension cutoff
  alignas(64) Row bulk;                 ///< bulk sound speed squared
};

template <bool softened>
void ComposedMaterial::trial(Chunk &c, const Points &p, const Increments &inc) const
{
  const double two_g = 2 * shear_;
  for_lanes(c.n, [&]<class T>(std::size_t i) {
    const std::size_t j = c.begin + i, k = c.at + i;
    std::array<T, 6>  s, e;
    for (int a = 0; a < 6; ++a)
      {
        s[a] = load<T>(p.sigma[a].data() + j);
        e[a] = load<T>(inc.strain[a] + k);
      }
    const T mean = (s[0] + s[1] + s[2]) * T(1. / 3);
    const T tr   = e[0] + e[1] + e[2];
    for (int a = 0; a < 3; ++a)
      {
        s[a] -= mean;
        e[a] -= tr * T(1. / 3);
      }
    store(c.old_pressure + i, -mean);
    store(c.trace + i, tr);
    if constexpr (softened)
      {
        const T d       = load<T>(p.damage.data() + j);
        const T inverse = select(d < T(1), T(1) / (T(1) - d), T(0));
        for (T &component : s)
          component *= inverse;
      }
    rotate_hughes_winget(
      s, load<T>(inc.spin[0] + k), load<T>(inc.spin[1] + k), load<T>(inc.spin[2] + k));

    const auto product = [](const std::array<T, 6> &a, const std::array<T, 6> &b) {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] +
             T(2) * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
    };
    const T ss = product(s, s), se = product(s, e), ee = product(e, e);
    using std::sqrt;
    store(c.old_stress + i, sqrt(T(1.5) * ss));
    store(c.old_power + i, se);
    store(c.add_power + i, T(two_g) * ee);
    for (int a = 0; a < 6; ++a)
      {
        s[a] += T(two_g) * e[a];
        store(c.s[a] + i, s[a]);
      }
    store(c.stress + i, sqrt(T(1.5) * product(s, s)));
    store(c.kept + i, T(1));
    store(c.increment + i, T(0));
  });
}

template <class Strength>
void ComposedMaterial::flow(Chunk &c, Points &p, const Strength &law) const
{
  if constexpr (Strength::yields)
    for_lanes(c.n, [&]<class T>(std::size_t i) {
      const std::size_t j      = c.begin + i;
      const T           strain = load<T>(p.plastic_strain.data() + j);
      const T           warmth = load<T>(p.temperature.data() + j);
      const T           stress = load<T>(c.stress + i);
      const T           intact = T(1) - load<T>(p.damage.data() + j);
      // Failed points store no stress, so none is returned.
      const auto may_yield = stress > law.elastic_up_to(strain, warmth) && intact > T(0);
      if (!any(may_yield))
        return;
      const T per_mass = intact * T(2) / (load<T>(p.density.data() + j) + load<T>(c.density + i));
      Flow<T> f        = law.flow(Trial<T>{stress, load<T>(c.old_stress + i), 3 * shear_, strain, warmth,
                                           c.dt, T(heating_) * per_mass});
      f.increment      = select(may_yield, f.increment, T(0));
      f.work           = select(may_yield, f.work, T(0));
      const T kept =
        select(f.increment > T(0), T(1) - T(3 * shear_) * f.increment / stress, T(1));
      store(c.kept + i, kept);
      store(c.increment + i, f.increment);
      for (int a = 0; a < 6; ++a)
        store(c.s[a] + i, kept * load<T>(c.s[a] + i));
      store(p.plastic_strain.data() + j, strain + f.increment);
      store(p.plastic_work.data() + j, load<T>(p.plastic_work.data() + j) + per_mass * f.work);
      store(p.temperature.data() + j, warmth + T(heating_) * per_mass * f.work);
    });
}

template <class Eos>
void ComposedMaterial::pressure(Chunk &c, const Points &p, const Eos &eos) const
{
  for_lanes(c.n, [&]<class T>(std::size_t i) {
    const std::size_t j   = c.begin + i;
    const T           rho = load<T>(c.density + i);
    // Half the work of the step, by the mean of old and new deviator; the
    // pressure enters with its old value, an error that does not accumulate.
    const T old_power = load<T>(c.old_power + i);
    const T shear     = T(.5) * (T(1) - load<T>(p.damage.data() + j)) *
                    (old_power + load<T>(c.kept + i) * (old_power + load<T>(c.add_power + i)));
    const T work = shear - load<T>(c.old_pressure + i) * load<T>(c.trace + i);
    const T e    = load<T>(p.energy.data() + j) + work / (load<T>(p.density.data() + j) + rho);
    const EosResponse<T> r = carry_tension(eos.at(rho, e), tension_, T(1), rest_);
    store(c.pressure + i, r.pressure);
    store(c.bulk + i, r.sound_speed_squared);
  });
}

template <class Damage>
void ComposedMaterial::damage(Chunk &c, Points &p, const Damage &law) const
{
  if constexpr (Damage::damages)
    for (std::size_t i = 0; i < c.n; ++i)
      {
        const std::size_t j = c.begin + i;
        if (p.damage[j] < 1)
          p.damage[j] = law.after({p.damage[j], p.plastic_strain[j], c.increment[i], -c.pressure[i],
                                   c.kept[i] * c.stress[i], p.temperature[j], c.dt});
        const EosResponse<double> r =
          carry_tension<double>({c.pressure[i], c.bulk[i]}, tension_, 1 - p.damage[j], rest_);
        c.pressure[i] = r.pressure;
        c.bulk[i]     = r.sound_speed_squared;
      }
}

/// Writes stress, density and sound speed. False if a point is at fault.
bool ComposedMaterial::finish(Chunk &c, Points &p) const
{
  bool good = true;
  for_lanes(c.n, [&]<class T>(std::size_t i) {
    const std::size_t j      = c.begin + i;
    const T           rho    = load<T>(c.density + i);
    const T           intact = T(1) - load<T>(p.damage.data() + j);
    const T           mean   = -load<T>(c.pressure + i);
    T                 sum    = mean;
    for (int a = 0; a < 6; ++a)
      {
        T s = intact * load<T>(c.s[a] + i);
        if (a < 3)
          s += mean;
        sum += s;
        store(p.sigma[a].data() + j, s);
      }
    const T bulk = load<T>(c.bulk + i);
    using std::sqrt;
    const T speed = sqrt(bulk + intact * T(4. / 3 * shear_) / rho);
    store(p.sound_speed.data() + j, speed);
    store(p.density.data() + j, rho);
    sum += speed + load<T>(p.energy.data() + j) + load<T>(p.plastic_strain.data() + j) +
           load<T>(p.plastic_work.data() + j) + load<T>(p.temperature.data() + j);
    // A NaN or an infinity anywhere turns the last term into a NaN.
    good = good && all(rho > T(0)) && all(bulk >= T(0)) && all(sum * T(0) == T(0));
  });
  return good;
}

Status ComposedMaterial::first_fault(const Chunk &c, const Points &p, std::size_t &bad) const
{
  for (std::size_t i = 0; i < c.n; ++i)
    {
      bad                 = c.begin + i;
      const double values = p.stress(bad).contract({1, 1, 1, 1, 1, 1}) + p.energy[bad] +
                            p.plastic_strain[bad] + p.plastic_work[bad] + p.damage[bad] +
                            p.temperature[bad] + c.density[i] + c.bulk[i];
      const bool finite = std::isfinite(values);
      if (c.density[i] <= 0)
        return Status::density_not_positive;
      if (finite && c.bulk[i] < 0)
        return Status::sound_speed_imaginary;
      if (!finite || !std::isfinite(p.sound_speed[bad]))
        return Status::not_finite;
    }
  bad = c.begin; // finite numbers whose sum overflows
  return Status::not_finite;
}

Status ComposedMaterial::update(Points &points, std::size_t begin, std::size_t end,
                                const Increments &inc, std::size_t &bad) const
{
  Chunk c;
  c.dt = inc.dt;
  for (std::size_t first = begin; first < end; first += Chunk::capacity)
    {
      c.begin   = first;
      c.n       = std::min(Chunk::capacity, end - first);
      c.at      = first - begin;
      c.density = inc.density + c.at;
      if (can_fail_)
        trial<true>(c, points, inc);
      else
        trial<false>(c, points, inc);
      std::visit([&](const auto &law) { flow(c, points, law); }, strength_);
      std::visit([&](const auto &law) { pressure(c, points, law); }, eos_);
      std::visit([&](const auto &law) { damage(c, points, law); }, damage_);
      if (!finish(c, points))
        return first_fault(c, points, bad);
    }
  return Status::ok;
}
} // namespace ogive::materials
