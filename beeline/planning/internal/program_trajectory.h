#pragma once

#include <string>
#include <vector>

#include <beeline/timing/retime.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// The trajectory of a program, appended motion by motion from rest to rest.
class ProgramTrajectory {
 public:
  /// Begins at rest at q, with the columns of the interpolation.
  void begin(const Arm& arm, const Configuration& q, Interpolation interpolation);

  const std::vector<Configuration>& positions() const { return trajectory_.positions; }
  std::size_t last() const { return trajectory_.size() - 1; }

  /// Appends sample k of a motion that continues this one, in the time from its sample before.
  void append(const Trajectory& motion, std::size_t k);

  /// Appends a motion to `to` along a straight line in joint space; returns the reason where there
  /// is none, otherwise an empty text.
  std::string joint_move(const Arm& arm, const Configuration& to, const RetimeOptions& options);

  /// Appends the last sample after a pause of this many seconds; with a rate after each period, up
  /// to whole periods.
  void dwell(double seconds, double rate);

  /// The trajectory: with a rate, sample k is at k / rate. Its times are whole nanoseconds.
  Trajectory finished(double rate) const;

 private:
  Trajectory trajectory_;
};

/// The samples from `first` to `last`, with their times.
Trajectory samples_between(const Trajectory& trajectory, std::size_t first, std::size_t last);

}  // namespace beeline::internal
