#include <algorithm>
#include <cmath>

#include <beeline/inverse/internal/nearest_search.h>
#include <beeline/inverse/numerical/error_minimum.h>
#include <beeline/kinematics/forward.h>
#include <beeline/math/damped_least_squares.h>
#include <beeline/math/minimum_norm.h>

namespace beeline::internal {
namespace {

constexpr int max_steps = 100;  // Gauss-Newton at a stretched arm converges linearly

/// Minimises the orientation error from q subject to the position, to a local minimum, by
/// Gauss-Newton steps in the null space of the position's Jacobian. Requires that q satisfies the
/// position part of the task and that the task has rows of both. Accurate to about 1e-3 rad if the
/// arm is stretched at the minimum, unless the budget ends it.
Configuration nearest_orientation(const Request& request, const Configuration& q) {
  const Arm& arm = request.arm;
  const Pose& world_T_tool = request.goal;
  const Task& task = request.task;
  const int positions = position_part(task).size(), angles = task.size() - positions;
  const auto error_at = [&](const Configuration& at) {
    return task_error(task, world_T_tool, forward_kinematics(arm, at));
  };
  Configuration best = q, at = q;
  double smallest = error_at(q).tail(angles).norm();
  for (int step = 0; step < max_steps && !request.budget.ended(); ++step) {
    const Eigen::MatrixXd j = task_jacobian(arm, at, task);
    const Eigen::VectorXd error = error_at(at);
    const Eigen::MatrixXd linear = j.topRows(positions), angular = j.bottomRows(angles);
    const Eigen::MatrixXd inverse = pseudo_inverse(linear);
    const Configuration correction = inverse * error.head(positions);
    const Eigen::MatrixXd null_space =
        Eigen::MatrixXd::Identity(q.size(), q.size()) - inverse * linear;
    // Keeps steps at singularities finite; shortens regular steps by about 1e-6.
    constexpr double damping = 1e-6;
    const Eigen::MatrixXd rotation = angular * null_space;
    const Eigen::VectorXd remainder = error.tail(angles) - angular * correction;
    Configuration change = correction + damped_least_squares(rotation, remainder, damping);
    constexpr double longest = 0.3;  // radians or metres: the range of the linear model
    if (change.norm() > longest) change *= longest / change.norm();
    at += change;
    const Eigen::VectorXd now = error_at(at);
    // A step changes the position in second order. The result is accepted once later steps have
    // corrected that.
    constexpr double in_position = 1e-9;  // metres
    if (now.head(positions).norm() < in_position && now.tail(angles).norm() < smallest) {
      smallest = now.tail(angles).norm();
      best = at;
    }
    constexpr double converged = 1e-12;  // radians or metres
    if (change.norm() < converged) break;
  }
  for (int step = 0; step < 2; ++step) {  // brings the position error to rounding
    const Eigen::MatrixXd linear = task_jacobian(arm, best, task).topRows(positions);
    best += minimum_norm_solution(linear, error_at(best).head(positions)).x;
  }
  return best;
}

/// Returns the goal. A goal far beyond the reach is moved towards the arm, so that the error keeps
/// its digits.
Pose goal_within_digits(const Request& request) {
  const Arm::Reach& reach = request.arm.reach();
  constexpr double far = 100;  // multiple of the reach; costs two of sixteen digits
  const Vector3 offset = request.goal.translation() - reach.centre;
  Pose goal = request.goal;
  if (offset.norm() > far * reach.radius) {
    goal.translation() = reach.centre + far * reach.radius * offset.normalized();
  }
  return goal;
}

/// Runs the searches, limits ignored. A reference into the state.
SearchResult& search_starts(const Request& request, const Task& task, const Pose& goal,
                            SolverState& state, const ConfigurationRef& start, int max_iterations,
                            bool all) {
  const Kept<NumericalProblem> problem(request.arm, NumericalProblem::Key{task, true});
  multi_start({request.arm, *problem, seeds_for(state, true, *problem)}, goal, start,
              {.tolerance = request.tolerance,
               .max_iterations = max_iterations,
               .max_restarts = max_starts,
               .all = all,
               .random_seed = request.options.random_seed,
               .budget = request.budget},
              state.buffers(), state.search());
  return state.search();
}

}  // namespace

Deviation deviation_at(const Request& request, const Configuration& q) {
  return task_deviation(request.task, request.goal, forward_kinematics(request.arm, q));
}

Task position_part(const Task& task) {
  Task part = task;
  for (std::size_t i = 3; i < 6; ++i) part.rows[i] = false;
  return part;
}

const Configuration& nearest_of_searches(const Request& request, const Task& task,
                                         SolverState& state, const ConfigurationRef& start) {
  constexpr int max_iterations = 200;  // towards a minimum above zero it converges linearly
  return search_starts(request, task, goal_within_digits(request), state, start, max_iterations,
                       false)
      .nearest.q;
}

Configuration nearest_for(const Request& request, const Task& task, SolverState& state,
                          const ConfigurationRef& start) {
  Configuration q = nearest_of_searches(request, task, state, start);
  if (state.search().nearest.converged || request.arm.dof() > max_refined) return q;
  minimise_error(request.arm, goal_within_digits(request), task, no_bounds(request.arm), 0,
                 request.budget, q);
  return q;
}

bool is_minimum_above(const Request& request, Configuration q, double least) {
  return request.arm.dof() <= max_refined &&
         minimise_error(request.arm, goal_within_digits(request), request.task,
                        no_bounds(request.arm), least, request.budget, q);
}

Configuration nearest_orientation_of_many(const Request& request, const Task& position,
                                          SolverState& state, const Configuration& start) {
  if (deviation_at(request, start).position > request.tolerance) return start;
  const SearchResult& found = search_starts(request, position, request.goal, state, start,
                                            MultiStartOptions{}.max_iterations, true);
  Configuration best = nearest_orientation(request, start);
  for (const Configuration& q : found.solutions) {
    if (request.budget.ended()) break;
    const Configuration there = nearest_orientation(request, q);
    if (deviation_at(request, there).orientation < deviation_at(request, best).orientation) {
      best = there;
    }
  }
  return best;
}

}  // namespace beeline::internal
