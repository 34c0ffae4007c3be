#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include <beeline/inverse/internal/redundant_joint.h>
#include <beeline/math/minimise.h>

namespace beeline::internal {
namespace {

/// Returns the squared distance of a lane from the seed.
double squared_distance(const LockedRange& range, const LockedBranch& branch, int lane) {
  const double away = branch.value - range.seed;
  return branch.found.distance[lane] + range.weight * away * away;
}

/// Returns the objective to be minimised: the squared distance from the seed, or minus the smallest
/// margin to a limit.
double cost(const LockedRequest& locked, const LockedBranch& branch, int lane) {
  const LockedRange& range = locked.range;
  const PieperBranches& found = branch.found;
  if (locked.request.redundancy == Redundancy::nearest) {
    return squared_distance(range, branch, lane);
  }
  double margin = range.limited ? limit_margin(branch.value, range.lower, range.upper) : 1;
  for (std::size_t k = 0; k < 6; ++k) {
    const double lower = locked.loop.lower[k], upper = locked.loop.upper[k];
    margin = std::min(margin, limit_margin(found.q[k][lane], lower, upper));
  }
  return -margin;
}

/// Returns the indices of the local minima of a series, the lowest first, three at most. Branches
/// end at limits, so the global optimum need not be next to the lowest value. More minima take
/// longer.
std::vector<std::size_t> lowest_minima(const std::vector<double>& costs) {
  constexpr std::size_t most = 3;
  std::vector<std::size_t> minima;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    const bool falls = i == 0 || costs[i] <= costs[i - 1];
    const bool rises = i + 1 == costs.size() || costs[i] <= costs[i + 1];
    if (falls && rises && std::isfinite(costs[i])) minima.push_back(i);
  }
  std::sort(minima.begin(), minima.end(),
            [&](std::size_t a, std::size_t b) { return costs[a] < costs[b]; });
  if (minima.size() > most) minima.resize(most);
  return minima;
}

}  // namespace

void LeastOutside::insert(const PieperSolver& form, const LockedBranch& branch, int lane) {
  const double exceeds = branch.found.excess[lane];
  if (count == capacity && !(exceeds < excess[capacity - 1])) return;
  int index = count < capacity ? count++ : capacity - 1;
  for (; index > 0 && excess[index - 1] > exceeds; --index) {
    excess[index] = excess[index - 1];
    std::copy_n(q[index - 1], 7, q[index]);
  }
  excess[index] = exceeds;
  form.configuration(branch.found, lane, branch.value, q[index]);
}

LockedRange locked_range(const Arm& arm, const Bounds& bounds, const ConfigurationRef& seed,
                         int coordinate, double size) {
  const int k = coordinate;
  const bool slides = kind(arm.joint_of(k)) == JointKind::prismatic;
  const double far = slides ? size : std::numbers::pi;
  LockedRange range{bounds.lower[k], bounds.upper[k], seed[k]};
  const bool open = !std::isfinite(range.lower) && !std::isfinite(range.upper);
  if (open) {
    range.lower = range.seed - far;
    range.upper = range.seed + far;
  } else if (!std::isfinite(range.lower)) {
    range.lower = range.upper - 2 * far;
  } else if (!std::isfinite(range.upper)) {
    range.upper = range.lower + 2 * far;
  }
  range.limited = std::isfinite(bounds.lower[k]) && std::isfinite(bounds.upper[k]);
  range.seed = std::clamp(range.seed, range.lower, range.upper);
  return range;
}

int nearest_lane(const PieperRequest& loop, const PieperBranches& found) {
  int nearest = -1;
  for (unsigned rest = found.within; rest != 0; rest &= rest - 1) {
    const int lane = std::countr_zero(rest);
    if (!(found.residual[lane] <= loop.max_residual)) continue;
    if (nearest < 0 || found.distance[lane] < found.distance[nearest]) nearest = lane;
  }
  return nearest;
}

bool nearly_found(const PieperSolver& form, const PieperBranches& found) {
  if (found.weak != 0) return true;
  const double near = 1e-6 * std::max(1.0, form.size());
  if (form.has_virtual_joints()) {
    // Virtual joints may be zero only if other lanes are at the boundary of the workspace. If the
    // axis of a virtual joint is nearly parallel to others, its value is lost with the digits of
    // the lane.
    const double badly_determined = 1e-3 * near;
    for (unsigned rest = found.found; rest != 0; rest &= rest - 1) {
      if (found.residual[std::countr_zero(rest)] > badly_determined) return true;
    }
    if (found.found != 0) return false;
  }
  if (found.found == 0xff) return false;  // no lane is left
  for (int lane = 0; lane < 8; ++lane) {
    if ((found.found >> lane & 1) == 0 && found.residual[lane] < near) return true;
  }
  return false;
}

