// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace ogive
{
/// One step of the leapfrog: v_{n+1/2} = v_{n-1/2} + kick f_n/m,
/// x_{n+1} = x_n + drift v_{n+1/2}. With steps of changing length
/// kick = (dt_{n-1} + dt_n)/2, and dt_n/2 in the first step, where v is v(0).
struct TimeStep
{
  double time  = 0; ///< t_n, s
  double kick  = 0; ///< s
  double drift = 0; ///< dt_n, s
};
} // namespace ogive
