// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/observers/observer.h"

#include "core/base/error.h"
#include "coupling/observers/bending.h"
#include "coupling/observers/cavity.h"
#include "coupling/observers/collapse.h"
#include "coupling/observers/crater.h"
#include "coupling/observers/heat.h"
#include "coupling/observers/modes.h"
#include "coupling/observers/motion.h"
#include "coupling/observers/pieces.h"
#include "coupling/observers/profile.h"
#include "coupling/observers/shape.h"
#include "coupling/observers/shares.h"
#include "coupling/observers/shocks.h"
#include "coupling/observers/uniform.h"
#include "coupling/observers/vibration.h"
#include "coupling/observers/waves.h"

#include <array>

namespace ogive::coupling
{
void Observer::save(ArchiveWriter &archive, const std::string &prefix) const
{
  const std::vector<double> numbers = memory();
  if (!numbers.empty())
    archive.write(prefix, std::span<const double>(numbers));
}

void Observer::load(const ArchiveReader &archive, const std::string &prefix)
{
  if (!memory().empty())
    recall(archive.doubles(prefix));
}

namespace
{
template <class Kind>
std::unique_ptr<Observer> make(const input::Observer &o, const input::Scene &scene)
{
  return std::make_unique<Kind>(o, scene);
}

struct Maker
{
  const char *quantity;
  std::unique_ptr<Observer> (*make)(const input::Observer &, const input::Scene &);
};

constexpr std::array makers = {
  Maker{"final_length", make<Length>},
  Maker{"foot_radius", make<FootRadius>},
  Maker{"displacement", make<Displacement>},
  Maker{"residual_velocity", make<MeanVelocity>},
  Maker{"rebound_velocity", make<MeanVelocity>},
  Maker{"perforated", make<Perforation>},
  Maker{"contact_time", make<ContactTime>},
  Maker{"plastic_shock_speed", make<FrontSpeed>},
  Maker{"precursor_speed", make<FrontSpeed>},
  Maker{"plateau_stress", make<PlateauStress>},
  Maker{"gauge_displacement", make<GaugeDisplacement>},
  Maker{"gauge_velocity", make<GaugeVelocity>},
  Maker{"gauge_stress", make<GaugeStress>},
  Maker{"angular_momentum_drift", make<AngularMomentumDrift>},
  Maker{"energy_kept", make<EnergyKept>},
  Maker{"peak_stress", make<PeakStress>},
  Maker{"period", make<Period>},
  Maker{"amplitude_loss", make<AmplitudeLoss>},
  Maker{"tip_deflection", make<TipDeflection>},
  Maker{"mid_deflection", make<MidDeflection>},
  Maker{"greatest_deflection", make<GreatestDeflection>},
  Maker{"tip_rotation", make<TipRotation>},
  Maker{"twist", make<Twist>},
  Maker{"cavity_error", make<CavityError>},
  Maker{"stopping_radius", make<StoppingRadius>},
  Maker{"stopping_time", make<StoppingTime>},
  Maker{"roundness", make<Roundness>},
  Maker{"width_at", make<WidthAt>},
  Maker{"fragments", make<Fragments>},
  Maker{"smallest_distance", make<SmallestDistance>},
  Maker{"symmetry_error", make<SymmetryError>},
  Maker{"kinetic_share", make<KineticShare>},
  Maker{"elastic_share", make<ElasticShare>},
  Maker{"plastic_share", make<PlasticShare>},
  Maker{"greatest_damage", make<GreatestDamage>},
  Maker{"overshoot", make<Overshoot>},
  Maker{"l1_error", make<ProfileError>},
  Maker{"l1_density_error", make<ProfileError>},
  Maker{"l1_velocity_error", make<ProfileError>},
  Maker{"shock_speed", make<ShockSpeed>},
  Maker{"density_deficit", make<DensityDeficit>},
  Maker{"fundamental_energy", make<WaveEnergy>},
  Maker{"wave_amplitude_loss", make<WaveAmplitudeLoss>},
  Maker{"oscillation_noise", make<OscillationNoise>},
  Maker{"kinetic_energy_kept", make<KineticEnergyKept>},
  Maker{"viscosity_heat_share", make<ViscosityHeatShare>},
  Maker{"viscosity_to_plastic_work", make<ViscosityToPlasticWork>},
  Maker{"patch_error", make<PatchError>},
  Maker{"fracture_strain", make<FractureStrain>},
  Maker{"crater_diameter", make<CraterDiameter>},
  Maker{"cloud_shape", make<CloudShape>},
};
} // namespace

std::unique_ptr<Observer> make_observer(const input::Observer &o, const input::Scene &scene)
{
  for (const Maker &maker : makers)
    if (o.quantity == maker.quantity)
      return maker.make(o, scene);
  throw InputError("observer \"" + o.name + "\": nothing measures the quantity \"" + o.quantity + "\"");
}

std::vector<std::string> observable_quantities()
{
  std::vector<std::string> names;
  for (const Maker &maker : makers)
    names.emplace_back(maker.quantity);
  return names;
}
} // namespace ogive::coupling
