// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "fem/elements/b_bar.h"
#include "fem/elements/spectral.h"

/// The elements that IntegratedGroup is built for, in its two sources.
#define OGIVE_INSTANTIATE_INTEGRATED(what, group) \
  what group<Full<2, false>>;                     \
  what group<Full<2, true>>;                      \
  what group<Full<3, false>>;                     \
  what group<BBar<2, false>>;                     \
  what group<BBar<2, true>>;                      \
  what group<BBar<3, false>>;                     \
  what group<Spectral<1, 2>>;                     \
  what group<Spectral<1, 3>>;                     \
  what group<Spectral<1, 4>>;                     \
  what group<Spectral<2, 2>>;                     \
  what group<Spectral<2, 3>>;                     \
  what group<Spectral<2, 4>>;                     \
  what group<Spectral<3, 2>>;                     \
  what group<Spectral<3, 3>>;                     \
  what group<Spectral<3, 4>>;
