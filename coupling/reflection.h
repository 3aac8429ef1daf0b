// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/input/scene.h"

#include <array>
#include <string>
#include <vector>

/// What of a wave a seam throws back, measured on a strip of its own: the same
/// packet is sent once through the seam and once through one method alone, on
/// the same lattice with the same steps, and the difference on the side that it
/// came from is the echo.
namespace ogive::coupling
{
/// What stands on one side of a seam.
struct SeamSide
{
  std::string   body;                          ///< for messages
  input::Method method = input::Method::fem;   ///< fem or sph
  double        size   = 0;                    ///< particle spacing or element edge, m
  std::string   element;                       ///< formulation; empty: FemOptions::element
};

/// A flat seam: side 0 is the particles, or the slave of two meshes, side 1 the
/// mesh, or the master. With method "blended" the particles reach into the mesh
/// as far as they must.
struct SeamSpec
{
  std::array<SeamSide, 2> side;
  input::Interface        join;     ///< method and its numbers; its bodies do not matter
  materials::Parameters   material; ///< of both sides; only density and elastic constants are used
  input::SphOptions       sph;
  input::FemOptions       fem;
  bool                    line = false; ///< uniaxial strain in one dimension, else a strip in plane strain
};

struct SeamWave
{
  bool   shear = false; ///< S instead of P
  int    from  = 0;     ///< side that it comes from
  double angle = 0;     ///< between its direction and the seam's normal, rad
};

/// Share of the amplitude that comes back at normal incidence: the Fourier sum
/// of m v e^{-ikx}, k = 2 pi/wavelength (m), over the incident side, of the
/// difference between the run with the seam and the run without, over that of
/// the packet in the run without after the same time; m and v mass and velocity
/// of particles or nodes. Wave number and amplitudes are those of the incident
/// side, so that what the side itself takes from the wave (viscosity) or
/// disperses drops out. The packet is v = sin(k s) exp(-s^2/2 sigma^2), sigma =
/// 3/8 of the wavelength: waves of half the length have .06 of its amplitude.
/// (One pulse for all wavelengths would do for a linear strip. But viscosities
/// that act in compression alone turn a strong echo of short waves into a weak
/// one of long waves.)
/// InputError if the seam cannot be built.
double reflection(const SeamSpec &, const SeamWave &, double wavelength);

/// The same at an angle, for one wavelength: a packet of relative width 1/5 in
/// the wave number across the seam, between two mirrors that stand half a
/// wavelength along the seam apart, so that it is the sum of two plane waves at
/// +- angle. The root of the kinetic energy that comes back, of P and S waves
/// together, over that of the packet. The distance of the mirrors is rounded to
/// whole elements, the angle kept. The elements have no bulk viscosity here: it
/// takes much from a P packet and little from the S waves that come back of it.
double oblique_reflection(const SeamSpec &, const SeamWave &, double wavelength);

/// Shortest wavelength that both sides carry, m: four of the larger size.
double shortest_wavelength(const SeamSpec &);
} // namespace ogive::coupling
