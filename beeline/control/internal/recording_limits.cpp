#include <beeline/control/internal/recording_limits.h>
#include <beeline/error.h>
#include <beeline/trajectory/internal/interval_polynomial.h>

namespace beeline::internal {
namespace {

/// Returns how the motion from sample k to the next leaves the position limits; no reason if it
/// does not.
Reason violation_after(const Arm& arm, const Trajectory& recording, std::size_t k) {
  Configuration lowest = recording.positions[k], highest = lowest;
  for (int i = 0; i < arm.dof(); ++i) {
    const Extremes range = extremes(interval_polynomial(recording, k, i));
    lowest[i] = range.smallest;
    highest[i] = range.largest;
  }
  for (const Configuration& extreme : {lowest, highest}) {
    const auto outside = limit_violations(arm, extreme);
    if (!outside.empty()) return outside.front();
  }
  return {};
}

}  // namespace

Reason first_violation(const Arm& arm, const Trajectory& recording) {
  const auto at = [&](Reason reason, ReasonCode code, std::size_t k) {
    reason.code = code;
    return reason.set(ReasonField::time, recording.times[k]);
  };
  for (std::size_t k = 0; k < recording.size(); ++k) {
    const auto outside = limit_violations(arm, recording.positions[k]);
    if (!outside.empty()) return at(outside.front(), ReasonCode::recording_outside_limits, k);
    if (recording.velocities.empty() || k + 1 == recording.size()) continue;
    const Reason between = violation_after(arm, recording, k);
    if (between) return at(between, ReasonCode::recording_outside_limits_between, k);
  }
  return {};
}

}  // namespace beeline::internal
