#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/error.h>
#include <beeline/inverse/internal/reason.h>
#include <beeline/inverse/internal/request.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {
namespace {

/// Forward kinematics rounds off about this much of the arm's size.
double rounding_of(const Arm& arm, const Pose& goal) {
  const double reach = std::isfinite(arm.reach().radius) ? arm.reach().radius : 0;
  const double size = std::max(reach, goal.translation().norm());
  return 16 * std::numeric_limits<double>::epsilon() * size *
         std::sqrt(static_cast<double>(arm.joints().size()));
}

void check_count(const char* what, int value, int least) {
  if (value >= least) return;
  throw Error(std::string(what) + " is " + std::to_string(value) + "; it must be " +
              std::to_string(least) + " or more");
}

}  // namespace

void check_options(const Arm& arm, const InverseOptions& options) {
  if (options.task) check_task(*options.task);
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance)) {
    throw Error("tolerance is " + number(options.tolerance) + "; it must be above zero");
  }
  check_count("iterations", options.iterations, 0);
  check_count("restarts", options.restarts, 0);
  check_count("grid", options.grid, 2);
  constexpr int finest = 10'000;
  if (options.grid > finest) {
    throw Error("grid is " + std::to_string(options.grid) + "; it must be 10000 or less");
  }
  if (options.time_limit && !(*options.time_limit > 0)) {
    throw Error("time limit is " + number(*options.time_limit) + " s; it must be above zero");
  }
  if (options.lock && (*options.lock < 0 || *options.lock >= arm.dof())) {
    throw Error("lock is coordinate " + std::to_string(*options.lock) + "; arm " + arm.name() +
                " has 0 to " + std::to_string(arm.dof() - 1));
  }
  if (options.lock && arm.dof() == 1) throw Error("lock leaves arm " + arm.name() + " no joint");
  if (options.every_turn && !options.all) throw Error("every turn makes sense with all only");
}

Request make_request(const Arm& arm, const InverseOptions& options, const Task& task,
                     const Bounds& bounds, const Pose& world_T_tool, const Configuration& seed) {
  using Clock = std::chrono::steady_clock;
  Request request{arm,  options, checked_pose(world_T_tool), task,
                  seed, bounds,  options.tolerance,          Clock::time_point::max()};
  check_configuration(arm, request.seed);
  request.tolerance = std::max(options.tolerance, rounding_of(arm, request.goal));
  constexpr double forever = 1e9;  // seconds
  if (options.time_limit && *options.time_limit < forever) {
    request.deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                          std::chrono::duration<double>(*options.time_limit));
  }
  return request;
}

double error_at(const Request& request, const Configuration& q) {
  const Deviation error =
      task_deviation(request.task, request.goal, forward_kinematics(request.arm, q));
  return std::max(error.position, error.orientation);
}

void confirm(const Request& request, const Configuration& q, InverseResult& result) {
  // Next to a singular solution a value is known to the square root of rounding only.
  constexpr double hair = 1e-6;
  Configuration turned = nearest_representative(request.arm, q, request.seed, request.bounds);
  if (excess(request.bounds, turned) > hair) return;
  turned = turned.cwiseMax(request.bounds.lower).cwiseMin(request.bounds.upper);
  double error = error_at(request, turned);
  if (error > std::max(1e-13, request.tolerance / 100)) {
    // It was set on a bound, is ill conditioned, or lost its digits in turns far from zero.
    const Configuration& near = within(request.bounds, q) ? q : turned;
    const NumericalResult mended =
        levenberg_marquardt(request.arm, request.goal, request.task, request.bounds, near,
                            {.tolerance = request.tolerance});
    const double left = error_at(request, mended.q);
    if (left < error) error = left, turned = mended.q;
  }
  if (!(error <= request.tolerance)) return;
  for (const Configuration& known : result.solutions) {
    if (same_posture(request.arm, known, turned)) return;
  }
  result.solutions.push_back(turned);
}

void finish(const Request& request, InverseResult& result) {
  result.status = InverseStatus::solved;
  if (request.options.every_turn) {
    result.solutions = every_representative(request.arm, result.solutions, request.bounds);
    std::erase_if(result.solutions,
                  [&request](const Configuration& q) {  // set on a bound, or far off
                    return error_at(request, q) > request.tolerance;
                  });
  }
  std::sort(result.solutions.begin(), result.solutions.end(),
            [&request](const Configuration& a, const Configuration& b) {
              const double to_a = (a - request.seed).norm(), to_b = (b - request.seed).norm();
              if (to_a != to_b) return to_a < to_b;
              return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
            });
  if (!request.options.all) result.solutions.resize(1);
  result.residual = 0;
  for (const Configuration& q : result.solutions) {
    result.residual = std::max(result.residual, error_at(request, q));
  }
}

}  // namespace beeline::internal
