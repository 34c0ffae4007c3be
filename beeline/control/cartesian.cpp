#include <algorithm>
#include <cmath>

#include <beeline/control/cartesian.h>
#include <beeline/control/internal/simulate.h>
#include <beeline/control/joint.h>
#include <beeline/error.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/internal/enum_names.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/tool_plane.h>
#include <beeline/math/six_row_svd.h>
#include <beeline/path/internal/checked_poses.h>
#include <beeline/path/tool_path.h>

namespace beeline {
using namespace internal;
namespace {

constexpr double damped_below = 1e-2;  // fraction of the largest singular value
// rad, max rotation of any joint; J changes fast next to a singularity.
constexpr double max_damped_step = 0.1;
constexpr double max_step = 1;    // rad, max rotation of any joint: range of the linear model
constexpr double max_jump = 1.5;  // rad; solutions farther apart are on different branches

/// Returns the largest rotation of a revolute or helical joint, radians.
double largest_rotation(const Arm& arm, const Configuration& step) {
  double largest = 0;
  for (int k = 0; k < arm.dof(); ++k) {
    if (kind(arm.joint_of(k)) == JointKind::prismatic) continue;
    largest = std::max(largest, std::abs(step[k]));
  }
  return largest;
}

struct DampedStep {
  Configuration step;
  bool damped = false;  ///< the Jacobian is near a singularity
};

/// Returns J⁺ e with singular values below a threshold damped (Nakamura & Hanafusa 1986): exact
/// away from singularities, bounded at them. Unlike math/damped_least_squares.h, which damps all
/// directions alike, it leaves eq. 1.6 unchanged for regular configurations.
DampedStep damped_step(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& error) {
  const SixRowSvd svd = six_row_svd(jacobian);
  const auto& sigma = svd.singular_values;
  const double threshold = damped_below * sigma[0];
  const Eigen::Index count = std::min(jacobian.rows(), jacobian.cols());
  DampedStep result{Configuration::Zero(jacobian.cols()), sigma[count - 1] < threshold};
  if (threshold == 0) return result;
  for (Eigen::Index i = 0; i < count; ++i) {
    // Relative to the threshold: sigma^2 may overflow.
    const double relative = sigma[i] / threshold;
    const double damping = std::max(0.0, 1 - relative);
    const double component = svd.left.col(i).head(error.size()).dot(error);
    result.step += component / (relative * relative + damping * damping) / threshold *
                   (svd.scaled_right.col(i) / threshold);
  }
  return result;
}

// Metres. On a shorter line the overshoot is mostly the remaining error of the previous line.
constexpr double min_line = 1e-3;

/// Returns the largest distance of the tool beyond the end of the line, relative to its length.
double line_overshoot(std::span<const Configuration> samples, const Arm& arm, const Pose& goal) {
  const Vector3 from = forward_kinematics(arm, samples.front()).translation();
  const Vector3 line = goal.translation() - from;
  if (line.norm() < min_line) return 0;
  double largest = 0;
  for (const Configuration& q : samples) {
    const Vector3 beyond = forward_kinematics(arm, q).translation() - goal.translation();
    largest = std::max(largest, beyond.dot(line) / line.squaredNorm());
  }
  return largest;
}

double remaining_error(const Arm& arm, const Pose& goal, const Task& task, const Configuration& q) {
  return task_error(task, goal, forward_kinematics(arm, q)).lpNorm<Eigen::Infinity>();
}

/// Controls the motion to one waypoint by eq. 1.6.
bool control_by_jacobian(const Arm& arm, const Pose& goal, const Task& task,
                         const CartesianOptions& options, ControlledMotion& motion) {
  const auto step_at = [&](const Configuration& q) {
    return damped_step(task_jacobian(arm, q, task),
                       task_error(task, goal, forward_kinematics(arm, q)));
  };
  const ControlLaw law{[&](const Configuration& q) { return remaining_error(arm, goal, task, q); },
                       [&](const Configuration& q) -> Configuration {
                         const DampedStep full = step_at(q);
                         const double rotation = options.gain * largest_rotation(arm, full.step);
                         const double allowed = full.damped ? max_damped_step : max_step;
                         return rotation > allowed ? options.gain * allowed / rotation * full.step
                                                   : options.gain * full.step;
                       }};
  if (simulate(arm, law, options.simulation, motion)) return true;
  if (motion.status != MotionStatus::not_converged) return false;
  // Inverse kinematics shows whether the gain is unsuitable or the pose cannot be reached.
  const Configuration& q = motion.trajectory.positions.back();
  InverseResult answer = inverse_kinematics(arm, goal, {.seed = q, .task = task});
  explain(answer);
  if (answer.status != InverseStatus::solved) {
    motion.status = motion_status(answer.status);
    motion.reason = answer.reason;
  } else if (step_at(q).damped && motion.steps < options.simulation.max_steps) {
    motion.status = MotionStatus::singular;
    motion.reason.set(ReasonField::at_singularity, true);
  }
  return false;
}

/// Sets the index of the intermediate pose of a reason.
void set_pose(int i, const CartesianOptions& options, Reason& reason) {
  reason.set(ReasonField::pose, static_cast<std::size_t>(i));
  reason.set(ReasonField::poses, static_cast<std::size_t>(options.intermediate));
}

/// Controls the motion to one waypoint by inverse kinematics at intermediate poses and eq. 1.3
/// between them.
bool control_by_solutions(const Arm& arm, const Pose& goal, const Task& task,
                          const CartesianOptions& options, ControlledMotion& motion) {
  const Pose from = forward_kinematics(arm, motion.trajectory.positions.back());
  for (int i = 1; i <= options.intermediate; ++i) {
    const Configuration q = motion.trajectory.positions.back();
    const Pose pose = interpolate(from, goal, double(i) / options.intermediate);
    InverseResult answer =
        inverse_kinematics(arm, pose,
                           {.seed = q,
                            .task = task,
                            .tolerance = std::min(1e-9, options.simulation.tolerance),
                            .budget = options.simulation.budget});
    explain(answer, options.simulation.budget);
    if (answer.status != InverseStatus::solved) {
      motion.status = motion_status(answer.status);
      motion.reason = answer.reason;
      set_pose(i, options, motion.reason);
      return false;
    }
    const Configuration& next = answer.solutions.front();
    const double jump = largest_rotation(arm, next - q);
    if (jump > max_jump && options.intermediate > 1) {
      motion.status = MotionStatus::singular;
      motion.reason = {ReasonCode::next_solution_far, {{ReasonField::change, jump}}};
      set_pose(i, options, motion.reason);
      return false;
    }
    const ControlLaw law{
        [&](const Configuration& now) {
          return std::max((next - now).lpNorm<Eigen::Infinity>(),
                          remaining_error(arm, pose, task, now));
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
                "; a line takes 1 to 100000 intermediate poses, its end included");
  }
  if (options.task) check_task(*options.task);
}

}  // namespace

std::string name(CartesianMethod method) {
  constexpr internal::EnumNames<CartesianMethod> names("method",
                                                       "inverse-jacobian inverse-kinematics");
  return names.of(method);
}

ControlledMotion control_in_lines(const Arm& arm, const Configuration& start,
                                  std::span<const Pose> given_waypoints,
                                  const CartesianOptions& given) {
  BudgetMeter budget(given.simulation.budget);
  CartesianOptions options = given;
  options.simulation.budget = budget.part();
  check(options);
  const std::vector<Pose> waypoints = checked_waypoints(given_waypoints);
  if (const auto plane = internal::ToolPlane::required(arm, options.task)) {
    for (const Pose& pose : waypoints) plane->check(pose, "a waypoint");
  }
  const Task task = options.task.value_or(default_task(arm));
  ControlledMotion motion = begin_motion(arm, start);
  const auto control = options.method == CartesianMethod::inverse_jacobian ? control_by_jacobian
                                                                           : control_by_solutions;
  for (std::size_t w = 0; w < waypoints.size(); ++w) {
    const std::size_t first = motion.trajectory.size() - 1;
    const bool reached = control(arm, waypoints[w], task, options, motion);
    const auto samples = std::span<const Configuration>(motion.trajectory.positions).subspan(first);
    motion.overshoot = std::max(motion.overshoot, line_overshoot(samples, arm, waypoints[w]));
    motion.error = remaining_error(arm, waypoints[w], task, motion.trajectory.positions.back());
    if (!reached) {
      motion.reason.set(ReasonField::line, w + 1).set(ReasonField::lines, waypoints.size());
      return motion;
    }
    motion.arrivals.push_back(motion.trajectory.size() - 1);
  }
  set_limit_usage(arm, budget, motion);
  return motion;
}

}  // namespace beeline
