#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/inverse/internal/methods.h>
#include <beeline/inverse/internal/nearest_pose.h>
#include <beeline/inverse/internal/reason.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>

namespace beeline {
namespace {

constexpr int max_descents = 64;  // that must agree on what is nearest
constexpr int max_followed = 12;  // joints; the Hessian of a longer chain takes its time

Deviation error_in(const Question& ask, const Configuration& q) {
  return task_deviation(ask.task, ask.goal, forward_kinematics(ask.arm, q));
}

NearestMiss nearest_miss(const Question& ask, const Configuration& q) {
  NearestMiss miss;
  miss.q = nearest_representative(ask.arm, q, ask.seed, ask.bounds);
  miss.world_T_tool = forward_kinematics(ask.arm, q);
  miss.error = error_in(ask, q);
  return miss;
}

/// The goal; from far off, where descents would lose their digits, a place on the way to it.
Pose drawn_near(const Question& ask) {
  const Arm::Reach& reach = ask.arm.reach();
  constexpr double far = 100;  // times the reach
  const Vector3 way = ask.goal.translation() - reach.centre;
  Pose goal = ask.goal;
  if (way.norm() > far * reach.radius) {
    goal.translation() = reach.centre + far * reach.radius * way.normalized();
  }
  return goal;
}

/// Of many descents for a part of the task, limits ignored, the one that ends nearest, followed to
/// its very end.
Configuration nearest_for(const Question& ask, const Task& task, InverseMethods& methods,
                          const Configuration& start) {
  const Descents ready = descents(ask.arm, task, no_bounds(ask.arm), ask.options);
  const Pose goal = drawn_near(ask);
  multi_start(ready.problem, ready.deck, goal, start,
              {.tolerance = ask.tolerance,
               .iterations = 200,
               .restarts = max_descents,
               .random_seed = ask.options.random_seed},
              methods.buffers, methods.search);
  const Descent& nearest = methods.search.nearest;
  if (nearest.converged || ask.arm.dof() > max_followed) return nearest.q;
  return nearest_for_task(ask.arm, goal, task, nearest.q);
}

/// Of many configurations at the position, the one whose orientation is nearest.
Configuration least_turned(const Question& ask, const Task& place, InverseMethods& methods,
                           const Configuration& start) {
  if (error_in(ask, start).position > ask.tolerance) return start;
  const Descents ready = descents(ask.arm, place, no_bounds(ask.arm), ask.options);
  multi_start(ready.problem, ready.deck, ask.goal, start,
              {.tolerance = ask.tolerance,
               .restarts = max_descents,
               .all = true,
               .random_seed = ask.options.random_seed},
              methods.buffers, methods.search);
  Configuration best = nearest_orientation(ask.arm, ask.goal, ask.task, start);
  for (const Configuration& q : methods.search.solutions) {
    const Configuration turned = nearest_orientation(ask.arm, ask.goal, ask.task, q);
    if (error_in(ask, turned).orientation < error_in(ask, best).orientation) best = turned;
  }
  return best;
}

void outside_limits(const Question& ask, const Configuration& q, bool all_seen,
                    InverseResult& result) {
  result.status = InverseStatus::outside_limits;
  result.nearest = nearest_miss(ask, q);
  const Configuration over = (ask.bounds.lower - q).cwiseMax(q - ask.bounds.upper);
  result.nearest->excess = over.maxCoeff(&result.nearest->blocking);
  result.residual = result.nearest->excess;
  result.reason = std::string(all_seen ? "every solution is outside the joint limits"
                                       : "no solution within the joint limits was found") +
                  "; in the nearest one " + blocking_joint(ask.arm, q, ask.bounds);
}

void by_law(const Obstacle& law, InverseResult& result) {
  result.method = "geometry";
  result.reason = law.reason;
  result.residual = law.missing;
}

void not_found(const Question& ask, const Configuration& q, const std::string& why,
               InverseResult& result) {
  result.status = InverseStatus::not_found;
  result.nearest = nearest_miss(ask, q);
  const Deviation& error = result.nearest->error;
  result.residual = std::max(error.position, error.orientation);
  result.reason = "no solution was found" + why + "; the nearest misses by " +
                  miss(error, ask.tolerance) + "; that none exists is not shown";
}

/// Whether q is a solution after all, which a search that was cut short did not come to.
bool solves(const Question& ask, const Configuration& q, InverseResult& result) {
  if (error_at(ask, q) > ask.tolerance) return false;
  if (ask.options.method == InverseMethod::closed_form) {
    not_found(ask, q, " by the closed form, though descents find one", result);
    return true;
  }
  confirm(ask, q, result);
  result.method = "numerical";
  if (result.solutions.empty()) {
    const Configuration turned = nearest_representative(ask.arm, q, ask.seed, ask.bounds);
    outside_limits(ask, turned, false, result);
  }
  return true;
}

/// Whether all that is known of the arm solves the pose when limits do not count.
bool solves_anywhere(const Question& ask, InverseResult& result) {
  const bool limited =
      ask.bounds.lower.array().isFinite().any() || ask.bounds.upper.array().isFinite().any();
  if (!limited || ask.options.method != InverseMethod::automatic) return false;
  InverseOptions open = ask.options;
  open.ignore_limits = open.all = true;
  open.every_turn = false;
  open.task = ask.task;
  open.seed.reset();
  InverseMethods methods = inverse_methods(ask.arm, open);
  const InverseResult found = answer(methods, ask.goal, ask.seed, false);
  if (found.solutions.empty()) return false;
  const Configuration* least = nullptr;
  double excess_of_least = 0;
  for (const Configuration& q : found.solutions) {
    const double outside =
        excess(ask.bounds, nearest_representative(ask.arm, q, ask.seed, ask.bounds));
    if (least == nullptr || outside < excess_of_least) least = &q, excess_of_least = outside;
  }
  return solves(ask, *least, result);
}

}  // namespace

void explain(InverseMethods& methods, const Question& ask, const Beyond& beyond,
             InverseResult& result) {
  const bool late = std::chrono::steady_clock::now() >= ask.deadline;
  const bool proved = beyond.law || out_of_reach(ask.arm, ask.goal, ask.task, ask.tolerance);
  const bool outside = beyond.least && excess(ask.bounds, *beyond.least) > 0;
  if (late && !proved && !(outside && beyond.complete)) {
    const Configuration& met = methods.search.nearest.q;
    const bool better =
        met.size() == ask.seed.size() && error_at(ask, met) < error_at(ask, ask.seed);
    return not_found(ask, better ? met : ask.seed, " before the time limit", result);
  }
  if (outside) {
    return outside_limits(ask, *beyond.least, beyond.complete && !beyond.continuum, result);
  }
  const Task place = position_part(ask.task);
  Configuration q = nearest_for(ask, ask.task, methods, ask.seed);
  if (solves(ask, q, result)) return;
  if (place.size() > 0 && place.size() < ask.task.size()) {
    q = nearest_for(ask, place, methods, q);
    q = least_turned(ask, place, methods, q);
    if (solves(ask, q, result)) return;
  }
  if (!proved && solves_anywhere(ask, result)) return;
  result.nearest = nearest_miss(ask, q);
  const Deviation& error = result.nearest->error;
  const std::string arm = "the tool of arm " + ask.arm.name();
  // Descents, and even formulas, may just have missed what is nearly reached.
  constexpr double hair = 1e-6;  // radians, or of the arm's size
  const bool off = error.position > std::max(ask.tolerance, hair * unit_of_length(ask.arm));
  if (place.size() > 0 && (off || (proved && error.position > ask.tolerance))) {
    result.status = InverseStatus::unreachable;
    result.residual = error.position;
    if (beyond.law && !beyond.law->of_orientation) return by_law(*beyond.law, result);
    const bool to_the_end = ask.arm.dof() <= max_followed;
    result.reason = "the position is out of reach by " + number(error.position) + " m: " + arm +
                    (to_the_end ? " comes no nearer than " : " was found to come as near as ") +
                    point(result.nearest->world_T_tool.translation());
    return;
  }
  constexpr double clear = 1e-3;  // radians: fewer descents may just have missed it
  const bool searched = result.restarts >= max_descents && error.orientation > clear;
  const bool in_place = error.position <= ask.tolerance;
  if (beyond.law || (in_place && searched) ||
      (in_place && beyond.complete && error.orientation > hair)) {
    result.status = InverseStatus::orientation;
    result.residual = error.orientation;
    if (beyond.law) return by_law(*beyond.law, result);
    result.reason =
        arm +
        (place.size() > 0 ? " can come to the position, but not with that" : " cannot take that") +
        " orientation: the nearest that was found is off by " + angle(error.orientation);
    return;
  }
  const bool searches = result.iterations > 0;
  not_found(ask, q, searches ? " in " + std::to_string(result.restarts + 1) + " descents" : "",
            result);
}

}  // namespace beeline
