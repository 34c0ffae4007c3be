#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <beeline/inverse/internal/diagnosis.h>
#include <beeline/inverse/internal/failure_status.h>
#include <beeline/inverse/internal/nearest_pose.h>
#include <beeline/inverse/internal/nearest_search.h>
#include <beeline/inverse/internal/range_examination.h>
#include <beeline/inverse/numerical/representative.h>

namespace beeline::internal {
namespace {

/// Whether the pose has a solution if limits are ignored, by the values of the redundant joint
/// beyond its limits. Those within were examined and have none. Nothing if that is not clear.
std::optional<bool> is_solved_beyond(const SolverState& state, const Request& request) {
  const PieperSolver& form = state.pieper_solver();
  const int k = *form.locked();
  if (kind(request.arm.joint_of(k)) != JointKind::revolute) return std::nullopt;
  const LockedRange within =
      locked_range(request.arm, request.bounds, request.seed, k, form.size());
  const LockedRange beyond{
      .lower = within.upper, .upper = within.lower + 2 * std::numbers::pi, .seed = within.upper};
  if (beyond.upper <= beyond.lower) return false;
  const double intervals =
      max_range_intervals * (beyond.upper - beyond.lower) / (2 * std::numbers::pi);
  const Bounds& open = state.defaults->no_limits;
  PieperRequest loop =
      form.request(request.seed, request.weights, open.lower, open.upper, request.tolerance);
  LeastOutside outside;
  const ExaminedRange found =
      examine_range(form, request.goal, beyond, loop, request.budget, outside,
                    std::clamp(static_cast<int>(std::ceil(intervals)), 2, max_range_intervals));
  if (found.branch.lane < 0) return found.conclusive ? std::optional(false) : std::nullopt;
  Configuration q(request.arm.dof());
  form.configuration(found.branch.found, found.branch.lane, found.branch.value, q);
  return error_at(request, q) <= request.tolerance ? std::optional(true) : std::nullopt;
}

/// The status of a pose that has no solution, with or without limits.
std::optional<InverseStatus> status_by_position(SolverState& state, const Request& request) {
  const Task position = position_part(request.task);
  if (position.size() == 0 || position.size() == request.task.size()) return std::nullopt;
  const Configuration& q = nearest_of_searches(request, position, state, request.seed);
  if (!request.budget.complete()) return std::nullopt;
  const double error = deviation_at(request, q).position;
  if (error <= request.tolerance) return InverseStatus::orientation_unreachable;
  // A minimum so far from zero is not one of rounding.
  constexpr double far = 1e-3;  // fraction of the arm's size
  if (error > far * unit_of_length(request.arm)) return InverseStatus::unreachable;
  return std::nullopt;
}

}  // namespace

std::optional<InverseStatus> status_without_nearest(SolverState& state, const Request& request,
                                                    const UnconstrainedResult& evidence) {
  if (out_of_reach(state.defaults->ball, request.goal, request.task, request.tolerance)) {
    return InverseStatus::unreachable;
  }
  if (evidence.violation) {
    return evidence.violation->of_orientation ? std::nullopt
                                              : std::optional(InverseStatus::unreachable);
  }
  if (evidence.least_outside || evidence.doubtful || !request.budget.complete())
    return std::nullopt;
  if (evidence.range_examined) {
    const std::optional<bool> solved = is_solved_beyond(state, request);
    if (!solved) return std::nullopt;
    if (*solved) return InverseStatus::outside_limits;
  } else if (!evidence.complete || evidence.continuum) {
    return std::nullopt;
  }
  return status_by_position(state, request);
}

void set_unexplained(const Request& request, const UnconstrainedResult& evidence,
                     InverseStatus status, InverseResult& result) {
  result.residual = std::numeric_limits<double>::quiet_NaN();
  set_no(request, evidence, status, result);
}

}  // namespace beeline::internal