bool may_be_nearer(const LockedRequest& locked, const PieperBranches& found) {
  constexpr double slack = 1e-6;
  if (found.twin != 0 || nearly_found(locked.form, found)) return true;
  for (unsigned rest = found.found; rest != 0; rest &= rest - 1) {
    const int lane = std::countr_zero(rest);
    const double excess = found.excess[lane];
    const bool closes = found.residual[lane] <= locked.loop.max_residual;
    if (!closes || (excess > 0 && excess < slack)) return true;
  }
  return false;
}

void evaluate(LockedRequest& locked, double value, LockedBranch& branch) {
  branch.value = value;
  locked.form.branches(locked.request.goal, value, locked.loop, branch.found);
  branch.lane = nearest_lane(locked.loop, branch.found);
}

LockedBranch branch_at(LockedRequest& locked, double value, LeastOutside& outside) {
  LockedBranch branch;
  evaluate(locked, value, branch);
  if (branch.lane >= 0) return branch;
  for (unsigned rest = branch.found.found; rest != 0; rest &= rest - 1) {
    outside.insert(locked.form, branch, std::countr_zero(rest));
  }
  return branch;
}

LockedBranch first_within(LockedRequest& locked, int tries, LeastOutside& outside) {
  // Each round halves the step and tries the values between the previous ones.
  const LockedRange& range = locked.range;
  const double width = range.upper - range.lower;
  double step = width / 4;
  int tried = 0;
  for (bool first = true; tried < tries && step > 0; first = false, step /= 2) {
    for (int i = 1; i * step <= width && tried < tries; i += first ? 1 : 2) {
      for (const double value : {range.seed + i * step, range.seed - i * step}) {
        if (value < range.lower || value > range.upper) continue;
        if (locked.request.budget.ended()) return {};
        const LockedBranch branch = branch_at(locked, value, outside);
        if (branch.lane >= 0) return branch;
        ++tried;
      }
    }
  }
  return {};
}

LockedBranch nearest_of_few(LockedRequest& locked, bool tool_is_near, double least) {
  // Fractions of the range. Next to a singularity small steps change the solutions much.
  constexpr double fine_steps[] = {0, 0.005, -0.005, 0.02, -0.02, 0.08, -0.08, 0.3, -0.3};
  constexpr double steps[] = {0, 0.2, -0.2};
  const LockedRange& range = locked.range;
  LockedBranch nearest, branch;
  for (const double step : tool_is_near ? std::span<const double>(fine_steps) : std::span(steps)) {
    const double value = range.seed + step * (range.upper - range.lower);
    if (range.weight * (value - range.seed) * (value - range.seed) >= least) break;
    if (value < range.lower || value > range.upper) continue;
    if (locked.request.budget.ended()) break;
    evaluate(locked, value, branch);
    if (branch.lane < 0) continue;
    const double distance = squared_distance(range, branch, branch.lane);
    if (!(distance < least)) continue;
    least = distance;
    nearest = branch;
  }
  return nearest;
}

std::vector<double> grid_values(const LockedRange& range, int grid) {
  std::vector<double> values;
  for (int i = 0; i < grid; ++i) {
    const double fraction = static_cast<double>(i) / (grid - 1);
    values.push_back((1 - fraction) * range.lower + fraction * range.upper);
  }
  return values;
}

LockedBranch best_within(LockedRequest& locked) {
  const LockedRange& range = locked.range;
  constexpr double none = std::numeric_limits<double>::infinity();
  LockedBranch best, branch;
  double smallest = none;
  const auto cost_at = [&](double value) {
    if (locked.request.budget.ended()) return none;
    evaluate(locked, value, branch);
    double lowest = none;
    for (unsigned rest = branch.found.within; rest != 0; rest &= rest - 1) {
      const int lane = std::countr_zero(rest);
      if (!(branch.found.residual[lane] <= locked.loop.max_residual)) continue;
      const double here = cost(locked, branch, lane);
      lowest = std::min(lowest, here);
      if (here < smallest) {
        smallest = here;
        best = branch;
        best.lane = lane;
      }
    }
    return lowest;
  };
  std::vector<double> values = grid_values(range, locked.request.options.grid);
  values.push_back(range.seed);
  std::sort(values.begin(), values.end());
  std::vector<double> costs;
  for (const double value : values) costs.push_back(cost_at(value));
  for (const std::size_t i : lowest_minima(costs)) {
    constexpr int max_rounds = 40;  // 0.618^40 = 4e-9 of the interval
    const double a = i == 0 ? range.lower : values[i - 1];
    const double b = i + 1 == values.size() ? range.upper : values[i + 1];
    golden_section(a, b, max_rounds, cost_at);  // cost_at() keeps the best
  }
  return best;
}

}  // namespace beeline::internal
