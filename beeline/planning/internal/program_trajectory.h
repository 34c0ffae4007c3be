#pragma once

#include <string>
#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/timing/retime.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// The trajectory of a program, appended motion by motion from rest to rest.
class ProgramTrajectory {
 public:
  /// Begins at rest at q, with the columns of the interpolation.
  void begin(const Arm& arm, const Configuration& q, Interpolation interpolation, double rate);

  const std::vector<Configuration>& positions() const { return trajectory_.positions; }
  std::size_t last() const { return trajectory_.size() - 1; }

  /// Marks the last sample as a rest. With linear joints and no rate, the joints then rest before
  /// the next motion for at least its first interval and the last interval before. Their velocity
  /// thus does not change within a shorter interval than each motion was planned for.
  void stop() { stopped_ = true; }

  /// Appends sample k of a motion that continues this one, at its time difference to sample k - 1.
  void append(const Trajectory& motion, std::size_t k);
  /// Appends all of its samples but the first.
  void append(const Trajectory& motion);

  /// Appends a motion to `to` along a straight line in joint space, or returns why there is none.
  Reason joint_move(const Arm& arm, const Configuration& to, const RetimeOptions& options);

  /// Appends the section that leads back within the position limits, see recovery_section(), if the
  /// last sample is outside, or returns why there is none.
  Reason recover(const Arm& arm, const RetimeOptions& options, BudgetMeter& budget);

  /// Appends the last sample after a pause of this many seconds; with a rate after each period, up
  /// to whole periods. Linear joints without a rate rest for at least the interval before. Returns
  /// a reason where these are too many samples.
  Reason dwell(double seconds);

  /// The trajectory: with a rate, sample k is at k / rate. Its times are whole nanoseconds.
  Trajectory finished() const;

 private:
  bool is_linear() const { return rate_ == 0 && trajectory_.velocities.empty(); }
  void rest_before(double interval);

  Trajectory trajectory_;
  double rate_ = 0;
  bool stopped_ = false;
};

}  // namespace beeline::internal
