#pragma once

#include <optional>

#include <beeline/control/replay.h>
#include <beeline/internal/budget_meter.h>

namespace beeline::internal {

/// A replay, and what may help if it fails.
struct ReplayAttempt {
  Replay replay;
  /// Whether another rate, ramp or speed may help.
  bool curable = false;
  /// A speed that keeps the limit that this speed exceeds, if this one is too fast. Other limits
  /// may still be exceeded.
  std::optional<double> speed = std::nullopt;
};

/// Replays a recording, whose columns are in the arm's order, slowed down by at most `max_slowdown`
/// beyond whole periods. Does not set the limits of a result that is reached.
ReplayAttempt attempt_replay(const Arm& arm, const Trajectory& recording,
                             const ReplayOptions& options, double max_slowdown,
                             BudgetMeter& budget);

/// Tries other speeds, rates and ramps for an attempt that they may help. Adds to its reason the
/// ones that keep the limits, or that none does.
void add_advice(const Arm& arm, const Trajectory& recording, const ReplayOptions& options,
                const ReplayAttempt& failed, BudgetMeter& budget, Reason& reason);

/// Returns the samples per second of a replay: 0 for the recorded samples.
double replay_rate(const ReplayOptions& options);

}  // namespace beeline::internal
