#pragma once

#include <vector>

#include <beeline/doctor/internal/reconciliation.h>

namespace beeline::internal {

/// Explains B by A from the joints' screw axes in space: mount, tool, offsets, signs, and where
/// these do not suffice the dimensions between neighbouring axes. Where mount or tool is a rotation
/// about the first or last axis, another explanation has an offset of that joint in its place.
/// Empty when the arms differ in the number or the kinds of their joints.
std::vector<Reconciliation> screw_explanations(const Arm& a, const Arm& b, double tolerance);

}  // namespace beeline::internal
