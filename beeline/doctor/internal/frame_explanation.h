#pragma once

#include <vector>

#include <beeline/doctor/internal/reconciliation.h>

namespace beeline::internal {

/// Explains B by A joint by joint, from the frames of their links: origins, orientations, axes,
/// offsets and signs. One explanation, or none where the numbers of joints differ.
std::vector<Reconciliation> frame_explanations(const Arm& a, const Arm& b, double tolerance);

}  // namespace beeline::internal
