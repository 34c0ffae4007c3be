#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include <beeline/control/cartesian.h>
#include <beeline/control/joint.h>
#include <beeline/error.h>
#include <beeline/inverse/solve.h>
#include <beeline/kinematics/forward.h>

namespace beeline {
namespace {

constexpr double near_singular =
    1e-2;                             // singular values below this share of the largest are damped
constexpr double largest_jump = 1.5;  // radians between neighbouring solutions of one branch

/// J^+ e with the singular values below a threshold damped, after Nakamura & Hanafusa (1986): exact
/// away from singularities, bounded at them.
Configuration damped_step(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& error) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& sigma = svd.singularValues();
  const double threshold = near_singular * sigma[0];
  Eigen::VectorXd share = svd.matrixU().transpose() * error;
  for (Eigen::Index i = 0; i < sigma.size(); ++i) {
    const double lack = std::max(0.0, 1 - sigma[i] / threshold);
    const double damping = threshold * lack;
    const double denominator = sigma[i] * sigma[i] + damping * damping;
    share[i] = denominator > 0 ? share[i] * sigma[i] / denominator : 0;
  }
  return svd.matrixV() * share;
}

/// The share of the line by which the tool went beyond its end.
double line_overshoot(std::span<const Configuration> samples, const Arm& arm, const Pose& goal) {
  const Vector3 from = forward_kinematics(arm, samples.front()).translation();
  const Vector3 way = goal.translation() - from;
  if (way.norm() < 1e-9) return 0;
  double largest = 0;
  for (const Configuration& q : samples) {
    const Vector3 beyond = forward_kinematics(arm, q).translation() - goal.translation();
    largest = std::max(largest, beyond.dot(way) / way.squaredNorm());
  }
  return largest;
}

/// One waypoint by eq. 1.6.
bool by_jacobian(const Arm& arm, const Pose& goal, const Task& task,
                 const CartesianOptions& options, ControlledMotion& motion) {
  const auto error = [&](const Configuration& q) {
    return task_error(task, goal, forward_kinematics(arm, q));
  };
  const ControlLaw law{[&](const Configuration& q) { return error(q).lpNorm<Eigen::Infinity>(); },
                       [&](const Configuration& q) -> Configuration {
                         return options.gain * damped_step(task_jacobian(arm, q, task), error(q));
                       }};
  if (simulate(arm, law, options.simulation, motion)) return true;
  if (motion.status != MotionStatus::not_converged || options.gain >= 1) return false;
  // Was it the gain, or is there nowhere to go? Only the pose itself can tell.
  const InverseResult answer =
      inverse_kinematics(arm, goal, {.seed = motion.trajectory.positions.back(), .task = task});
  if (answer.status == InverseStatus::solved) return false;
  motion.status = answer.status == InverseStatus::outside_limits ? MotionStatus::outside_limits
                                                                 : MotionStatus::unreachable;
  motion.reason = answer.reason;
  return false;
}

/// One waypoint by inverse kinematics at poses on the way and eq. 1.3 between them.
bool by_solutions(const Arm& arm, const Pose& goal, const Task& task,
                  const CartesianOptions& options, ControlledMotion& motion) {
  const Pose from = forward_kinematics(arm, motion.trajectory.positions.back());
  for (int i = 1; i <= options.intermediate; ++i) {
    const Configuration q = motion.trajectory.positions.back();
    const std::string where = "at intermediate pose " + std::to_string(i) + " of " +
                              std::to_string(options.intermediate) + ": ";
    const InverseResult answer = inverse_kinematics(
        arm, interpolate(from, goal, double(i) / options.intermediate), {.seed = q, .task = task});
    if (answer.status != InverseStatus::solved) {
      motion.status = answer.status == InverseStatus::outside_limits ? MotionStatus::outside_limits
                                                                     : MotionStatus::unreachable;
      motion.reason = where + answer.reason;
      return false;
    }
    const Configuration& next = answer.solutions.front();
    const double jump = (next - q).lpNorm<Eigen::Infinity>();
    if (jump > largest_jump && options.intermediate > 1) {
      motion.status = MotionStatus::singular;
      motion.reason = where + "the nearest solution is another branch, " + angle(jump) +
                      " away; more intermediate poses may help";
      return false;
    }
    const ControlLaw law{
        [&next](const Configuration& now) { return (next - now).lpNorm<Eigen::Infinity>(); },
        [&](const Configuration& now) -> Configuration { return options.gain * (next - now); }};
    if (!simulate(arm, law, options.simulation, motion)) return false;
  }
  return true;
}

void check(std::span<const Pose> waypoints, const CartesianOptions& options) {
  check_options(options.simulation);
  if (waypoints.empty()) throw Error("a line needs at least one waypoint");
  if (!(options.gain > 0) || !std::isfinite(options.gain)) {
    throw Error("the gain must be above zero, not " + number(options.gain));
  }
  if (options.intermediate < 1) throw Error("a line needs at least one intermediate pose, its end");
  for (const Pose& waypoint : waypoints) {
    if (!waypoint.matrix().allFinite()) throw Error("a waypoint is not finite");
  }
}

}  // namespace

std::string name(CartesianMethod method) {
  constexpr const char* names[] = {"inverse-jacobian", "inverse-kinematics"};
  return names[static_cast<int>(method)];
}

ControlledMotion control_in_lines(const Arm& arm, const Configuration& start,
                                  std::span<const Pose> waypoints,
                                  const CartesianOptions& options) {
  check(waypoints, options);
  const Task task = options.task.value_or(default_task(arm));
  ControlledMotion motion = begin_motion(arm, start);
  const auto go = options.method == CartesianMethod::inverse_jacobian ? by_jacobian : by_solutions;
  for (std::size_t w = 0; w < waypoints.size(); ++w) {
    const std::size_t first = motion.trajectory.size() - 1;
    const bool arrived = go(arm, waypoints[w], task, options, motion);
    const auto samples = std::span<const Configuration>(motion.trajectory.positions).subspan(first);
    motion.overshoot = std::max(motion.overshoot, line_overshoot(samples, arm, waypoints[w]));
    if (!arrived) {
      motion.reason = "line " + std::to_string(w + 1) + " of " + std::to_string(waypoints.size()) +
                      ": " + motion.reason;
      return motion;
    }
    motion.arrivals.push_back(motion.trajectory.size() - 1);
  }
  return motion;
}

}  // namespace beeline
