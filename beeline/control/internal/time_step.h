#pragma once

#include <cmath>

#include <beeline/error.h>

namespace beeline::internal {

/// Throws Error unless the time step of a controller, seconds, is above zero and finite.
inline void check_time_step(double time_step) {
  if (time_step > 0 && std::isfinite(time_step)) return;
  throw Error("the time step must be above zero, not " + number(time_step) + " s");
}

}  // namespace beeline::internal
