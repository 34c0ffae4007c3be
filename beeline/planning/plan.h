#pragma once

#include <beeline/planning/branch.h>

namespace beeline {

/// The arm's way along a path, decided before anything moves: from `start`, or from the branch that
/// comes out best. Where the arm has joints to spare, what they do is planned for the whole way
/// (search_layered_graph()), on grids that become finer as long as none is found that goes through;
/// else the branches are compared (track_branches()). If there is none, the branch that goes
/// farthest, with its reason. Throws Error what track_branches() throws, and for a start that does
/// not fit the arm or is elsewhere.
Branch plan_path(const Arm& arm, const std::optional<Configuration>& start, const ToolPath& path,
                 const BranchOptions& options);

/// The map of what the arm can do: all branches by track_branches(), best first, or, where it has
/// joints to spare, what plan_path() makes of each of its solutions for the path's begin, on a
/// coarse grid. With all reasons. Throws Error as plan_path().
std::vector<Branch> branch_map(const Arm& arm, const ToolPath& path, BranchOptions options);

}  // namespace beeline
