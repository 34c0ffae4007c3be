#pragma once

#include <beeline/model/internal/chain.h>

namespace beeline::internal {

/// Whether a joint follows another one.
inline bool has_mimic_joints(const Arm& arm) { return !chain_angles_of(arm).in_order; }

}  // namespace beeline::internal
