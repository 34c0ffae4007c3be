#pragma once

#include <optional>
#include <vector>

#include <beeline/budget.h>
#include <beeline/kinematics/task.h>
#include <beeline/planning/internal/knot_sequence.h>

namespace beeline::internal {

/// Resolves any redundancy along a whole path at once, by dynamic programming over a layered graph
/// (as in Descartes, and in Ferrentino & Chiacchio 2020); search_self_motion_graph() is for one
/// redundant joint. Layer r holds solutions Q_r of inverse kinematics within limits for the pose at
/// path parameter s_r. The chosen knots solve
///     min  sum_r c(q_r) + sum_{r>0} d(q_{r-1}, q_r)   over q_r in Q_r,
/// with the costs of KnotCosts, without blocked solutions (options.spare_clearance). An edge joins
/// nodes that are near each other and have a solution near their midpoint that is not blocked, so
/// that a continuous motion between them is likely. The knots are then smoothed in the null space,
/// at constant tool pose. This does not prove that the arm can move from knot to knot: see
/// track_segment(). If the budget ends the search, the result has the knots found so far.
KnotSequence search_layered_graph(const Arm& arm, const ToolPath& path,
                                  const GraphOptions& options);

}  // namespace beeline::internal
