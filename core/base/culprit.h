// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/base/tensor.h"

#include <cstdint>
#include <limits>

namespace ogive
{
/// One element, particle or contact, named so that a user finds it.
struct Culprit
{
  const char  *entity = "";         ///< "element", "particle", "contact"
  int          body   = -1;         ///< index into the scene's bodies, -1 for none
  std::int64_t id     = -1;         ///< global id within the run
  Vec3         where  = Vec3::Zero();
  const char  *why    = "";
};

/// A bound on the step and who set it.
struct StepLimit
{
  double  dt = std::numeric_limits<double>::infinity();
  Culprit culprit;

  void tighten(const StepLimit &other)
  {
    if (other.dt < dt)
      *this = other;
  }
};

/// How a step ended. A step that did not end well is restored and retried.
struct StepStatus
{
  bool    ok = true;
  Culprit culprit;
};
} // namespace ogive
