#include <algorithm>
#include <iterator>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/error.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/branch.h>
#include <beeline/planning/internal/independent_rows.h>
#include <beeline/planning/internal/layered_graph.h>
#include <beeline/planning/internal/self_motion_graph.h>
#include <beeline/planning/internal/track_branch.h>
#include <beeline/planning/internal/track_path.h>

namespace beeline {

using namespace internal;

namespace {

// Approximate numbers of solutions per pose in the layered graph. Each is tried if the one before
// fails. The cost grows with the square; 16 suffice for most paths.
constexpr int grids[] = {16, 64, 256};

/// Whether redundancy is resolved by search_self_motion_graph().
bool has_self_motion_curves(const Arm& arm, const Task& task) {
  return arm.dof() == task.size() + 1;
}

/// Returns the branch from one solution for the path's beginning, or the reason why there is none.
Branch from_first_solution(const Arm& arm, const ToolPath& path, const BranchOptions& options) {
  InverseResult begin =
      inverse_kinematics(arm, pose_at(path, 0), {.task = options.task, .budget = options.budget});
  explain(begin, options.budget);
  if (begin.status == InverseStatus::solved) {
    return track_branch(arm, begin.solutions.front(), path, options);
  }
  Branch branch;
  branch.status = motion_status(begin.status);
  branch.reason = begin.reason;
  branch.reason.set(ReasonField::beginning, true);
  return branch;
}

/// Moves the tool at each knot to the path's pose in all rows of the task; removes the knots from
/// the first at which this is not possible.
void keep_rows(const Arm& arm, const ToolPath& path, const Task& task, bool given_start,
               KnotSequence& found) {
  const Bounds bounds = bounds_of(arm);
  std::vector<Knot>& knots = found.knots;
  for (std::size_t r = given_start ? 1 : 0; r < knots.size(); ++r) {
    const auto exact = solved_near(arm, pose_at(path, knots[r].s), task, bounds, knots[r].q);
    if (!exact) {
      knots.resize(r);
      found.complete = false;
      return;
    }
    knots[r].q = *exact;
  }
}

/// Searches a graph for knots with the tool at the path's poses in the rows of options.task, which
/// are independent; finer ones for finer grids.
KnotSequence search_graph(const Arm& arm, const std::optional<Configuration>& start,
                          const ToolPath& path, const BranchOptions& options, std::size_t grid) {
  if (has_self_motion_curves(arm, options.task)) {
    const double coarseness = 1 / static_cast<double>(1 << grid);
    return search_self_motion_graph(arm, path,
                                    {.task = options.task,
                                     .start = start,
                                     .spacing = 0.06 * coarseness,
                                     .step = 0.15 * coarseness,
                                     .spare_clearance = options.spare_clearance,
                                     .budget = options.budget});
  }
  return search_layered_graph(arm, path,
                              {.task = options.task,
                               .start = start,
                               .grid = grids[grid],
                               .spare_clearance = options.spare_clearance,
                               .budget = options.budget});
}

/// Whether a finer grid may succeed after this one failed. With one redundant joint: if the graph
/// was complete, or a step of Newton's method may have been too long, or a gap between obstacles
/// too narrow for the nodes. With more: once.
bool refine(const Arm& arm, const BranchOptions& options, std::size_t grid, bool complete) {
  if (!has_self_motion_curves(arm, options.task)) return grid < 1;
  return complete || options.spare_clearance;
}

/// Returns the branch that reaches farthest of the branches guided by graphs; nothing if the graphs
/// are empty.
std::optional<Branch> track_graphs(const Arm& arm, const std::optional<Configuration>& start,
                                   const ToolPath& path, const BranchOptions& options,
                                   BudgetMeter& budget) {
  constexpr double share = 0.8;  // of the graph in the progress
  BranchOptions graph = options;
  graph.budget = budget.part(0, share);
  graph.task = independent_rows(arm, options.task);
  std::optional<Branch> best;
  for (std::size_t i = 0; i < std::size(grids); ++i) {
    KnotSequence found = search_graph(arm, start, path, graph, i);
    if (graph.task != options.task) {
      keep_rows(arm, path, options.task, start.has_value(), found);
    }
    const std::vector<Knot>& knots = found.knots;
    if (!knots.empty()) {
      const KnotSpline spline(knots, path);
      BranchOptions guided = options;
      guided.reasons = BranchOptions::Reasons::none;
      guided.guide = [&spline](double s) { return spline.at(s); };
      guided.budget = budget.part(share, 1);
      const Branch branch = track_branch(arm, knots.front().q, path, guided);
      const bool farther = best && branch.path_parameter > best->path_parameter;
      if (!best || farther || (options.spare_clearance && better(branch, *best))) best = branch;
      if (branch && branch.spare_clearance >= 0) break;
    }
    const bool finest = i + 1 == std::size(grids) || grids[i + 1] > options.max_grid;
    if (finest || budget.ended() || !refine(arm, graph, i, found.complete)) break;
  }
  return best;
}

/// The options of a part of a search.
BranchOptions within(BudgetMeter& budget, const BranchOptions& given) {
  BranchOptions options = given;
  options.budget = budget.part(0, 1);
  return options;
}

/// The samples of a branch as knots.
std::vector<Knot> knots_of(const Branch& branch) {
  std::vector<Knot> knots;
  for (std::size_t i = 0; i < branch.segments.size(); ++i) {
    const TrackedSegment& segment = branch.segments[i];
    for (std::size_t k = 0; k < segment.samples.size(); ++k) {
      knots.push_back({static_cast<double>(i) + segment.fractions[k], segment.samples[k]});
    }
  }
  return knots;
}

Branch best_branch(const Arm& arm, const std::optional<Configuration>& start, const ToolPath& path,
                   const BranchOptions& options, BudgetMeter& budget);

/// Whether the arm has a task with more rows than this one that includes all of its rows: its
/// default_task().
bool has_stricter_task(const Arm& arm, const Task& task) {
  const Task all = default_task(arm);
  bool included = true;
  for (std::size_t i = 0; i < task.rows.size(); ++i) included &= all.rows[i] || !task.rows[i];
  return included && all.size() > task.size();
}

/// Tracks the path near the best motion in which the tool keeps all rows: it has a constant pose
/// relative to the path, the one at `start` or the identity. Nothing if there is none. With one
/// redundant joint a graph is dense enough for gaps between obstacles that a layered graph of more
/// joints misses.
std::optional<Branch> track_all_rows(const Arm& arm, const std::optional<Configuration>& start,
                                     const ToolPath& path, const BranchOptions& options,
                                     BudgetMeter& budget) {
  constexpr Deviation rounding{1e-9, 1e-9};
  const Pose first = pose_at(path, 0);
  const Pose world_T_tool = start ? forward_kinematics(arm, *start) : first;
  const bool on_path = within(task_deviation(Task::spatial(), first, world_T_tool), rounding);
  BranchOptions strict = within(budget, options);
  strict.task = default_task(arm);
  strict.reasons = BranchOptions::Reasons::none;
  const Arm kept_arm = on_path ? arm : with_tcp(arm, world_T_tool.inverse() * first);
  Branch kept = best_branch(kept_arm, start, path, strict, budget);
  if (!kept) return std::nullopt;
  if (on_path) {
    measure(arm, options, budget, kept);
    return kept;
  }
  const KnotSpline spline(knots_of(kept), path);
  BranchOptions guided = within(budget, options);
  guided.guide = [&spline](double s) { return spline.at(s); };
  return track_branch(arm, kept.start, path, guided);
}

/// plan_path() with the budget's meter, which may end it.
Branch best_branch(const Arm& arm, const std::optional<Configuration>& start, const ToolPath& path,
                   const BranchOptions& options, BudgetMeter& budget) {
  const Task rows = independent_rows(arm, options.task);
  const bool redundant = arm.dof() > rows.size();
  if (rows.size() == 0) {  // the tool is on the path at all configurations or at none
    return start ? track_branch(arm, *start, path, options)
                 : from_first_solution(arm, path, options);
  }
  if (!redundant && start) return track_branch(arm, *start, path, options);
  if (!redundant) {
    const std::vector<Branch> branches = track_branches(arm, path, options);
    return branches.empty() ? from_first_solution(arm, path, options) : branches.front();
  }
  std::optional<Branch> planned = track_graphs(arm, start, path, options, budget);
  // Between its samples a motion with less may be blocked, m.
  constexpr double narrow = 5e-3;
  const bool is_free = planned && *planned && planned->spare_clearance >= narrow;
  const bool may_be_stricter = arm.dof() > rows.size() + 1 && has_stricter_task(arm, options.task);
  if (!is_free && may_be_stricter && !budget.ended()) {
    const std::optional<Branch> strict = track_all_rows(arm, start, path, options, budget);
    const auto prefer = [&](const Branch& other) {
      const bool wider = *strict && strict->spare_clearance > other.spare_clearance;
      return wider || better(*strict, other);
    };
    if (strict && (!planned || prefer(*planned))) planned = strict;
  }
  if (planned && (*planned || budget.ended())) return *planned;
  if (!planned && !start) return from_first_solution(arm, path, options);
  // If solutions are too rare for a layered graph, redundancy is resolved step by step.
  const Branch greedy = track_branch(arm, start ? *start : planned->start, path, options);
  if (!planned || planned->path_parameter <= greedy.path_parameter) return greedy;
  if (options.reasons != BranchOptions::Reasons::none) explain(arm, path, options, *planned);
  return *planned;
}

/// Throws Error for a path without segments or without a span for each, a task that its segments do
/// not allow, and tolerances that are not above zero.
void check_branch_search(const Arm& arm, const ToolPath& path, const BranchOptions& options) {
  check_task(arm, path, options.task);
  if (path.spans.size() != path.segments.size()) {
    throw Error("a path of " + std::to_string(path.segments.size()) + " segments has " +
                std::to_string(path.spans.size()) + " spans; it needs one for each");
  }
  const Deviation& tolerance = options.tolerance;
  if (tolerance.position > 0 && tolerance.orientation > 0) return;
  throw Error("the tolerances of a path must be above zero, not " + number(tolerance.position) +
              " m and " + number(tolerance.orientation) + " rad");
}

}  // namespace

Branch plan_path(const Arm& arm, const std::optional<Configuration>& start, const ToolPath& path,
                 const BranchOptions& given) {
  check_branch_search(arm, path, given);
  BudgetMeter budget(given.budget);
  Branch branch = best_branch(arm, start, path, within(budget, given), budget);
  if (!budget.complete()) set_ended(path, budget.ending(), branch);
  return branch;
}

std::vector<Branch> branch_map(const Arm& arm, const ToolPath& path, const BranchOptions& given) {
  check_branch_search(arm, path, given);
  BudgetMeter budget(given.budget);
  BranchOptions options = within(budget, given);
  options.reasons = BranchOptions::Reasons::all;
  const Task rows = independent_rows(arm, options.task);
  if (arm.dof() <= rows.size()) return track_branches(arm, path, options);
  // Approximate number of solutions at the beginning; each is planned separately.
  constexpr int coarse = 6;
  options.max_grid = std::min(options.max_grid, grids[1]);
  if (rows.size() == 0) return {best_branch(arm, {}, path, options, budget)};
  InverseResult starts = inverse_kinematics(arm, pose_at(path, 0),
                                            {.task = rows,
                                             .all = true,
                                             .grid = coarse,
                                             .max_restarts = 4 * coarse,
                                             .budget = options.budget});
  if (rows != options.task) {
    std::erase_if(starts.solutions, [&](Configuration& q) {
      const auto exact = solved_near(arm, pose_at(path, 0), options.task, bounds_of(arm), q);
      if (exact) q = *exact;
      return !exact;
    });
  }
  std::vector<Branch> branches;
  const auto count = static_cast<double>(starts.solutions.size());
  for (const Configuration& start : starts.solutions) {
    const auto done = static_cast<double>(branches.size());
    options.budget = budget.part(done / count, (done + 1) / count);
    branches.push_back(plan_path(arm, start, path, options));
  }
  std::stable_sort(branches.begin(), branches.end(), better);
  return branches;
}

}  // namespace beeline
