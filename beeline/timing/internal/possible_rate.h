#pragma once

#include <functional>

#include <beeline/timing/retime.h>

namespace beeline::internal {

/// Adds the field `possible_rate` to a reason why a motion is not possible at options.rate: a rate
/// of which `possible` says that the whole motion is. `duration` is the shortest duration of the
/// whole motion, s; 0: there is none. Does nothing for other reasons, and if no rate is found.
void set_possible_rate(const RetimeOptions& options, double duration,
                       const std::function<bool(double rate)>& possible, Reason& reason);

}  // namespace beeline::internal
