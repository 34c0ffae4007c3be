#include <algorithm>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/planning/internal/layered_graph.h>
#include <beeline/planning/plan.h>

namespace beeline {
namespace {

constexpr int grids[] = {16, 64, 256};  // solutions of each pose, roughly, that make the ladder

/// From any configuration for the first pose, or why there is none.
Branch from_any_beginning(const Arm& arm, const ToolPath& path, const BranchOptions& options) {
  const InverseResult answer = inverse_kinematics(arm, pose_at(path, 0), {.task = options.task});
  if (answer.status == InverseStatus::solved) {
    return track_branch(arm, answer.solutions.front(), path, options);
  }
  Branch branch;
  branch.status = status_of(answer.status);
  branch.reason = "the path's beginning: " + answer.reason;
  return branch;
}

/// Whether a finer grid than this may show a way that others did not. With one joint to spare its
/// solutions lie close together; where the tool cannot come at all there are none.
bool worth_more(const Arm& arm, const ToolPath& path, const BranchOptions& options, int grid,
                const std::optional<Branch>& best) {
  if (grid >= options.finest_grid) return false;
  if (grid < grids[1] || !best) return grid < grids[1];
  if (arm.dof() > options.task.size() + 1) return false;
  Branch explained = *best;
  explain(arm, path, options, explained);
  return explained.status != MotionStatus::unreachable;
}

/// The best of what ladders lead to; nothing when they lead nowhere.
std::optional<Branch> follow_ladders(const Arm& arm, const std::optional<Configuration>& start,
                                     const ToolPath& path, const BranchOptions& options) {
  std::optional<Branch> best;
  for (const int grid : grids) {
    const KnotSequence sequence =
        search_layered_graph(arm, path, {.task = options.task, .start = start, .grid = grid});
    if (!sequence.knots.empty()) {
      const KnotSpline spline(sequence.knots, path);
      BranchOptions guided = options;
      guided.reasons = BranchOptions::Reasons::none;
      guided.guide = [&spline](double place) { return spline.at(place); };
      const Branch branch = track_branch(arm, sequence.knots.front().q, path, guided);
      if (!best || branch.path_parameter > best->path_parameter) best = branch;
      if (branch.status == MotionStatus::reached) break;
    }
    if (!worth_more(arm, path, options, grid, best)) break;
  }
  return best;
}

}  // namespace

Branch plan_path(const Arm& arm, const std::optional<Configuration>& start, const ToolPath& path,
                 const BranchOptions& options) {
  const bool spare = arm.dof() > options.task.size();
  if (!spare && start) return track_branch(arm, *start, path, options);
  if (!spare) {
    const std::vector<Branch> branches = track_branches(arm, path, options);
    return branches.empty() ? from_any_beginning(arm, path, options) : branches.front();
  }
  std::optional<Branch> planned = follow_ladders(arm, start, path, options);
  if (planned && planned->status == MotionStatus::reached) return *planned;
  if (!planned && !start) return from_any_beginning(arm, path, options);
  // As the joints come, deciding at each step: where solutions are too rare for a ladder.
  const Branch greedy = track_branch(arm, start ? *start : planned->start, path, options);
  if (!planned || planned->path_parameter <= greedy.path_parameter) return greedy;
  if (options.reasons != BranchOptions::Reasons::none) explain(arm, path, options, *planned);
  return *planned;
}

std::vector<Branch> branch_map(const Arm& arm, const ToolPath& path, BranchOptions options) {
  options.reasons = BranchOptions::Reasons::all;
  if (arm.dof() <= options.task.size()) return track_branches(arm, path, options);
  constexpr int coarse = 6;
  options.finest_grid = grids[1];  // for each of many
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
