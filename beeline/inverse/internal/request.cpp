#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/error.h>
#include <beeline/inverse/internal/request.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/pose/angle.h>

namespace beeline::internal {
namespace {

/// The rounding error of forward kinematics, metres: a few units in the last place of the arm's
/// size, times the square root of the number of joints.
double rounding_of(const Arm& arm, const Pose& goal) {
  const double reach = std::isfinite(arm.reach().radius) ? arm.reach().radius : 0;
  const double size = std::max(reach, goal.translation().norm());
  return 16 * std::numeric_limits<double>::epsilon() * size *
         std::sqrt(static_cast<double>(arm.joints().size()));
}

void check_count(const char* what, int value, int minimum) {
  if (value >= minimum) return;
  throw Error(std::string(what) + " is " + std::to_string(value) + "; it must be " +
              std::to_string(minimum) + " or more");
}

}  // namespace

void check_options(const Arm& arm, const InverseOptions& options) {
  if (options.task) check_task(*options.task);
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance)) {
    throw Error("tolerance is " + number(options.tolerance) + "; it must be above zero");
  }
  check_count("max_iterations", options.max_iterations, 0);
  check_count("max_restarts", options.max_restarts, 0);
  check_count("grid", options.grid, 2);
  constexpr int finest = 10'000;  // a solution of each takes microseconds
  if (options.grid > finest) {
    throw Error("grid is " + std::to_string(options.grid) + "; it must be 10000 or less");
  }
  const BudgetMeter checked(options.budget);
  if (options.lock && (*options.lock < 0 || *options.lock >= arm.dof())) {
    throw Error("lock is coordinate " + std::to_string(*options.lock) + "; arm " + arm.name() +
                " has 0 to " + std::to_string(arm.dof() - 1));
  }
  if (options.lock && arm.dof() == 1) throw Error("lock leaves arm " + arm.name() + " no joint");
  if (options.every_turn && !options.all) throw Error("every_turn needs the option all");
}

Request make_request(const Arm& arm, const InverseOptions& options, const Task& task,
                     const Bounds& bounds, const Pose& world_T_tool, const Configuration& seed,
                     BudgetMeter& budget) {
  Request request{arm,  options, checked_pose(world_T_tool), task,
                  seed, bounds,  options.tolerance,          budget};
  check_configuration(arm, request.seed);
  request.tolerance = std::max(options.tolerance, rounding_of(arm, request.goal));
  return request;
}

void wrap_unlimited_angles(const Arm& arm, const Bounds& bounds, double beyond, Configuration& q) {
  for (int k = 0; k < q.size(); ++k) {
    const bool unlimited = !std::isfinite(bounds.lower[k]) && !std::isfinite(bounds.upper[k]);
    if (unlimited && std::abs(q[k]) > beyond && is_periodic(arm, k)) q[k] = wrap_angle(q[k]);
  }
}

}  // namespace beeline::internal
