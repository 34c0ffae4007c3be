#pragma once

#include <beeline/path/internal/joint_path_derivatives.h>
#include <beeline/timing/internal/duration_problem.h>
#include <beeline/timing/s_curve.h>
#include <beeline/timing/time_scaling.h>

namespace beeline {

/// A path that is gone by the quintic scaling within its limits, as a motion by its own time.
class QuinticMotion {
 public:
  /// `quintic`: scalar_profile(ScalarForm::quintic, path, limits). Path and limits must live on.
  QuinticMotion(const JointPath& path, const PathLimits& limits, const TimeScaling& quintic);

  const JointPath& path() const { return path_; }
  const PathLimits& limits() const { return limits_; }
  double duration() const { return times_.back(); }
  /// When the path's grid points are passed.
  const std::vector<double>& times() const { return times_; }

  /// s and its derivatives; exactly at rest at both ends.
  JointState along(double t) const;

  /// The joints at a time, until the next call; quick where times are near each other.
  const MotionSample& at(double t);

  /// By how much the jerks jump at each grid point of the path, if it is passed as fast as the
  /// middle is: the most of a joint, as a share of its limit.
  std::vector<double> jumps() const;

 private:
  const JointPath& path_;
  const PathLimits& limits_;
  PathRates rates_;
  std::vector<double> times_;
  MotionSample moment_;
  std::size_t step_ = 0;  ///< of the path, at the last time
};

}  // namespace beeline
