#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/inverse/internal/methods.h>
#include <beeline/inverse/internal/nearest_pose.h>
#include <beeline/inverse/internal/reason.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {
namespace {

constexpr int max_descents = 64;  // that must agree on what is nearest
constexpr int max_followed = 12;  // joints; the Hessian of a longer chain takes its time

Deviation error_in(const Request& request, const Configuration& q) {
  return task_deviation(request.task, request.goal, forward_kinematics(request.arm, q));
}

NearestMiss nearest_miss(const Request& request, const Configuration& q) {
  NearestMiss miss;
  miss.q = nearest_representative(request.arm, q, request.seed, request.bounds);
  miss.world_T_tool = forward_kinematics(request.arm, q);
  miss.error = error_in(request, q);
  return miss;
}

/// The goal; from far off, where descents would lose their digits, a place on the way to it.
Pose drawn_near(const Request& request) {
  const Arm::Reach& reach = request.arm.reach();
  constexpr double far = 100;  // times the reach
  const Vector3 way = request.goal.translation() - reach.centre;
  Pose goal = request.goal;
  if (way.norm() > far * reach.radius) {
    goal.translation() = reach.centre + far * reach.radius * way.normalized();
  }
  return goal;
}

/// Of many descents for a part of the task, limits ignored, the one that ends nearest, followed to
/// its very end.
Configuration nearest_for(const Request& request, const Task& task, InverseMethods& methods,
                          const Configuration& start) {
  const PreparedSearch ready =
      prepared_search(request.arm, task, no_bounds(request.arm), request.options);
  const Pose goal = drawn_near(request);
  multi_start(ready.problem, ready.seeds, goal, start,
              {.tolerance = request.tolerance,
               .iterations = 200,
               .restarts = max_descents,
               .random_seed = request.options.random_seed},
              methods.buffers, methods.search);
  const NumericalResult& nearest = methods.search.nearest;
  if (nearest.converged || request.arm.dof() > max_followed) return nearest.q;
  return nearest_for_task(request.arm, goal, task, nearest.q);
}

/// Of many configurations at the position, the one whose orientation is nearest.
Configuration least_turned(const Request& request, const Task& place, InverseMethods& methods,
                           const Configuration& start) {
  if (error_in(request, start).position > request.tolerance) return start;
  const PreparedSearch ready =
      prepared_search(request.arm, place, no_bounds(request.arm), request.options);
  multi_start(ready.problem, ready.seeds, request.goal, start,
              {.tolerance = request.tolerance,
               .restarts = max_descents,
               .all = true,
               .random_seed = request.options.random_seed},
              methods.buffers, methods.search);
  Configuration best = nearest_orientation(request.arm, request.goal, request.task, start);
  for (const Configuration& q : methods.search.solutions) {
    const Configuration turned = nearest_orientation(request.arm, request.goal, request.task, q);
    if (error_in(request, turned).orientation < error_in(request, best).orientation) best = turned;
  }
  return best;
}

void outside_limits(const Request& request, const Configuration& q, bool all_seen,
                    InverseResult& result) {
  result.status = InverseStatus::outside_limits;
  result.nearest = nearest_miss(request, q);
  const Configuration over = (request.bounds.lower - q).cwiseMax(q - request.bounds.upper);
  result.nearest->excess = over.maxCoeff(&result.nearest->blocking);
  result.residual = result.nearest->excess;
  result.reason = std::string(all_seen ? "every solution is outside the joint limits"
                                       : "no solution within the joint limits was found") +
                  "; in the nearest one " + blocking_joint(request.arm, q, request.bounds);
}

void by_law(const Infeasibility& law, InverseResult& result) {
  result.method = "geometry";
  result.reason = law.reason;
  result.residual = law.missing;
}

void not_found(const Request& request, const Configuration& q, const std::string& why,
               InverseResult& result) {
  result.status = InverseStatus::not_found;
  result.nearest = nearest_miss(request, q);
  const Deviation& error = result.nearest->error;
  result.residual = std::max(error.position, error.orientation);
  result.reason = "no solution was found" + why + "; the nearest misses by " +
                  miss(error, request.tolerance) + "; that none exists is not shown";
}

/// Whether q is a solution after all, which a search that was cut short did not come to.
bool solves(const Request& request, const Configuration& q, InverseResult& result) {
  if (error_at(request, q) > request.tolerance) return false;
  if (request.options.method == InverseMethod::closed_form) {
    not_found(request, q, " by the closed form, though descents find one", result);
    return true;
  }
  confirm(request, q, result);
  result.method = "numerical";
  if (result.solutions.empty()) {
    const Configuration turned =
        nearest_representative(request.arm, q, request.seed, request.bounds);
    outside_limits(request, turned, false, result);
  }
  return true;
}

/// Whether all that is known of the arm solves the pose when limits do not count.
bool solves_anywhere(const Request& request, InverseResult& result) {
  const bool limited = request.bounds.lower.array().isFinite().any() ||
                       request.bounds.upper.array().isFinite().any();
  if (!limited || request.options.method != InverseMethod::automatic) return false;
  InverseOptions open = request.options;
  open.ignore_limits = open.all = true;
  open.every_turn = false;
  open.task = request.task;
  open.seed.reset();
  InverseMethods methods = inverse_methods(request.arm, open);
  const InverseResult found = answer(methods, request.goal, request.seed, false);
  if (found.solutions.empty()) return false;
  const Configuration* least = nullptr;
  double excess_of_least = 0;
  for (const Configuration& q : found.solutions) {
    const double outside = excess(
        request.bounds, nearest_representative(request.arm, q, request.seed, request.bounds));
    if (least == nullptr || outside < excess_of_least) least = &q, excess_of_least = outside;
  }
  return solves(request, *least, result);
}

}  // namespace

