#pragma once

#include <vector>

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Proves that the joints of a trajectory that start outside a position limit, by at most an
/// amount, return monotonically: with e(t) the excess of a joint over that limit,
///
///     e(b) <= max(e(a), 0) + 2 position_slack  for all a < b.
///
/// Hence the excess never rises until the joint is within its limits, and it does not leave them
/// again. Both intervals, the one of a and the one of b, count the slack.
/// Before that, the joint has no limit on that side.
class RecoveryCheck {
 public:
  /// `recover`: the largest excess at the start, rad or m; 0 for no recovery.
  RecoveryCheck(const Arm& arm, const Trajectory& trajectory, double recover);

  /// Whether coordinate i is on its way back at sample k.
  bool is_returning(std::size_t k, int i) const { return k < joints_[joint(i)].smallest.size(); }
  /// Returns the limits that hold for coordinate i from sample k to the next.
  Limits limits(std::size_t k, int i) const;
  /// Returns by how much the excess of a coordinate that is returning rises after sample k, up to
  /// the next, rad or m.
  double rise(std::size_t k, int i) const;

 private:
  struct Returning {
    bool above = false;  ///< whether the joint starts above its upper limit
    /// The smallest excess up to each sample, for the samples before the joint is back.
    std::vector<double> smallest = {};
  };
  static std::size_t joint(int i) { return static_cast<std::size_t>(i); }

  const Arm& arm_;
  const Trajectory& trajectory_;
  std::vector<Returning> joints_;
};

}  // namespace beeline::internal
