#include <algorithm>
#include <bit>
#include <cmath>

#include <beeline/inverse/internal/methods.h>
#include <beeline/inverse/internal/reason.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/pose/angle.h>

namespace beeline::internal {
namespace {

void search(InverseMethods& methods, const Request& request, const PreparedSearch& descents,
            Configuration start, bool all, InverseResult& result) {
  for (int k = 0; k < request.arm.dof(); ++k) {
    const Bounds& bounds = descents.problem.bounds;
    const bool open = !std::isfinite(bounds.lower[k]) && !std::isfinite(bounds.upper[k]);
    if (open && turns_around(request.arm, k)) start[k] = wrap_angle(start[k]);  // keeps its digits
  }
  multi_start(descents.problem, descents.seeds, request.goal, start,
              {.tolerance = request.tolerance,
               .iterations = request.options.iterations,
               .restarts = request.options.restarts,
               .all = all,
               .random_seed = request.options.random_seed,
               .deadline = request.deadline},
              methods.buffers, methods.search);
  result.iterations += methods.search.iterations;
  result.restarts += methods.search.restarts;
  for (const Configuration& q : methods.search.solutions) confirm(request, q, result);
}

}  // namespace

PreparedSearch prepared_search(const Arm& arm, const Task& task, const Bounds& bounds,
                               const InverseOptions& options) {
  PreparedSearch ready{numerical_problem(arm, task, bounds), {}};
  ready.seeds = seed_table(ready.problem, options.random_seed);
  return ready;
}

bool search_fast_path(InverseMethods& methods, const Pose& goal, const ConfigurationRef& seed,
                      Eigen::Ref<Eigen::MatrixXd> solutions) {
  if (!methods.within)
    methods.within = prepared_search(methods.arm, methods.task, methods.bounds, methods.options);
  multi_start(methods.within->problem, methods.within->seeds, goal, seed,
              {.tolerance = methods.options.tolerance,
               .iterations = methods.options.iterations,
               .restarts = methods.options.restarts,
               .random_seed = methods.options.random_seed},
              methods.buffers, methods.search);
  if (methods.search.solutions.empty()) return false;
  solutions.col(0) = methods.search.solutions.front();
  return true;
}

bool solve_from(InverseMethods& methods, const Pose& goal, const LeastOutside& outside,
                double tolerance, Eigen::Ref<Configuration> q) {
  if (!methods.within) {
    methods.within = prepared_search(methods.arm, methods.task, methods.bounds, methods.options);
  }
  const NumericalProblem& problem = methods.within->problem;
  LevenbergMarquardtLanes& lanes = methods.buffers.lanes;
  lanes.active = lanes.arrived = 0;
  for (int i = 0; i < outside.count; ++i) start_lane(problem, outside.q[i], i, lanes);
  while (lanes.active != 0 && lanes.arrived == 0) {
    run_lanes(
        problem, goal,
        {.tolerance = tolerance, .iterations = methods.options.iterations, .first_is_enough = true},
        methods.options.iterations, lanes);
  }
  if (lanes.arrived == 0) return false;
  lane_configuration(problem, lanes, std::countr_zero(lanes.arrived), q.data());
  return true;
}

UnconstrainedResult solve_numerical(InverseMethods& methods, const Request& request,
                                    InverseResult& result, UnconstrainedResult unconstrained) {
  if (!methods.within)
    methods.within = prepared_search(request.arm, request.task, request.bounds, request.options);
  if (!request.options.all) {  // the branch that the seed is on, if it leads there
    const NumericalResult run = levenberg_marquardt(
        request.arm, request.goal, request.task, request.bounds, request.seed,
        {.tolerance = request.tolerance, .iterations = request.options.iterations});
    result.iterations += run.iterations;
    if (run.converged) confirm(request, run.q, result);
    if (!result.solutions.empty()) return unconstrained;
  }
  search(methods, request, *methods.within, request.seed, request.options.all, result);
  const bool limited = request.bounds.lower.array().isFinite().any() ||
                       request.bounds.upper.array().isFinite().any();
  if (!result.solutions.empty() || !limited || unconstrained.complete) return unconstrained;

  // Looks without limits for what a search within them missed: a posture whose turns fit, or one
  // from whose nearest corner of the limits a descent arrives.
  const Bounds open = no_bounds(request.arm);
  if (!methods.anywhere)
    methods.anywhere = prepared_search(request.arm, request.task, open, request.options);
  InverseOptions few = request.options;
  few.restarts = std::min(few.restarts, 100);
  const Request anywhere{request.arm,       few,
                         request.goal,      request.task,
                         request.seed,      request.bounds,
                         request.tolerance, request.deadline};
  search(methods, anywhere, *methods.anywhere, request.seed, true, result);
  const std::vector<Configuration> found = methods.search.solutions;
  for (const Configuration& q : found) {
    if (!result.solutions.empty()) break;
    const Configuration turned =
        nearest_representative(request.arm, q, request.seed, request.bounds);
    if (!unconstrained.least ||
        excess(request.bounds, turned) < excess(request.bounds, *unconstrained.least)) {
      unconstrained.least = turned;
    }
    const NumericalResult run = levenberg_marquardt(
        request.arm, request.goal, request.task, request.bounds, turned,
        {.tolerance = request.tolerance, .iterations = request.options.iterations});
    result.iterations += run.iterations;
    if (run.converged) confirm(request, run.q, result);
  }
  return unconstrained;
}

}  // namespace beeline::internal
