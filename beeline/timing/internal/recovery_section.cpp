#include <utility>

#include <beeline/path/joint_path.h>
#include <beeline/timing/internal/recovery_section.h>
#include <beeline/timing/internal/retimed_paths.h>
#include <beeline/trajectory/internal/append.h>
#include <beeline/trajectory/internal/recovery.h>

namespace beeline::internal {
namespace {

/// The arm with position limits that contain q.
Arm with_limits_around(const Arm& arm, const Configuration& q) {
  std::map<std::string, LimitOverrides> wider;
  for (const int k : outside_limits(arm, q)) {
    LimitOverrides& limits = wider[arm.joint_of(k).name];
    (q[k] > arm.limits(k).upper ? limits.upper : limits.lower) = q[k];
  }
  return with_limits(arm, wider);
}

}  // namespace

Retimed recovery_section(const Arm& arm, const Configuration& start, const RetimeOptions& options,
                         BudgetMeter& budget) {
  RetimeOptions straight = options;
  straight.duration.reset();
  straight.joint_blend.reset();
  const std::vector<Configuration> ends{start, nearest_within_limits(arm, start)};
  return retimed_paths(with_limits_around(arm, start), {joint_spline(ends, chord_length(ends))},
                       straight, budget);
}

SamplesBehind samples_behind(const Trajectory& recovery, int max_samples) {
  const int left = max_samples - static_cast<int>(recovery.size());
  if (left > 0) return {left + 1};
  Reason reason{ReasonCode::too_many_samples, {{ReasonField::max_samples, std::size_t{0}}}};
  set_max_samples(max_samples, reason);
  return {0, std::move(reason)};
}

void set_max_samples(int max_samples, Reason& reason) {
  for (const ReasonField field : {ReasonField::max_samples, ReasonField::more_samples}) {
    if (reason.has(field)) reason.set(field, static_cast<std::size_t>(max_samples));
  }
}

void put_before(const Trajectory& section, Trajectory& motion) {
  Trajectory whole = section;
  append(whole, motion);
  round_times(whole);
  motion = std::move(whole);
}

}  // namespace beeline::internal
