#pragma once

#include <ostream>

#include <beeline/planning/branch.h>
#include <beeline/trajectory/limit_usage.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Prints `reached in 0.42 s, 43 samples`, or the status of a motion that has failed with its
/// reason.
template <class Motion>
std::ostream& print_motion(std::ostream& out, const Motion& motion) {
  out << motion.status;
  if (motion.reason) return out << ": " << motion.reason;
  const std::vector<double>& times = motion.trajectory.times;
  if (times.empty()) return out;
  return out << " in " << number(times.back() - times.front()) << " s, " << times.size()
             << " samples";
}

/// Prints `, limits of velocity and acceleration assumed`, or nothing if none is.
std::ostream& print_assumed(std::ostream& out, const LimitUsage& limits);

}  // namespace beeline::internal
