#include <algorithm>
#include <bit>
#include <cmath>

#include <beeline/inverse/internal/numerical_stage.h>
#include <beeline/inverse/internal/redundant_joint.h>
#include <beeline/inverse/internal/solve_fast_path.h>
#include <beeline/pose/angle.h>

namespace beeline::internal {
namespace {

std::optional<int> one_if(bool solved) { return solved ? std::optional(1) : std::nullopt; }

/// Writes one solution of an arm with a redundant joint. A few values of that joint suffice for
/// most poses. For the others the numerical search from the nearest branches succeeds more often
/// than further values.
std::optional<int> solve_redundant(SolverState& state, const Pose& goal,
                                   const ConfigurationRef& seed, PieperRequest& loop,
                                   Eigen::Ref<Eigen::MatrixXd> solutions) {
  constexpr int few = 9;  // the seed's, and two rounds of steps: see first_within()
  const PieperSolver& form = *state.pieper;
  const LockedRange range = locked_range(state.arm, state.bounds, seed, form);
  LeastOutside outside;
  const LockedBranch branch =
      first_within(form, goal, range, std::min(few, state.options.grid), loop, outside);
  if (branch.lane >= 0 && (branch.found.continuum >> branch.lane & 1) == 0) {
    form.configuration(branch.found, branch.lane, branch.value, solutions.col(0));
    return 1;
  }
  if (out_of_reach(state.arm, goal, state.task, state.options.tolerance)) return std::nullopt;
  if (outside.count > 0 &&
      solve_from_outside(state, goal, outside, state.options.tolerance, solutions.col(0))) {
    return 1;
  }
  return one_if(search_fast_path(state, goal, seed, solutions));
}

/// The lanes within limits, sorted by distance from the seed.
struct OrderedLanes {
  int count = 0;
  int lane[8];
};

/// Returns nothing if a lane needs the corrections of solve().
std::optional<OrderedLanes> lanes_in_order(const PieperRequest& loop, const PieperBranches& found) {
  OrderedLanes order;
  for (unsigned rest = found.found; rest != 0; rest &= rest - 1) {
    const int lane = std::countr_zero(rest);
    if (!(found.residual[lane] <= loop.max_residual)) return std::nullopt;
    if ((found.within >> lane & 1) == 0) {
      // As in add_solution(): a lane outside by less may be within limits once it is corrected.
      constexpr double slack = 1e-6;
      if (found.excess[lane] < slack) return std::nullopt;
      continue;
    }
    int index = order.count++;
    for (; index > 0 && found.distance[order.lane[index - 1]] > found.distance[lane]; --index) {
      order.lane[index] = order.lane[index - 1];
    }
    order.lane[index] = lane;
  }
  return order;
}

/// Whether two of these lanes are the same posture.
bool has_twins(const PieperBranches& found, const OrderedLanes& order) {
  // Two solutions merge at the boundary of the workspace.
  constexpr double twin = 1e-4;  // radians or metres
  for (int i = 0; i < order.count; ++i) {
    for (int j = 0; j < i; ++j) {
      const bool same = std::all_of(std::begin(found.q), std::end(found.q), [&](const auto& q) {
        return std::abs(wrap_angle(q[order.lane[i]] - q[order.lane[j]])) < twin;
      });
      if (same) return true;
    }
  }
  return false;
}

/// Writes all solutions of six joints.
std::optional<int> write_all(const PieperSolver& form, const PieperRequest& loop,
                             const PieperBranches& found, double value,
                             Eigen::Ref<Eigen::MatrixXd> solutions) {
  if (found.continuum != 0 || nearly_found(form, found)) return std::nullopt;
  const std::optional<OrderedLanes> order = lanes_in_order(loop, found);
  if (!order || (found.twin != 0 && has_twins(found, *order))) return std::nullopt;
  const int shown = std::min(order->count, static_cast<int>(solutions.cols()));
  for (int i = 0; i < shown; ++i) {
    form.configuration(found, order->lane[i], value, solutions.col(i));
  }
  return shown;
}

}  // namespace

std::optional<int> solve_fast_path(SolverState& state, const Pose& goal,
                                   const ConfigurationRef& seed,
                                   Eigen::Ref<Eigen::MatrixXd> solutions) {
  const InverseOptions& options = state.options;
  if (options.time_limit || seed.cwiseAbs().maxCoeff() > farthest_seed) return std::nullopt;
  const bool any_one = !options.all && options.redundancy == Redundancy::any;
  if (!state.pieper) {
    if (!any_one || state.planar || state.raghavan_roth || options.lock ||
        out_of_reach(state.arm, goal, state.task, options.tolerance)) {
      return std::nullopt;
    }
    return one_if(search_fast_path(state, goal, seed, solutions));
  }
  const PieperSolver& form = *state.pieper;
  // Solutions and distances would depend on the values chosen for free joints.
  if (form.has_free_joints() || !state.pieper_verified) return std::nullopt;
  PieperRequest loop =
      form.request(seed, state.bounds.lower, state.bounds.upper, options.tolerance);
  double value = 0;  // of a locked joint
  if (options.lock) {
    check_lock(state, seed);
    value = seed[*options.lock];
  } else if (form.locked()) {
    if (!any_one || options.method != InverseMethod::automatic) return std::nullopt;
    return solve_redundant(state, goal, seed, loop, solutions);
  }
  PieperBranches found;
  form.branches(goal, value, loop, found);
  if (options.all) {
    if (options.every_turn) return std::nullopt;
    return write_all(form, loop, found, value, solutions);
  }
  const int lane = nearest_lane(loop, found);
  if (lane < 0 || (found.continuum >> lane & 1) != 0) return std::nullopt;
  form.configuration(found, lane, value, solutions.col(0));
  return 1;
}

}  // namespace beeline::internal
