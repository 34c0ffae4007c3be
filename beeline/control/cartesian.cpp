#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include <beeline/control/cartesian.h>
#include <beeline/control/joint.h>
#include <beeline/error.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/path/tool_path.h>

namespace beeline {
namespace {

constexpr double near_singular = 1e-2;  // share of the largest singular value below which to damp
constexpr double calm = 0.1;            // radians: most of a joint's turn in a damped step
constexpr double far = 1;  // radians: most in any step; beyond, the Jacobian tells nothing
constexpr double largest_jump = 1.5;  // radians between neighbouring solutions of one branch

/// Of the joints that turn, radians.
double largest_turn(const Arm& arm, const Configuration& step) {
  double largest = 0;
  for (int k = 0; k < arm.dof(); ++k) {
    if (kind(arm.joint_of(k)) == JointKind::prismatic) continue;
    largest = std::max(largest, std::abs(step[k]));
  }
  return largest;
}

struct DampedStep {
  Configuration way;
  bool damped = false;  ///< the Jacobian is near a singularity
};

/// J^+ e with the singular values below a threshold damped, after Nakamura & Hanafusa (1986): exact
/// away from singularities, bounded at them.
DampedStep damped_step(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& error) {
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
  return {svd.matrixV() * share, sigma[sigma.size() - 1] < threshold};
}

constexpr double no_way = 1e-3;  // metres: on a shorter line what is left of the last one counts

/// The share of the line by which the tool went beyond its end.
double line_overshoot(std::span<const Configuration> samples, const Arm& arm, const Pose& goal) {
  const Vector3 from = forward_kinematics(arm, samples.front()).translation();
  const Vector3 way = goal.translation() - from;
  if (way.norm() < no_way) return 0;
  double largest = 0;
  for (const Configuration& q : samples) {
    const Vector3 beyond = forward_kinematics(arm, q).translation() - goal.translation();
    largest = std::max(largest, beyond.dot(way) / way.squaredNorm());
  }
  return largest;
}

double error_left(const Arm& arm, const Pose& goal, const Task& task, const Configuration& q) {
  return task_error(task, goal, forward_kinematics(arm, q)).lpNorm<Eigen::Infinity>();
}

/// One waypoint by eq. 1.6.
bool by_jacobian(const Arm& arm, const Pose& goal, const Task& task,
                 const CartesianOptions& options, ControlledMotion& motion) {
  const auto law_at = [&](const Configuration& q) {
    return damped_step(task_jacobian(arm, q, task),
                       task_error(task, goal, forward_kinematics(arm, q)));
  };
  const ControlLaw law{[&](const Configuration& q) { return error_left(arm, goal, task, q); },
                       [&](const Configuration& q) -> Configuration {
                         const DampedStep full = law_at(q);
                         const double turn = options.gain * largest_turn(arm, full.way);
                         const double most = full.damped ? calm : far;
                         return turn > most ? options.gain * most / turn * full.way
                                            : options.gain * full.way;
                       }};
  if (simulate(arm, law, options.simulation, motion)) return true;
  if (motion.status != MotionStatus::not_converged) return false;
  // Was it the gain, or is there nowhere to go? Only the pose itself can tell.
  const Configuration& q = motion.trajectory.positions.back();
  const InverseResult answer = inverse_kinematics(arm, goal, {.seed = q, .task = task});
  if (answer.status != InverseStatus::solved) {
    motion.status = motion_status(answer.status);
    motion.reason = answer.reason;
  } else if (law_at(q).damped && motion.steps < options.simulation.max_steps) {
    motion.status = MotionStatus::singular;
    motion.reason += "; it is at a singularity, where the Jacobian shows no way to the goal";
  }
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
    const Pose pose = interpolate(from, goal, double(i) / options.intermediate);
    const InverseResult answer = inverse_kinematics(
        arm, pose,
        {.seed = q, .task = task, .tolerance = std::min(1e-9, options.simulation.tolerance)});
    if (answer.status != InverseStatus::solved) {
      motion.status = motion_status(answer.status);
      motion.reason = where + answer.reason;
      return false;
    }
    const Configuration& next = answer.solutions.front();
    const double jump = largest_turn(arm, next - q);
    if (jump > largest_jump && options.intermediate > 1) {
      motion.status = MotionStatus::singular;
      motion.reason = where + "the nearest solution is another branch, " + angle(jump) +
                      " away; more intermediate poses may help";
      return false;
    }
    const ControlLaw law{
        [&](const Configuration& now) {
          return std::max((next - now).lpNorm<Eigen::Infinity>(), error_left(arm, pose, task, now));
        },
        [&](const Configuration& now) -> Configuration { return options.gain * (next - now); }};
    if (!simulate(arm, law, options.simulation, motion)) return false;
  }
  return true;
}

void check(const CartesianOptions& options) {
  check_options(options.simulation);
  if (!(options.gain > 0) || !std::isfinite(options.gain)) {
    throw Error("the gain must be above zero, not " + number(options.gain));
  }
  if (options.intermediate < 1 || options.intermediate > 100'000) {
    throw Error("intermediate is " + std::to_string(options.intermediate) +
                "; a line takes 1 to 100000 intermediate poses, its end counted");
  }
  if (options.task) check_task(*options.task);
}

}  // namespace

std::string name(CartesianMethod method) {
  constexpr const char* names[] = {"inverse-jacobian", "inverse-kinematics"};
  return names[static_cast<int>(method)];
}

ControlledMotion control_in_lines(const Arm& arm, const Configuration& start,
                                  std::span<const Pose> given_waypoints,
                                  const CartesianOptions& options) {
  check(options);
  const std::vector<Pose> waypoints = checked_waypoints(given_waypoints);
  const Task task = options.task.value_or(default_task(arm));
  ControlledMotion motion = begin_motion(arm, start);
  const auto go = options.method == CartesianMethod::inverse_jacobian ? by_jacobian : by_solutions;
  for (std::size_t w = 0; w < waypoints.size(); ++w) {
    const std::size_t first = motion.trajectory.size() - 1;
    const bool arrived = go(arm, waypoints[w], task, options, motion);
    const auto samples = std::span<const Configuration>(motion.trajectory.positions).subspan(first);
    motion.overshoot = std::max(motion.overshoot, line_overshoot(samples, arm, waypoints[w]));
    motion.error = error_left(arm, waypoints[w], task, motion.trajectory.positions.back());
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
