#pragma once

#include <beeline/model/joint.h>
#include <beeline/reason.h>

namespace beeline::internal {

/// Adds the joint to a reason: its name, and the unit of its values.
inline Reason& set_joint(const Joint& joint, Reason& reason) {
  return reason.set(ReasonField::joint, joint.name).set(ReasonField::unit, unit(joint));
}

/// A reason about a joint.
inline Reason joint_reason(ReasonCode code, const Joint& joint) {
  Reason reason{code};
  set_joint(joint, reason);
  return reason;
}

}  // namespace beeline::internal
