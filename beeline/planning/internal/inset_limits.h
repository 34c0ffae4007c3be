#pragma once

#include <optional>

#include <beeline/model/arm.h>

namespace beeline::internal {

/// Returns the arm with limits moved inwards by `inset`, except those that `start` would then
/// violate.
Arm with_inset_limits(const Arm& arm, const std::optional<Configuration>& start, double inset);

}  // namespace beeline::internal
