#include <algorithm>
#include <bit>
#include <cmath>

#include <beeline/inverse/internal/methods.h>
#include <beeline/pose/angle.h>

namespace beeline::internal {
namespace {

/// One solution of an arm with a joint to spare. A few values of that joint find most; for the rest
/// descents from near them find more than more values would.
int one_of_many(InverseMethods& methods, const Pose& goal, const ConfigurationRef& seed,
                PieperRequest& six, Eigen::Ref<Eigen::MatrixXd> solutions) {
  constexpr int few = 9;
  const PieperSolver& form = *methods.closed;
  const LockedRange range = locked_range(methods.arm, methods.bounds, seed, form);
  LeastOutside outside;
  const LockedBranch branch =
      first_within(form, goal, range, std::min(few, methods.options.grid), six, outside);
  if (branch.lane >= 0 && (branch.found.continuum >> branch.lane & 1) == 0) {
    form.configuration(branch.found, branch.lane, branch.value, solutions.col(0));
    return 1;
  }
  if (out_of_reach(methods.arm, goal, methods.task, methods.options.tolerance)) return -1;
  if (outside.count > 0 &&
      solve_from(methods, goal, outside, methods.options.tolerance, solutions.col(0))) {
    return 1;
  }
  return search_fast_path(methods, goal, seed, solutions) ? 1 : -1;
}

/// The lanes within limits, nearest first; -1 where something needs a second look.
int lanes_in_order(const PieperRequest& six, const PieperBranches& found, int (&lanes)[8]) {
  int count = 0;
  for (unsigned rest = found.found; rest != 0; rest &= rest - 1) {
    const int lane = std::countr_zero(rest);
    if (!(found.residual[lane] <= six.max_residual)) return -1;
    if ((found.within >> lane & 1) == 0) {
      // A hair outside its limits it may still be mended.
      constexpr double hair = 1e-6;
      if (found.excess[lane] < hair) return -1;
      continue;
    }
    int place = count++;
    for (; place > 0 && found.distance[lanes[place - 1]] > found.distance[lane]; --place) {
      lanes[place] = lanes[place - 1];
    }
    lanes[place] = lane;
  }
  return count;
}

/// Whether two of these lanes are one solution, whole turns aside.
bool has_twins(const PieperBranches& found, const int* lanes, int count) {
  constexpr double twin = 1e-4;  // radians or metres
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < i; ++j) {
      const bool same = std::all_of(std::begin(found.q), std::end(found.q), [&](const auto& q) {
        return std::abs(wrap_angle(q[lanes[i]] - q[lanes[j]])) < twin;
      });
      if (same) return true;
    }
  }
  return false;
}

}  // namespace

int solve_fast_path(InverseMethods& methods, const Pose& goal, const ConfigurationRef& seed,
                    Eigen::Ref<Eigen::MatrixXd> solutions) {
  const InverseOptions& options = methods.options;
  if (options.time_limit || seed.cwiseAbs().maxCoeff() > farthest_seed) return -1;
  if (!methods.closed) {
    const bool any_will_do = !methods.planar && !methods.general && !options.all && !options.lock &&
                             options.redundancy == Redundancy::any;
    if (!any_will_do || out_of_reach(methods.arm, goal, methods.task, options.tolerance)) return -1;
    return search_fast_path(methods, goal, seed, solutions) ? 1 : -1;
  }
  const PieperSolver& form = *methods.closed;
  // Free joints have shares in distances and solutions.
  if (form.has_free_joints() || !methods.closed_is_sure) return -1;
  PieperRequest six =
      form.request(seed, methods.bounds.lower, methods.bounds.upper, options.tolerance);
  double value = 0;  // of a locked joint
  if (options.lock) {
    check_lock(methods, seed);
    value = seed[*options.lock];
  } else if (form.locked()) {
    const bool any_will_do = !options.all && options.redundancy == Redundancy::any &&
                             options.method == InverseMethod::automatic;
    return any_will_do ? one_of_many(methods, goal, seed, six, solutions) : -1;
  }
  PieperBranches found;
  form.branches(goal, value, six, found);
  if (!options.all) {
    const int lane = nearest_lane(six, found);
    if (lane < 0 || (found.continuum >> lane & 1) != 0) return -1;
    form.configuration(found, lane, value, solutions.col(0));
    return 1;
  }
  if (options.every_turn || found.continuum != 0 || nearly_found(form, found)) return -1;
  int lanes[8];
  const int count = lanes_in_order(six, found, lanes);
  if (found.twin != 0 && has_twins(found, lanes, count)) return -1;
  const int shown = std::min(count, static_cast<int>(solutions.cols()));
  for (int i = 0; i < shown; ++i) {
    form.configuration(found, lanes[i], value, solutions.col(i));
  }
  return shown;
}

}  // namespace beeline::internal
