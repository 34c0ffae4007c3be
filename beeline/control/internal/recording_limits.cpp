#include <beeline/control/internal/recording_limits.h>
#include <beeline/error.h>
#include <beeline/trajectory/internal/interval_polynomial.h>

namespace beeline::internal {
namespace {

/// Describes how the motion from sample k to the next leaves the position limits; empty when it
/// does not.
std::string violation_after(const Arm& arm, const Trajectory& recording, std::size_t k) {
  Configuration lowest = recording.positions[k], highest = lowest;
  for (int i = 0; i < arm.dof(); ++i) {
    const Extremes range = extremes(interval_polynomial(recording, k, i));
    lowest[i] = range.smallest;
    highest[i] = range.largest;
  }
  for (const Configuration& extreme : {lowest, highest}) {
    const auto outside = limit_violations(arm, extreme);
    if (!outside.empty()) return outside.front() + ", by the velocities of the recording";
  }
  return {};
}

}  // namespace

std::string first_violation(const Arm& arm, const Trajectory& recording) {
  for (std::size_t k = 0; k < recording.size(); ++k) {
    const auto outside = limit_violations(arm, recording.positions[k]);
    if (!outside.empty()) return "at " + number(recording.times[k]) + " s " + outside.front();
    if (recording.velocities.empty() || k + 1 == recording.size()) continue;
    const std::string between = violation_after(arm, recording, k);
    if (!between.empty()) return "after " + number(recording.times[k]) + " s " + between;
  }
  return {};
}

}  // namespace beeline::internal
