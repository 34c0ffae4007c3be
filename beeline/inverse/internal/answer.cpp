#include <cmath>

#include <beeline/error.h>
#include <beeline/inverse/internal/joint_lock.h>
#include <beeline/inverse/internal/methods.h>
#include <beeline/inverse/internal/reason.h>
#include <beeline/inverse/internal/redundancy.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/pose/angle.h>

namespace beeline::internal {
namespace {

/// With a coordinate locked it is another arm, which is kept as long as the value stays.
InverseResult answer_locked(InverseMethods& methods, const Pose& world_T_tool,
                            const Configuration& seed, bool with_reason) {
  check_configuration(methods.arm, seed);
  check_lock(methods, seed);
  const int k = *methods.options.lock;
  const double value = seed[k];
  if (methods.shorter.empty() || methods.shorter_value != value) {
    InverseOptions options = methods.options;
    options.lock.reset();
    options.seed.reset();
    options.task = methods.task;
    methods.shorter = {inverse_methods(with_locked(methods.arm, k, value), options)};
    methods.shorter.front().missing = k;
    methods.shorter_value = value;
  }
  InverseResult result =
      answer(methods.shorter.front(), world_T_tool, without(seed, k), with_reason);
  for (Configuration& q : result.solutions) q = with(q, k, value);
  if (result.nearest) {
    result.nearest->q = with(result.nearest->q, k, value);
    if (result.nearest->blocking >= k) ++result.nearest->blocking;
  }
  return result;
}

/// The seed, its joints that turn without limits by the nearest turn to zero where they are far
/// off.
Configuration brought_near(const InverseMethods& methods, Configuration seed) {
  for (int k = 0; k < seed.size(); ++k) {
    const bool open =
        !std::isfinite(methods.bounds.lower[k]) && !std::isfinite(methods.bounds.upper[k]);
    if (open && std::abs(seed[k]) > farthest_seed && turns_around(methods.arm, k)) {
      seed[k] = wrap_angle(seed[k]);
    }
  }
  return seed;
}

}  // namespace

InverseResult answer(InverseMethods& methods, const Pose& world_T_tool, const Configuration& seed,
                     bool with_reason) {
  if (methods.options.lock) return answer_locked(methods, world_T_tool, seed, with_reason);
  check_configuration(methods.arm, seed);
  const Request request = make_request(methods.arm, methods.options, methods.task, methods.bounds,
                                       world_T_tool, brought_near(methods, seed));
  InverseResult result;
  result.method = description(methods);
  const bool formulas = methods.planar || methods.closed || methods.general;
  UnconstrainedResult unconstrained;
  unconstrained.law =
      invariant_violation(request.arm, request.goal, request.task, request.tolerance);
  if (unconstrained.law) {
    unconstrained.complete = true;
  } else if (formulas) {
    unconstrained = solve_closed(methods, request, result);
  }
  // Of a continuum another member may be within limits.
  const bool last_word =
      unconstrained.complete && !(unconstrained.continuum && result.solutions.empty());
  const bool lacking = result.solutions.empty() || (unconstrained.doubtful && request.options.all);
  if (lacking && !last_word && methods.options.method != InverseMethod::closed_form &&
      !out_of_reach(request.arm, request.goal, request.task, request.tolerance)) {
    const bool added = result.solutions.empty();
    unconstrained = solve_numerical(methods, request, result, unconstrained);
    if (added && !result.solutions.empty()) result.method = "numerical";
    if (result.solutions.empty() && !methods.general) {  // descents may have missed it
      if (!methods.second_opinion) methods.second_opinion = prepared_general(methods);
      if (methods.second_opinion)
        unconstrained = solve_general(*methods.second_opinion, request, result);
    }
  }
  if (result.solutions.empty() && with_reason) explain(methods, request, unconstrained, result);
  if (result.solutions.empty()) return result;
  const bool spare = request.arm.dof() > request.task.size() && !request.options.all;
  if (spare && request.options.redundancy != Redundancy::any) settle(request, result);
  result.complete = request.options.all && unconstrained.complete && !result.singular;
  finish(request, result);
  if (result.singular) {
    result.reason = "singular: arm " + request.arm.name() +
                    " can move with the tool at rest, so that there are infinitely many " +
                    "solutions; in those given the joints concerned are nearest to the seed";
  }
  return result;
}

}  // namespace beeline::internal
