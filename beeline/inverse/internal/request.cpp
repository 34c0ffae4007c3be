#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <beeline/error.h>
#include <beeline/inverse/internal/request.h>
#include <beeline/inverse/internal/solver_state.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {
namespace {

/// Returns the rounding error of forward kinematics, metres: a few units in the last place of the
/// arm's size, times the square root of the number of joints.
double rounding_of(const Arm& arm, const Pose& goal) {
  const double reach = std::isfinite(arm.reach().radius) ? arm.reach().radius : 0;
  const double size = std::max(reach, goal.translation().norm());
  return 16 * std::numeric_limits<double>::epsilon() * size *
         std::sqrt(static_cast<double>(arm.joints().size()));
}

void check_count(const char* what, int value, int minimum) {
  if (value >= minimum) return;
  throw Error(
      "", what,
      " is " + std::to_string(value) + "; it must be " + std::to_string(minimum) + " or more");
}

void check_weights(const Arm& arm, const Eigen::VectorXd& weights) {
  if (weights.size() != arm.dof()) {
    throw Error::of("weights", "weights are " + std::to_string(weights.size()) + " numbers; arm " +
                                   arm.name() + " has " + std::to_string(arm.dof()) +
                                   " coordinates");
  }
  for (const double weight : weights) {
    if (weight >= 1e-6 && weight <= 1e6) continue;
    throw Error::of("weights", "a weight is " + number(weight) + "; each must be from 1e-6 to 1e6");
  }
}

void check_pose_tolerance(const Arm& arm, const Eigen::VectorXd& tolerance) {
  const Eigen::Index lengths = arm.planar() ? 2 : 3, size = arm.planar() ? 3 : 6;
  const std::string meaning =
      arm.planar() ? "x, y (m), theta (rad)" : "x, y, z (m), roll, pitch, yaw (rad)";
  if (tolerance.size() != size) {
    throw Error("", "pose_tolerance",
                " is " + std::to_string(tolerance.size()) + " numbers; arm " + arm.name() +
                    " needs " + std::to_string(size) + ": " + meaning);
  }
  constexpr double farthest = 1e3;  // metres
  for (Eigen::Index k = 0; k < size; ++k) {
    const double most = k < lengths ? farthest : std::numbers::pi;
    // A limit of pi in degrees may be rounded.
    if (tolerance[k] >= 0 && tolerance[k] <= most * (1 + 1e-9)) continue;
    throw Error("", "pose_tolerance",
                " has " + number(tolerance[k]) + "; lengths are 0 to " + number(farthest) +
                    " m and angles 0 to pi: " + meaning);
  }
}

}  // namespace

const InverseOptions& checked_options(const Arm& arm, const InverseOptions& options) {
  if (options.task) check_task(*options.task);
  constexpr double largest = 0.1;  // metres and radians; a larger error is another pose
  if (!(options.tolerance > 0) || !(options.tolerance <= largest)) {
    throw Error("tolerance is " + number(options.tolerance) + "; it must be above 0 and at most " +
                number(largest) + "; pose_tolerance accepts larger deviations");
  }
  check_count("max_iterations", options.max_iterations, 0);
  check_count("max_restarts", options.max_restarts, 0);
  check_count("grid", options.grid, 2);
  constexpr int finest = 10'000;  // each value takes microseconds
  if (options.grid > finest) {
    throw Error("grid is " + std::to_string(options.grid) + "; it must be 10000 or less");
  }
  if (options.lock && (*options.lock < 0 || *options.lock >= arm.dof())) {
    throw Error("lock is coordinate " + std::to_string(*options.lock) + "; arm " + arm.name() +
                " has 0 to " + std::to_string(arm.dof() - 1));
  }
  if (options.lock && arm.dof() == 1) throw Error("lock leaves arm " + arm.name() + " no joint");
  if (options.weights) check_weights(arm, *options.weights);
  if (options.pose_tolerance) check_pose_tolerance(arm, *options.pose_tolerance);
  if (options.every_turn && !options.all) throw Error("", "every_turn", " needs the option all");
  if (options.seed) check_configuration(arm, *options.seed);
  return options;
}

Request make_request(const SolverState& state, const Pose& world_T_tool,
                     const ConfigurationRef& seed, BudgetMeter& budget) {
  const Pose goal = checked_pose(world_T_tool);
  return {.arm = state.arm,
          .options = state.options,
          .goal = goal,
          .task = state.task,
          .seed = seed,
          .bounds = state.bounds,
          .weights = state.weights,
          .tolerance = std::max(state.options.tolerance, rounding_of(state.arm, goal)),
          .budget = budget,
          .redundancy = state.redundancy,
          .near_seed = state.near_seed,
          .has_lock = state.removed_coordinate.has_value()};
}

double distance_from_seed(const Request& request, const ConfigurationRef& q) {
  return std::sqrt(request.weights.dot((q - request.seed).cwiseAbs2()));
}

void wrap_unlimited_angles(const Arm& arm, const Bounds& bounds, double beyond, Configuration& q) {
  for (int k = 0; k < q.size(); ++k) {
    const bool unlimited = !std::isfinite(bounds.lower[k]) && !std::isfinite(bounds.upper[k]);
    if (unlimited && std::abs(q[k]) > beyond && arm.periodic(k)) q[k] = wrap_angle(q[k]);
  }
}

}  // namespace beeline::internal
