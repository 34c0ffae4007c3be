#include <algorithm>
#include <cmath>
#include <functional>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>
#include <beeline/math/revolution.h>
#include <beeline/math/six_row_svd.h>
#include <beeline/planning/internal/independent_rows.h>
#include <beeline/planning/internal/knot_sequence.h>
#include <beeline/planning/internal/segment_failure.h>
#include <beeline/planning/internal/singular_waypoints.h>
#include <beeline/planning/internal/track_branch.h>
#include <beeline/planning/internal/track_path.h>

namespace beeline::internal {
namespace {

/// The range of a coordinate over the branch.
struct Range {
  double lower = 0, upper = 0;
};

Range range_of(const Branch& branch, int k) {
  Range range{branch.start[k], branch.start[k]};
  for (const TrackedSegment& segment : branch.segments) {
    for (const Configuration& q : segment.samples) {
      range.lower = std::min(range.lower, q[k]);
      range.upper = std::max(range.upper, q[k]);
    }
  }
  return range;
}

/// Returns the path parameter where coordinate k first leaves [lower, upper]; the branch's end if
/// it does not.
double leaves_at(const Branch& branch, int k, double lower, double upper) {
  for (std::size_t w = 0; w < branch.segments.size(); ++w) {
    const TrackedSegment& segment = branch.segments[w];
    for (std::size_t i = 0; i < segment.samples.size(); ++i) {
      const double here = segment.samples[i][k];
      if (here >= lower && here <= upper) continue;
      if (i == 0) return static_cast<double>(w);
      const double before = segment.samples[i - 1][k], limit = here > upper ? upper : lower;
      const double t = std::clamp((limit - before) / (here - before), 0.0, 1.0);
      return static_cast<double>(w) + std::lerp(segment.fractions[i - 1], segment.fractions[i], t);
    }
  }
  return branch.path_parameter;
}

/// Returns the multiple of 2 pi that keeps coordinate k within its limits for the longest part of
/// the branch. Among equal ones it has the largest margin to the limits, then the smallest
/// magnitude.
double best_shift(const Branch& branch, int k, double lower, double upper) {
  constexpr int max_revolutions = 16;  // to either side; limits may be infinite
  const Range range = range_of(branch, k);
  double best = 0, best_parameter = -1, best_margin = 0;
  for (int i = 0; i <= 2 * max_revolutions; ++i) {
    const double shift = (i % 2 == 0 ? -(i / 2) : (i + 1) / 2) * revolution;
    const double low = lower - shift - position_slack, high = upper - shift + position_slack;
    if (branch.start[k] < low || branch.start[k] > high) continue;
    const double parameter = leaves_at(branch, k, low, high);
    const double margin = std::min(range.lower - (lower - shift), upper - shift - range.upper);
    if (parameter < best_parameter) continue;
    if (parameter == best_parameter && margin <= best_margin) continue;
    best = shift;
    best_parameter = parameter;
    best_margin = margin;
  }
  return best;
}

void add_to_coordinate(Branch& branch, int k, double shift) {
  branch.start[k] += shift;
  for (TrackedSegment& segment : branch.segments) {
    for (Configuration& q : segment.samples) q[k] += shift;
  }
}

/// Truncates the branch where it first leaves the limits; the reason names the joint.
void keep_limits(const Arm& arm, const ToolPath& path, Branch& branch) {
  const Bounds bounds = bounds_of(arm);
  int blocking = -1;
  double first = branch.path_parameter;
  for (int k = 0; k < arm.dof(); ++k) {
    const double parameter =
        leaves_at(branch, k, bounds.lower[k] - position_slack, bounds.upper[k] + position_slack);
    if (parameter > first || parameter == branch.path_parameter) continue;
    first = parameter;
    blocking = k;
  }
  if (blocking < 0) return;
  const auto w = std::min(static_cast<std::size_t>(first), path.segments.size() - 1);
  const double s = first - static_cast<double>(w);
  branch.segments.resize(w + 1);
  TrackedSegment& segment = branch.segments[w];
  while (segment.fractions.size() > 1 && segment.fractions.back() > s) {
    segment.fractions.pop_back();
    segment.samples.pop_back();
  }
  branch.path_parameter = first;
  branch.status = MotionStatus::outside_limits;
  const double last = segment.samples.back()[blocking];
  const bool low = last - bounds.lower[blocking] < bounds.upper[blocking] - last;
  branch.reason = passed_limit(arm, blocking, low);
  set_segment(path, w, branch.reason);
  set_stop(path.segments[w], s, branch.reason);
}

/// Moves the periodic coordinates of a branch into their limits, and truncates it where it leaves
/// them.
void fit_into_limits(const Arm& arm, const ToolPath& path, Branch& branch) {
  const Bounds limits = bounds_of(arm);
  for (int k = 0; k < arm.dof(); ++k) {
    if (!arm.periodic(k)) continue;
    add_to_coordinate(branch, k, best_shift(branch, k, limits.lower[k], limits.upper[k]));
  }
  keep_limits(arm, path, branch);
}

/// Whether a branch is complete, and remains so.
bool fits_into_limits(const Arm& arm, const ToolPath& path, const Branch& branch) {
  if (!branch) return false;
  Branch fitted = branch;
  fit_into_limits(arm, path, fitted);
  return static_cast<bool>(fitted);
}

/// One branch for each solution at the beginning, before fit_into_limits().
std::vector<Branch> branches_of(const BranchSearch& search,
                                const std::vector<Configuration>& starts) {
  BudgetMeter& budget = search.budget;
  std::vector<Branch> branches;
  const auto count = static_cast<double>(starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (!within(search.bounds, starts[i])) continue;
    Branch branch{.start = starts[i]};
    if (budget.ended()) {
      set_ended(search.path, budget.ending(), branch);
    } else {
      const auto done = static_cast<double>(i);
      BudgetMeter one(budget.part(done / count, (done + 1) / count));
      track_path(search.with(one), branch);
    }
    branches.push_back(std::move(branch));
  }
  return branches;
}

/// Tracks `branches` again from waypoints where the arm is singular, and if one of the `starts` is
/// singular, or none was found, adds the branches that leave the path's beginning and reach
/// farther.
void pass_singular_waypoints(const BranchSearch& search, const std::vector<Configuration>& starts,
                             std::vector<Branch>& branches) {
  SingularWaypoints waypoints(search);
  const auto fits = [&](const Branch& branch) {
    return fits_into_limits(search.arm, search.path, branch);
  };
  double farthest = 0;
  for (Branch& branch : branches) {
    waypoints.complete(branch, 1, fits);
    farthest = std::max(farthest, branch.path_parameter);
  }
  const auto singular = [&](const Configuration& q) {
    return is_near_singular(search.arm, search.options.task, q);
  };
  if (!starts.empty() && std::none_of(starts.begin(), starts.end(), singular)) return;
  for (Branch& branch : waypoints.branches_from_beginning()) {
    const bool complete = waypoints.complete(branch, 1, fits);
    if (complete || branch.path_parameter > farthest) branches.push_back(std::move(branch));
  }
}

/// Computes all branches, unsorted. Branches that end inside the limits have no reason.
std::vector<Branch> unordered_branches(const Arm& arm, const ToolPath& path,
                                       const BranchOptions& options, BudgetMeter& budget) {
  const InverseResult starts = inverse_kinematics(
      arm, pose_at(path, 0),
      {.task = options.task, .all = true, .ignore_limits = true, .budget = budget.part()});
  const BranchSearch search{arm, path, bounds_without_turns(arm), options, budget};
  std::vector<Branch> branches = branches_of(search, starts.solutions);
  if (std::none_of(branches.begin(), branches.end(),
                   [&](const Branch& branch) { return fits_into_limits(arm, path, branch); })) {
    pass_singular_waypoints(search, starts.solutions, branches);
  }
  for (Branch& branch : branches) fit_into_limits(arm, path, branch);
  return branches;
}

/// Inverse condition numbers of Jacobians along a path. Each decomposition starts from the last
/// one, which takes half the time, as neighbouring samples differ little.
class InverseConditions {
 public:
  explicit InverseConditions(int dof) : six_rows_(6, dof) { six_rows_.setZero(); }

