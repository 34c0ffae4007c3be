#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/math/revolution.h>
#include <beeline/trajectory/internal/continuous_joint.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {
namespace {

Trajectory from_zero(const Arm& arm, const Trajectory& given, const char* which) {
  Trajectory trajectory = matched_to(arm, given);
  if (trajectory.size() == 0) throw Error(std::string(which) + " trajectory has no samples");
  const double begin = trajectory.times.front();
  for (double& t : trajectory.times) t -= begin;
  return trajectory;
}

/// Turns the continuous joints of b by whole revolutions, so that they begin near the joints of a.
void start_near(const Arm& arm, const Trajectory& a, Trajectory& b) {
  for (int k = 0; k < arm.dof(); ++k) {
    if (!internal::is_continuous(arm, k)) continue;
    const double offset = b.positions.front()[k] - a.positions.front()[k];
    const double turns = std::round(offset / internal::revolution);
    if (turns == 0) continue;
    for (Configuration& q : b.positions) q[k] -= turns * internal::revolution;
  }
}

/// The sample times of both, up to the end of the shorter one.
std::vector<double> common_times(const Trajectory& a, const Trajectory& b) {
  const double end = std::min(a.times.back(), b.times.back());
  std::vector<double> times;
  std::merge(a.times.begin(), a.times.end(), b.times.begin(), b.times.end(),
             std::back_inserter(times));
  times.erase(std::unique(times.begin(), times.end()), times.end());
  times.erase(std::upper_bound(times.begin(), times.end(), end), times.end());
  return times;
}

}  // namespace

TrajectoryDifference difference(const Arm& arm, const Trajectory& given_a,
                                const Trajectory& given_b) {
  const Trajectory a = from_zero(arm, given_a, "the first");
  Trajectory b = from_zero(arm, given_b, "the second");
  start_near(arm, a, b);
  TrajectoryDifference result;
  result.joints.resize(static_cast<std::size_t>(arm.dof()));
  result.longer = b.times.back() - a.times.back();
  const std::vector<double> times = common_times(a, b);
  result.overlap = times.back();
  Configuration previous;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double t = times[k];
    const Configuration q_a = sample(a, t).position, q_b = sample(b, t).position;
    const Configuration offset = q_b - q_a;
    for (int i = 0; i < arm.dof(); ++i) {
      JointDifference& joint = result.joints[i];
      if (std::abs(offset[i]) > joint.largest) {
        joint.largest = std::abs(offset[i]);
        joint.time = t;
      }
      if (k == 0) continue;
      // The integral of the square of a linear function.
      const double u = previous[i], v = offset[i];
      joint.rms += (t - times[k - 1]) * (u * u + u * v + v * v) / 3;
    }
    const Twist tool = pose_difference(forward_kinematics(arm, q_b), forward_kinematics(arm, q_a));
    const double position = tool.head<3>().norm(), orientation = tool.tail<3>().norm();
    if (position > result.largest_position) {
      result.largest_position = position;
      result.position_time = t;
    }
    if (orientation > result.largest_orientation) {
      result.largest_orientation = orientation;
      result.orientation_time = t;
    }
    previous = offset;
  }
  if (!std::isfinite(result.longer) || !std::isfinite(result.overlap)) {
    throw Error("the times of the trajectories are too large to be compared");
  }
  for (JointDifference& joint : result.joints) {
    if (!std::isfinite(joint.rms)) {
      throw Error("the positions of the trajectories are too large to be compared");
    }
    joint.rms = result.overlap > 0 ? std::sqrt(joint.rms / result.overlap) : joint.largest;
  }
  return result;
}

}  // namespace beeline
