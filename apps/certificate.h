// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/io/summary.h"

#include <string>
#include <vector>

namespace ogive::apps
{
/// One row a figure: interface, method, wave, side, wavelength, reflection.
std::string certificate_csv(const std::vector<io::Summary::Certificate> &);

/// Reflection over wavelength, both logarithmic, as SVG.
std::string certificate_svg(const std::string &title, const std::vector<io::Summary::Certificate> &);

/// A table a seam: waves down, wavelengths across.
void print_certificate(const io::Summary::Certificate &);
} // namespace ogive::apps
