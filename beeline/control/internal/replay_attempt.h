#pragma once

#include <optional>

#include <beeline/control/replay.h>
#include <beeline/internal/budget_meter.h>

namespace beeline::internal {

/// A replay, and what may help where there is none.
struct ReplayAttempt {
  Replay replay;
  /// Another rate, ramp or speed may help.
  bool curable = false;
  /// A speed that keeps the limit which this one exceeds, if it is too fast; others may be exceeded
  /// still.
  std::optional<double> speed = std::nullopt;
};

/// Replays a recording, whose columns are in the arm's order, slowed down by at most `max_slowdown`
/// beyond whole periods. The limits of the result are not set where it is reached.
ReplayAttempt attempt_replay(const Arm& arm, const Trajectory& recording,
                             const ReplayOptions& options, double max_slowdown,
                             BudgetMeter& budget);

/// Tries other speeds, rates and ramps for a curable attempt, and adds to its reason those that
/// keep the limits, or that none does.
void add_advice(const Arm& arm, const Trajectory& recording, const ReplayOptions& options,
                const ReplayAttempt& failed, BudgetMeter& budget, Reason& reason);

/// Samples per second of a replay: 0 for the recorded samples.
double replay_rate(const ReplayOptions& options);

}  // namespace beeline::internal
