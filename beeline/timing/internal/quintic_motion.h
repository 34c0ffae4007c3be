#pragma once

#include <beeline/path/internal/joint_path_derivatives.h>
#include <beeline/timing/internal/duration_problem.h>
#include <beeline/timing/point_to_point.h>
#include <beeline/timing/time_scaling.h>

namespace beeline::internal {

/// The motion q(tau) along a path by the rest-to-rest quintic, within the limits.
class QuinticMotion {
 public:
  /// `quintic` is scalar_profile(ScalarForm::quintic, path, limits). Keeps references to path and
  /// limits.
  QuinticMotion(const JointPath& path, const PathLimits& limits, const TimeScaling& quintic);

  const JointPath& path() const { return path_; }
  const PathLimits& limits() const { return limits_; }
  double duration() const { return times_.back(); }
  /// The times of the path's grid points.
  const std::vector<double>& times() const { return times_; }

  /// s(tau) and its derivatives; exactly at rest at both ends.
  JointState along(double tau) const;

  /// The joints' motion at tau, divided by the fraction of the limits of acceleration and jerk that
  /// may be used there. The reference is valid until the next call. Consecutive calls are fast if
  /// their times are near each other.
  const MotionSample& at(double tau);

  /// The jump of d3q/ds3 at each grid point of the path: the jump of jerk at the speed in the
  /// middle of the motion, as a fraction of the jerk limit, the largest of all joints.
  std::vector<double> jerk_jumps() const;

 private:
  const JointPath& path_;
  const PathLimits& limits_;
  PathDerivatives derivatives_;
  std::vector<double> times_;
  MotionSample sample_;
  std::size_t step_ = 0;  ///< of the path, at the last time
};

}  // namespace beeline::internal
