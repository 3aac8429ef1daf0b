// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/log.h"
#include "core/io/summary.h"
#include "coupling/reflection.h"

#include <vector>

namespace ogive::coupling
{
/// A seam of a scene as it is measured: sizes, method, kernel, viscosities and
/// elements of the scene, but flat, of the elastic part of one material, at
/// small amplitude.
struct CertifiedSeam
{
  SeamSpec spec;
  double   wavelength = 0; ///< that the limit speaks of, m
};

/// Seams between particles and elements, those within bodies of method
/// automatic among them, and ties of elements, in the order of the scene.
std::vector<CertifiedSeam> seams_of(const input::Scene &);

/// Reflection of P and S waves at normal incidence, both ways. Left out: waves
/// that the incident side does not carry (below four of its sizes), S in one
/// dimension and in fluids. `wavelengths` in m.
io::Summary::Certificate certify(const CertifiedSeam &, const std::vector<double> &wavelengths);

/// Wavelengths of the whole certificate, m: 8, 12, 16, 24, 32, 48 and 64 of the
/// smaller of the two sizes, and the one that the limit speaks of.
std::vector<double> certificate_wavelengths(const CertifiedSeam &);

/// Before a run: each seam whose interface says "check" or "warn" at its own
/// wavelength. Notes the figures in the log. Above the limit InputError with
/// "check", a warning with "warn".
std::vector<io::Summary::Certificate> certify_before_run(const input::Scene &, Log &);
} // namespace ogive::coupling
