#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/planning/branch.h>
#include <beeline/planning/internal/null_space.h>
#include <beeline/planning/internal/segment_failure.h>

namespace beeline {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double rounding = 1e-9;  // radians or metres that a joint may be beyond a limit

/// "line 2 of 3 ", as failures begin.
std::string segment_number(const ToolPath& path, std::size_t i) {
  return (all_lines(path) ? "line " : "segment ") + std::to_string(i + 1) + " of " +
         std::to_string(path.segments.size()) + " ";
}

/// Follows the path from branch.start as far as it goes.
void follow_all(const Arm& arm, const ToolPath& path, const internal::Bounds& bounds,
                const BranchOptions& options, Branch& branch) {
  Configuration q = branch.start;
  std::size_t left = options.max_samples;
  for (std::size_t i = 0; i < path.segments.size(); ++i) {
    const auto before = static_cast<double>(i),
               segments = static_cast<double>(path.segments.size());
    if (stands_still(path.segments[i], options.task)) {
      branch.segments.push_back({{q}, {1}, {}});
      branch.path_parameter = before + 1;
      continue;
    }
    TrackOptions track_options{.tolerance = options.tolerance, .max_samples = left};
    if (options.guide) {
      track_options.guide = [&](double s) { return options.guide(before + s); };
    }
    if (options.progress) {
      track_options.progress = [&](double s) { options.progress((before + s) / segments); };
    }
    branch.segments.push_back(
        track_segment(arm, path.segments[i], options.task, bounds, q, track_options));
    const TrackedSegment& way = branch.segments.back();
    branch.path_parameter = before + way.fractions.back();
    q = way.samples.back();
    if (!way.through()) {
      branch.status = MotionStatus::not_converged;  // until it is asked why
      return;
    }
    left -= std::min(left, way.samples.size() - 1);  // the corner is both segments'
  }
}

/// How far a coordinate goes on the way.
struct Extent {
  double lower = 0, upper = 0;
};

Extent extent_of(const Branch& branch, int k) {
  Extent extent{branch.start[k], branch.start[k]};
  for (const TrackedSegment& segment : branch.segments) {
    for (const Configuration& q : segment.samples) {
      extent.lower = std::min(extent.lower, q[k]);
      extent.upper = std::max(extent.upper, q[k]);
    }
  }
  return extent;
}

/// Where coordinate k first is outside [lower, upper]: segments done, with a fraction of the next.
double leaves_at(const Branch& branch, int k, double lower, double upper) {
  for (std::size_t w = 0; w < branch.segments.size(); ++w) {
    const TrackedSegment& segment = branch.segments[w];
    for (std::size_t i = 0; i < segment.samples.size(); ++i) {
      const double now = segment.samples[i][k];
      if (now >= lower && now <= upper) continue;
      if (i == 0) return static_cast<double>(w);
      const double before = segment.samples[i - 1][k], limit = now > upper ? upper : lower;
      const double share = std::clamp((limit - before) / (now - before), 0.0, 1.0);
      return static_cast<double>(w) +
             std::lerp(segment.fractions[i - 1], segment.fractions[i], share);
    }
  }
  return branch.path_parameter;
}

/// The whole turns that take coordinate k farthest along, of these the ones that keep it farthest
/// from its limits, and of these the fewest.
double best_turns(const Branch& branch, int k, double lower, double upper) {
  constexpr int max_turns = 16;  // either way: limits may be far away, or nowhere
  const Extent extent = extent_of(branch, k);
  double best = 0, best_done = -1, best_margin = 0;
  for (int i = 0; i <= 2 * max_turns; ++i) {
    const double shift = (i % 2 == 0 ? -(i / 2) : (i + 1) / 2) * turn;
    const double low = lower - shift, high = upper - shift;
    if (branch.start[k] < low - rounding || branch.start[k] > high + rounding) continue;
    const double done = leaves_at(branch, k, low - rounding, high + rounding);
    const double margin = std::min(extent.lower - low, high - extent.upper);
    if (done < best_done || (done == best_done && margin <= best_margin)) continue;
    best = shift, best_done = done, best_margin = margin;
  }
  return best;
}

void shift(Branch& branch, int k, double turns) {
  branch.start[k] += turns;
  for (TrackedSegment& segment : branch.segments) {
    for (Configuration& q : segment.samples) q[k] += turns;
  }
}

/// Cuts the branch off where it first leaves the limits, and tells which joint's.
void keep_limits(const Arm& arm, const ToolPath& path, Branch& branch) {
  const internal::Bounds bounds = internal::bounds_of(arm);
  int blocking = -1;
  double first = branch.path_parameter;
  for (int k = 0; k < arm.dof(); ++k) {
    const double done =
        leaves_at(branch, k, bounds.lower[k] - rounding, bounds.upper[k] + rounding);
    if (done < first || (done == first && done < branch.path_parameter)) first = done, blocking = k;
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
  const double ahead = segment.samples.back()[blocking];
  const bool low = ahead - bounds.lower[blocking] < bounds.upper[blocking] - ahead;
  branch.reason = segment_number(path, w) + place_in_words(path.segments[w], s) +
                  limit_in_the_way(arm, blocking, low);
}

/// The branches that go all the way from the path's end to its begin, told the right way round: at
/// a singular begin one solution stands for infinitely many, and the path may need another.
std::vector<Branch> backward_branches(const Arm& arm, const ToolPath& path,
                                      const internal::Bounds& bounds,
                                      const BranchOptions& options) {
  const ToolPath back = reversed(path);
  const InverseResult ends = inverse_kinematics(
      arm, pose_at(back, 0), {.task = options.task, .all = true, .ignore_limits = true});
  std::vector<Branch> branches;
  for (const Configuration& end : ends.solutions) {
    if (!within(bounds, end)) continue;
    Branch branch{.start = end};
    follow_all(arm, back, bounds, options, branch);
    if (branch.status != MotionStatus::reached) continue;
    std::reverse(branch.segments.begin(), branch.segments.end());
    for (TrackedSegment& segment : branch.segments) {
      std::reverse(segment.samples.begin(), segment.samples.end());
      if (segment.samples.size() == 1) continue;
      std::reverse(segment.fractions.begin(), segment.fractions.end());
      for (double& fraction : segment.fractions) fraction = 1 - fraction;
    }
    branch.start = branch.segments.front().samples.front();
    branches.push_back(std::move(branch));
  }
  return branches;
}

}  // namespace

void narrow(Margins& margins, const Arm& arm, const Task& task, const Configuration& q) {
  for (int k = 0; k < arm.dof(); ++k) {
    const Limits& limits = arm.limits(k);
    margins.limit =
        std::min(margins.limit, std::max(0.0, limit_margin(q[k], limits.lower, limits.upper)));
  }
  const Eigen::MatrixXd j = task_jacobian(arm, q, task, internal::unit_of_length(arm));
  margins.dexterity = std::min(margins.dexterity, 1 / dexterity(j).condition);
}

void measure(const Arm& arm, const Task& task, Branch& branch) {
  Margins margins;
  for (const TrackedSegment& segment : branch.segments) {
    for (const Configuration& q : segment.samples) narrow(margins, arm, task, q);
  }
  branch.limit_margin = margins.limit;
  branch.dexterity = margins.dexterity;
}

void explain(const Arm& arm, const ToolPath& path, const BranchOptions& options, Branch& branch) {
  if (branch.status != MotionStatus::not_converged) return;
  std::size_t samples = 1;
  for (const TrackedSegment& segment : branch.segments) samples += segment.samples.size() - 1;
  const std::size_t w = branch.segments.size() - 1;
  const TrackedSegment& last = branch.segments.back();
  const SegmentFailure failure = samples >= options.max_samples
                                     ? too_many_samples(static_cast<int>(options.max_samples))
                                     : segment_failure(arm, path.segments[w], options.task,
                                                       last.samples.back(), last.fractions.back());
  branch.status = failure.status;
  branch.reason = segment_number(path, w) + failure.reason;
}

bool better(const Branch& a, const Branch& b) {
  if (a.path_parameter != b.path_parameter) return a.path_parameter > b.path_parameter;
  return std::min(a.limit_margin, a.dexterity) > std::min(b.limit_margin, b.dexterity);
}

Branch track_branch(const Arm& arm, const Configuration& start, const ToolPath& path,
                    const BranchOptions& options) {
  check_task(arm, path, options.task);
  Branch branch{.start = start};
  follow_all(arm, path, internal::bounds_of(arm), options, branch);
  if (options.reasons != BranchOptions::Reasons::none) explain(arm, path, options, branch);
  measure(arm, options.task, branch);
  return branch;
}

std::vector<Branch> track_branches(const Arm& arm, const ToolPath& path,
                                   const BranchOptions& options) {
  check_task(arm, path, options.task);
  const InverseResult starts = inverse_kinematics(
      arm, pose_at(path, 0), {.task = options.task, .all = true, .ignore_limits = true});
  const internal::Bounds limits = internal::bounds_of(arm);
  internal::Bounds bounds = limits;
  for (int k = 0; k < arm.dof(); ++k) {
    if (!internal::turns_around(arm, k)) continue;
    bounds.lower[k] = -Limits::none;
    bounds.upper[k] = Limits::none;
  }
  std::vector<Branch> branches;
  const auto add = [&](Branch branch) {
    for (int k = 0; k < arm.dof(); ++k) {
      if (internal::turns_around(arm, k))
        shift(branch, k, best_turns(branch, k, limits.lower[k], limits.upper[k]));
    }
    keep_limits(arm, path, branch);
    branches.push_back(std::move(branch));
  };
  for (const Configuration& start : starts.solutions) {
    if (!within(bounds, start)) continue;
    Branch branch{.start = start};
    follow_all(arm, path, bounds, options, branch);
    add(std::move(branch));
  }
  const bool through = std::any_of(branches.begin(), branches.end(), [](const Branch& branch) {
    return branch.status == MotionStatus::reached;
  });
  const auto singular = [&](const Configuration& q) {
    constexpr double rank_lost = 1e-6;
    return 1 / dexterity(task_jacobian(arm, q, options.task)).condition < rank_lost;
  };
  if (!through && std::any_of(starts.solutions.begin(), starts.solutions.end(), singular)) {
    for (Branch& branch : backward_branches(arm, path, bounds, options)) add(std::move(branch));
  }
  double farthest = 0;
  for (const Branch& branch : branches) farthest = std::max(farthest, branch.path_parameter);
  for (Branch& branch : branches) {  // what only breaks ties is not measured where there is none
    if (options.reasons == BranchOptions::Reasons::all || branch.path_parameter == farthest)
      measure(arm, options.task, branch);
  }
  std::stable_sort(branches.begin(), branches.end(), better);
  using Reasons = BranchOptions::Reasons;
  for (Branch& branch : branches) {
    if (options.reasons == Reasons::none) break;
    explain(arm, path, options, branch);
    if (options.reasons == Reasons::best) break;
  }
  return branches;
}

}  // namespace beeline
