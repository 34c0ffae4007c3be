#include <algorithm>
#include <bit>
#include <cmath>

#include <beeline/inverse/internal/methods.h>
#include <beeline/inverse/internal/reason.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/pose/angle.h>

namespace beeline {
namespace {

void search(InverseMethods& methods, const Question& ask, const Descents& descents,
            Configuration start, bool all, InverseResult& result) {
  for (int k = 0; k < ask.arm.dof(); ++k) {
    const Bounds& bounds = descents.problem.bounds;
    const bool open = !std::isfinite(bounds.lower[k]) && !std::isfinite(bounds.upper[k]);
    if (open && turns_around(ask.arm, k)) start[k] = wrap_angle(start[k]);  // keeps its digits
  }
  multi_start(descents.problem, descents.deck, ask.goal, start,
              {.tolerance = ask.tolerance,
               .iterations = ask.options.iterations,
               .restarts = ask.options.restarts,
               .all = all,
               .random_seed = ask.options.random_seed,
               .deadline = ask.deadline},
              methods.buffers, methods.search);
  result.iterations += methods.search.iterations;
  result.restarts += methods.search.restarts;
  for (const Configuration& q : methods.search.solutions) confirm(ask, q, result);
}

}  // namespace

Descents descents(const Arm& arm, const Task& task, const Bounds& bounds,
                  const InverseOptions& options) {
  Descents ready{descent_problem(arm, task, bounds), {}};
  ready.deck = start_deck(ready.problem, options.random_seed);
  return ready;
}

bool descend_at_once(InverseMethods& methods, const Pose& goal, const ConfigurationRef& seed,
                     Eigen::Ref<Eigen::MatrixXd> solutions) {
  if (!methods.within)
    methods.within = descents(methods.arm, methods.task, methods.bounds, methods.options);
  multi_start(methods.within->problem, methods.within->deck, goal, seed,
              {.tolerance = methods.options.tolerance,
               .iterations = methods.options.iterations,
               .restarts = methods.options.restarts,
               .random_seed = methods.options.random_seed},
              methods.buffers, methods.search);
  if (methods.search.solutions.empty()) return false;
  solutions.col(0) = methods.search.solutions.front();
  return true;
}

bool descend_from(InverseMethods& methods, const Pose& goal, const LeastOutside& outside,
                  double tolerance, Eigen::Ref<Configuration> q) {
  if (!methods.within) {
    methods.within = descents(methods.arm, methods.task, methods.bounds, methods.options);
  }
  const DescentProblem& problem = methods.within->problem;
  LaneDescents& lanes = methods.buffers.lanes;
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

Beyond solve_numerical(InverseMethods& methods, const Question& ask, InverseResult& result,
                       Beyond beyond) {
  if (!methods.within) methods.within = descents(ask.arm, ask.task, ask.bounds, ask.options);
  if (!ask.options.all) {  // the branch that the seed is on, if it leads there
    const Descent run = descend(ask.arm, ask.goal, ask.task, ask.bounds, ask.seed,
                                {.tolerance = ask.tolerance, .iterations = ask.options.iterations});
    result.iterations += run.iterations;
    if (run.converged) confirm(ask, run.q, result);
    if (!result.solutions.empty()) return beyond;
  }
  search(methods, ask, *methods.within, ask.seed, ask.options.all, result);
  const bool limited =
      ask.bounds.lower.array().isFinite().any() || ask.bounds.upper.array().isFinite().any();
  if (!result.solutions.empty() || !limited || beyond.complete) return beyond;

  // Looks without limits for what a search within them missed: a posture whose turns fit, or one
  // from whose nearest corner of the limits a descent arrives.
  const Bounds open = no_bounds(ask.arm);
  if (!methods.anywhere) methods.anywhere = descents(ask.arm, ask.task, open, ask.options);
  InverseOptions few = ask.options;
  few.restarts = std::min(few.restarts, 100);
  const Question anywhere{ask.arm,  few,        ask.goal,      ask.task,
                          ask.seed, ask.bounds, ask.tolerance, ask.deadline};
  search(methods, anywhere, *methods.anywhere, ask.seed, true, result);
  const std::vector<Configuration> found = methods.search.solutions;
  for (const Configuration& q : found) {
    if (!result.solutions.empty()) break;
    const Configuration turned = nearest_representative(ask.arm, q, ask.seed, ask.bounds);
    if (!beyond.least || excess(ask.bounds, turned) < excess(ask.bounds, *beyond.least)) {
      beyond.least = turned;
    }
    const Descent run = descend(ask.arm, ask.goal, ask.task, ask.bounds, turned,
                                {.tolerance = ask.tolerance, .iterations = ask.options.iterations});
    result.iterations += run.iterations;
    if (run.converged) confirm(ask, run.q, result);
  }
  return beyond;
}

}  // namespace beeline
