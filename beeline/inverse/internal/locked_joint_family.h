#pragma once

#include <beeline/inverse/internal/analytic_family.h>

namespace beeline::internal {

/// Arms of seven revolute joints, of which six remain with a closed form when one is locked. Only
/// for all solutions, and for InverseMethod::closed_form: those on a grid of values of that joint.
extern const AnalyticFamily locked_joint_family;

}  // namespace beeline::internal
