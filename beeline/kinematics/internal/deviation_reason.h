#pragma once

#include <beeline/kinematics/task.h>
#include <beeline/reason.h>

namespace beeline::internal {

/// A reason about a deviation.
inline Reason deviation_reason(ReasonCode code, const Deviation& deviation) {
  return {
      code,
      {{ReasonField::distance, deviation.position}, {ReasonField::angle, deviation.orientation}}};
}

}  // namespace beeline::internal
