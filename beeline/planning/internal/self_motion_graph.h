#pragma once

#include <optional>

#include <beeline/budget.h>
#include <beeline/kinematics/task.h>
#include <beeline/planning/internal/knot_sequence.h>

namespace beeline::internal {

/// Resolves the redundancy of an arm with one joint more than the task has rows, along a whole
/// path. Layer r of the graph has all configurations with the tool at path parameter s_r that a
/// motion from the path's beginning can reach, as nodes on curves of self-motion: see
/// SelfMotionSweep. An edge joins a node with the nodes near its continuation, on the same curve.
///
/// With the margins m(q) of configurations, the smallest of the margins of all joints to their
/// limits (limit_margin()) and the clearance margin (GraphOptions), the knots q_r solve
///     min  sum_r c(q_r) + sum_{r>0} d(q_{r-1}, q_r)
///     subject to  m(q_r) + a_r >= 0.8 min(m*, 1/4),   m* = max min_r (m(q_r) + a_r),
/// where m* is the maximum over all paths through the graph, c and d are the costs of KnotCosts,
/// and a_r is zero, except within a weighted_length() of 0.3 of a given start, which may be near a
/// limit or an obstacle. Blocked nodes have no edges, and edges along a curve end there. Solved
/// by dynamic programming, once for m* and once for the knots. They are then smoothed in the null
/// space within the same margin. This does not prove that the arm can move from knot to knot: see
/// track_segment(). If the budget ends the search, the result has the knots found so far.
KnotSequence search_self_motion_graph(const Arm& arm, const ToolPath& path,
                                      const GraphOptions& options);

/// Whether the layers of the graph reach the path's end. This is a fast necessary condition for a
/// motion, not a proof. False if the budget ends the computation.
bool has_self_motion_path(const Arm& arm, const ToolPath& path, const GraphOptions& options);

}  // namespace beeline::internal
