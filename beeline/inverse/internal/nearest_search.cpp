#include <beeline/inverse/internal/nearest_pose.h>
#include <beeline/inverse/internal/nearest_search.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {
namespace {

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

}  // namespace

Deviation deviation_at(const Request& request, const Configuration& q) {
  return task_deviation(request.task, request.goal, forward_kinematics(request.arm, q));
}

const Configuration& nearest_of_searches(const Request& request, const Task& task,
                                         SolverState& state, const Configuration& start) {
  const Kept<NumericalProblem> problem(request.arm, NumericalProblem::Key{task, true});
  multi_start({request.arm, *problem, seeds_for(state, true, *problem)},
              goal_within_digits(request), start,
              {.tolerance = request.tolerance,
               .max_iterations = 200,  // towards a minimum above zero it converges linearly
               .max_restarts = max_starts,
               .random_seed = request.options.random_seed,
               .budget = request.budget},
              state.buffers(), state.search());
  return state.search().nearest.q;
}

Configuration nearest_for(const Request& request, const Task& task, SolverState& state,
                          const Configuration& start) {
  const Configuration& q = nearest_of_searches(request, task, state, start);
  if (state.search().nearest.converged || request.arm.dof() > max_refined) return q;
  return nearest_for_task(request.arm, goal_within_digits(request), task, q);
}

Configuration nearest_orientation_of_many(const Request& request, const Task& position,
                                          SolverState& state, const Configuration& start) {
  if (deviation_at(request, start).position > request.tolerance) return start;
  const Kept<NumericalProblem> problem(request.arm, NumericalProblem::Key{position, true});
  multi_start({request.arm, *problem, seeds_for(state, true, *problem)}, request.goal, start,
              {.tolerance = request.tolerance,
               .max_restarts = max_starts,
               .all = true,
               .random_seed = request.options.random_seed,
               .budget = request.budget},
              state.buffers(), state.search());
  Configuration best =
      nearest_orientation(request.arm, request.goal, request.task, start, request.budget);
  for (const Configuration& q : state.search().solutions) {
    if (request.budget.ended()) break;
    const Configuration there =
        nearest_orientation(request.arm, request.goal, request.task, q, request.budget);
    if (deviation_at(request, there).orientation < deviation_at(request, best).orientation) {
      best = there;
    }
  }
  return best;
}

}  // namespace beeline::internal
