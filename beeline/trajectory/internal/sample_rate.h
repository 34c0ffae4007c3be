#pragma once

#include <string>

namespace beeline::internal {

/// Throws Error for a rate below the lowest or not finite. `zero` is what a rate of 0 means, where
/// it is allowed: "the recorded samples".
void check_rate(double rate, const std::string& zero = "");

}  // namespace beeline::internal
