#include <bit>
#include <cmath>

#include <beeline/inverse/methods.h>

namespace beeline {

int answer_at_once(InverseMethods& methods, const Pose& goal, const ConfigurationRef& seed,
                   Eigen::Ref<Eigen::MatrixXd> solutions) {
  const ClosedForm& form = *methods.closed;
  SixQuestion six = form.question(seed, methods.bounds.lower, methods.bounds.upper);
  LockedBranch branch;
  const bool scans = form.locked() >= 0 && !methods.options.lock;
  if (methods.options.lock) check_lock(methods, seed);
  if (scans) {
    if (methods.options.all || methods.options.redundancy != Redundancy::any) return -1;
    const LockedRange range = locked_range(methods.arm, methods.bounds, seed, form);
    // A few values find most; for the rest descents from near them find more than more values.
    constexpr int few = 9;
    LeastOutside outside;
    branch = first_within(form, goal, range, std::min(few, methods.options.grid), six, outside);
    if (branch.lane < 0 && outside.count > 0 &&
        descend_from(methods, goal, outside, methods.options.tolerance, solutions.col(0))) {
      return 1;
    }
    if (branch.lane < 0) return descend_at_once(methods, goal, seed, solutions);
  } else {
    if (form.locked() >= 0) branch.value = seed[form.locked()];
    form.branches(goal, branch.value, six, branch.found);
    branch.lane = nearest_lane(form, branch.found);
  }
  const SixBranches& found = branch.found;
  if (!methods.options.all) {
    if (branch.lane < 0 || (found.continuum >> branch.lane & 1) != 0) return -1;
    form.configuration(found, branch.lane, branch.value, solutions.col(0));
    return 1;
  }
  if (methods.options.every_turn || found.continuum != 0 || nearly_found(form, found)) return -1;
  const double closed = closed_residual(form);
  int lanes[8], count = 0;
  for (unsigned rest = found.found; rest != 0; rest &= rest - 1) {
    const int lane = std::countr_zero(rest);
    if (!(found.residual[lane] <= closed)) return -1;
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
  constexpr double twin = 1e-5;  // solutions this near to each other may be one
  for (int i = 1; i < count; ++i) {
    if (found.distance[lanes[i]] - found.distance[lanes[i - 1]] < twin) {
      bool same = true;
      for (const auto& q : found.q) same = same && std::abs(q[lanes[i]] - q[lanes[i - 1]]) < twin;
      if (same) return -1;
    }
  }
  count = std::min(count, static_cast<int>(solutions.cols()));
  for (int i = 0; i < count; ++i) {
    form.configuration(found, lanes[i], branch.value, solutions.col(i));
  }
  return count;
}

}  // namespace beeline