void explain(InverseMethods& methods, const Request& request,
             const UnconstrainedResult& unconstrained, InverseResult& result) {
  const bool late = std::chrono::steady_clock::now() >= request.deadline;
  const bool proved =
      unconstrained.law || out_of_reach(request.arm, request.goal, request.task, request.tolerance);
  const bool outside = unconstrained.least && excess(request.bounds, *unconstrained.least) > 0;
  if (late && !proved && !(outside && unconstrained.complete)) {
    const Configuration& met = methods.search.nearest.q;
    const bool better = met.size() == request.seed.size() &&
                        error_at(request, met) < error_at(request, request.seed);
    return not_found(request, better ? met : request.seed, " before the time limit", result);
  }
  if (outside) {
    return outside_limits(request, *unconstrained.least,
                          unconstrained.complete && !unconstrained.continuum, result);
  }
  const Task place = position_part(request.task);
  Configuration q = nearest_for(request, request.task, methods, request.seed);
  if (solves(request, q, result)) return;
  if (place.size() > 0 && place.size() < request.task.size()) {
    q = nearest_for(request, place, methods, q);
    q = least_turned(request, place, methods, q);
    if (solves(request, q, result)) return;
  }
  if (!proved && solves_anywhere(request, result)) return;
  result.nearest = nearest_miss(request, q);
  const Deviation& error = result.nearest->error;
  const std::string arm = "the tool of arm " + request.arm.name();
  // Searches, and even formulas, may just have missed what is nearly reached.
  constexpr double hair = 1e-6;  // radians, or of the arm's size
  const bool off = error.position > std::max(request.tolerance, hair * unit_of_length(request.arm));
  if (place.size() > 0 && (off || (proved && error.position > request.tolerance))) {
    result.status = InverseStatus::unreachable;
    result.residual = error.position;
    if (unconstrained.law && !unconstrained.law->of_orientation)
      return by_law(*unconstrained.law, result);
    const bool to_the_end = request.arm.dof() <= max_followed;
    result.reason = "the position is out of reach by " + number(error.position) + " m: " + arm +
                    (to_the_end ? " comes no nearer than " : " was found to come as near as ") +
                    point(result.nearest->world_T_tool.translation());
    return;
  }
  constexpr double clear = 1e-3;  // radians: fewer descents may just have missed it
  const bool searched = result.restarts >= max_descents && error.orientation > clear;
  const bool in_place = error.position <= request.tolerance;
  if (unconstrained.law || (in_place && searched) ||
      (in_place && unconstrained.complete && error.orientation > hair)) {
    result.status = InverseStatus::orientation_unreachable;
    result.residual = error.orientation;
    if (unconstrained.law) return by_law(*unconstrained.law, result);
    result.reason =
        arm +
        (place.size() > 0 ? " can come to the position, but not with that" : " cannot take that") +
        " orientation: the nearest that was found is off by " + angle(error.orientation);
    return;
  }
  const bool searches = result.iterations > 0;
  not_found(request, q, searches ? " in " + std::to_string(result.restarts + 1) + " descents" : "",
            result);
}

}  // namespace beeline::internal
