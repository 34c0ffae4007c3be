#pragma once

#include <utility>

#include <beeline/certificate/verify.h>

namespace beeline::internal {

/// Sets the fault of a verification, at sample k or between it and the next, with its reason.
inline void set_fault(const Trajectory& trajectory, Fault fault, std::size_t k, Reason reason,
                      Verification& result) {
  result.fault = fault;
  result.sample = k;
  result.time = trajectory.times[k];
  result.reason = std::move(reason);
  result.reason.set(ReasonField::sample, k + 1).set(ReasonField::time, result.time);
}

}  // namespace beeline::internal
