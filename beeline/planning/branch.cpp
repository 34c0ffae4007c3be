#include <algorithm>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/planning/branch.h>
#include <beeline/planning/internal/layered_graph.h>
#include <beeline/planning/internal/track_branch.h>

namespace beeline {

using namespace internal;

namespace {

// Solutions per pose in the layered graph, roughly, each tried when the one before fails: the cost
// grows with the square, and 16 suffice for most paths.
constexpr int grids[] = {16, 64, 256};

/// From one solution for the path's begin, or why there is none.
Branch from_first_solution(const Arm& arm, const ToolPath& path, const BranchOptions& options) {
  const InverseResult begin = inverse_kinematics(arm, pose_at(path, 0), {.task = options.task});
  if (begin.status == InverseStatus::solved) {
    return track_branch(arm, begin.solutions.front(), path, options);
  }
  Branch branch;
  branch.status = motion_status(begin.status);
  branch.reason = "the path's beginning: " + begin.reason;
  return branch;
}

/// Whether a finer grid may succeed where this one failed. The finest is for one redundant joint,
/// whose solutions lie close together on it; and not where the path leaves the workspace.
bool refine(const Arm& arm, const ToolPath& path, const BranchOptions& options, int grid,
            const std::optional<Branch>& best) {
  if (grid >= options.finest_grid) return false;
  if (grid < grids[1] || !best) return grid < grids[1];
  if (arm.dof() > options.task.size() + 1) return false;
  Branch explained = *best;
  explain(arm, path, options, explained);
  return explained.status != MotionStatus::unreachable;
}

/// The branch that reaches farthest of those that layered graphs guide; none where they are empty.
std::optional<Branch> track_layered_graphs(const Arm& arm,
                                           const std::optional<Configuration>& start,
                                           const ToolPath& path, const BranchOptions& options) {
  std::optional<Branch> best;
  for (const int grid : grids) {
    const std::vector<Knot> knots =
        search_layered_graph(arm, path, {.task = options.task, .start = start, .grid = grid}).knots;
    if (!knots.empty()) {
      const KnotSpline spline(knots, path);
      BranchOptions guided = options;
      guided.reasons = BranchOptions::Reasons::none;
      guided.guide = [&spline](double s) { return spline.at(s); };
      const Branch branch = track_branch(arm, knots.front().q, path, guided);
      if (!best || branch.path_parameter > best->path_parameter) best = branch;
      if (branch) break;
    }
    if (!refine(arm, path, options, grid, best)) break;
  }
  return best;
}

}  // namespace

Branch plan_path(const Arm& arm, const std::optional<Configuration>& start, const ToolPath& path,
                 const BranchOptions& options) {
  const bool redundant = arm.dof() > options.task.size();
  if (!redundant && start) return track_branch(arm, *start, path, options);
  if (!redundant) {
    const std::vector<Branch> branches = track_branches(arm, path, options);
    return branches.empty() ? from_first_solution(arm, path, options) : branches.front();
  }
  std::optional<Branch> planned = track_layered_graphs(arm, start, path, options);
  if (planned && *planned) return *planned;
  if (!planned && !start) return from_first_solution(arm, path, options);
  // Where solutions are too rare for a layered graph: redundancy resolved step by step.
  const Branch greedy = track_branch(arm, start ? *start : planned->start, path, options);
  if (!planned || planned->path_parameter <= greedy.path_parameter) return greedy;
  if (options.reasons != BranchOptions::Reasons::none) explain(arm, path, options, *planned);
  return *planned;
}

std::vector<Branch> branch_map(const Arm& arm, const ToolPath& path, BranchOptions options) {
  options.reasons = BranchOptions::Reasons::all;
  if (arm.dof() <= options.task.size()) return track_branches(arm, path, options);
  constexpr int coarse = 6;  // solutions at the begin, roughly: each is planned on its own
  options.finest_grid = grids[1];
  const InverseResult starts = inverse_kinematics(
      arm, pose_at(path, 0),
      {.task = options.task, .all = true, .grid = coarse, .restarts = 4 * coarse});
  std::vector<Branch> branches;
  for (const Configuration& start : starts.solutions) {
    branches.push_back(plan_path(arm, start, path, options));
  }
  std::stable_sort(branches.begin(), branches.end(), better);
  return branches;
}

}  // namespace beeline