  double of(const Eigen::MatrixXd& jacobian) {
    constexpr int most = 100;  // then rounding adds up in the product of their rotations
    if (++since_reset_ > most) {
      svd_.left.setIdentity();
      since_reset_ = 0;
    }
    six_rows_.topRows(jacobian.rows()) = jacobian;
    svd_.compute(six_rows_);
    Eigen::Matrix<double, 6, 1> sigma = svd_.singular_values;
    std::sort(sigma.begin(), sigma.end(), std::greater<>());
    const double smallest = sigma[std::min(jacobian.rows(), jacobian.cols()) - 1];
    const double negligible =
        negligible_singular_value(sigma[0], std::max<Eigen::Index>(6, jacobian.cols()));
    return smallest > negligible ? smallest / sigma[0] : 0;
  }

 private:
  Eigen::Matrix<double, 6, Eigen::Dynamic> six_rows_;
  SixRowSvd svd_;
  int since_reset_ = 0;
};

}  // namespace

void measure(const Arm& arm, const BranchOptions& options, BudgetMeter& budget, Branch& branch) {
  branch.limit_margin = 1;
  branch.inverse_condition = 1;
  branch.spare_clearance = Limits::none;
  const Task rows = independent_rows(arm, options.task);
  InverseConditions conditions(arm.dof());
  for (const TrackedSegment& segment : branch.segments) {
    for (const Configuration& q : segment.samples) {
      if (budget.ended(options.spare_clearance ? spare_clearance_work : 1)) {
        branch.limit_margin = branch.inverse_condition = branch.spare_clearance = 0;
        return;
      }
      for (int k = 0; k < arm.dof(); ++k) {
        const Limits& limits = arm.limits(k);
        const double margin = std::max(0.0, limit_margin(q[k], limits.lower, limits.upper));
        branch.limit_margin = std::min(branch.limit_margin, margin);
      }
      if (options.spare_clearance) {
        branch.spare_clearance = std::min(branch.spare_clearance, options.spare_clearance(q));
      }
      if (rows.size() == 0) continue;
      const Eigen::MatrixXd j = task_jacobian(arm, q, rows, unit_of_length(arm));
      branch.inverse_condition = std::min(branch.inverse_condition, conditions.of(j));
    }
  }
}

void explain(const Arm& arm, const ToolPath& path, const BranchOptions& options, Branch& branch) {
  if (branch || branch.reason) return;
  std::size_t samples = 1;
  for (const TrackedSegment& segment : branch.segments) samples += segment.samples.size() - 1;
  BudgetMeter budget(options.budget);
  if (budget.ended()) return set_ended(path, budget.ending(), branch);
  const std::size_t w = branch.segments.size() - 1;
  const TrackedSegment& last = branch.segments.back();
  SegmentFailure failure =
      samples >= options.max_samples
          ? too_many_samples(options.max_samples)
          : segment_failure(arm, path.segments[w], options.task, last.samples.back(),
                            last.fractions.back(), budget.part());
  if (!budget.complete()) return set_ended(path, budget.ending(), branch);
  branch.status = failure.status;
  branch.reason = std::move(failure.reason);
  if (w > 0 && branch.reason.code == ReasonCode::singular_at_start) {
    branch.reason.code = ReasonCode::singular_on_path;
  }
  set_segment(path, w, branch.reason);
}

bool better(const Branch& a, const Branch& b) {
  if (a.path_parameter != b.path_parameter) return a.path_parameter > b.path_parameter;
  const bool blocked = a.spare_clearance < 0;
  if (blocked != (b.spare_clearance < 0)) return !blocked;
  return std::min(a.limit_margin, a.inverse_condition) >
         std::min(b.limit_margin, b.inverse_condition);
}

Branch track_branch(const Arm& arm, const Configuration& start, const ToolPath& path,
                    const BranchOptions& options) {
  check_task(arm, path, options.task);
  BudgetMeter budget(options.budget);
  Branch branch{.start = start};
  const BranchSearch search{arm, path, bounds_of(arm), options, budget};
  track_path(search, branch);
  if (!branch && !options.guide && !is_redundant(arm, options.task)) {
    SingularWaypoints(search).complete(branch, 0, [](const Branch&) { return true; });
  }
  if (options.reasons != BranchOptions::Reasons::none) explain(arm, path, options, branch);
  measure(arm, options, budget, branch);
  return branch;
}

std::vector<Branch> track_branches(const Arm& arm, const ToolPath& path,
                                   const BranchOptions& options) {
  using Reasons = BranchOptions::Reasons;
  check_task(arm, path, options.task);
  BudgetMeter budget(options.budget);
  std::vector<Branch> branches = unordered_branches(arm, path, options, budget);
  double farthest = 0;
  for (const Branch& branch : branches) farthest = std::max(farthest, branch.path_parameter);
  for (Branch& branch : branches) {  // margins only order branches that reach equally far
    if (options.reasons == Reasons::all || branch.path_parameter == farthest) {
      measure(arm, options, budget, branch);
    }
  }
  std::stable_sort(branches.begin(), branches.end(), better);
  for (Branch& branch : branches) {
    if (options.reasons == Reasons::none) break;
    explain(arm, path, options, branch);
    if (options.reasons == Reasons::best) break;
  }
  return branches;
}

}  // namespace beeline::internal
