#pragma once

#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/model/arm.h>

namespace beeline::testing {

/// Smallest distance to a position limit, over the range between the limits.
inline double relative_margin(const Arm& arm, const Configuration& q) {
  const internal::Bounds bounds = internal::bounds_of(arm);
  return (q - bounds.lower)
      .cwiseMin(bounds.upper - q)
      .cwiseQuotient(bounds.upper - bounds.lower)
      .minCoeff();
}

}  // namespace beeline::testing
