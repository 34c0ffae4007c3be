#pragma once

#include <optional>
#include <vector>

#include <beeline/budget.h>
#include <beeline/kinematics/task.h>
#include <beeline/path/joint_path.h>
#include <beeline/path/tool_path.h>

namespace beeline::internal {

/// A configuration at a path parameter s: whole segments, with a fraction of the next.
struct Knot {
  double s = 0;
  Configuration q;
};

struct LayeredGraphOptions {
  Task task;
  std::optional<Configuration> start = std::nullopt;  ///< the first knot; default: any
  int grid = 16;          ///< solutions per pose, roughly: values of the redundant joint x branches
  double spacing = 0.06;  ///< of the layers, metres; rotations count by metres_per_radian
  Budget budget = {};
};

struct KnotSequence {
  std::vector<Knot> knots;  ///< one per layer, as far as the path can be reached
  bool complete = false;
};

/// Resolves redundancy along a whole path at once, by dynamic programming over a layered graph (as
/// in Descartes, and in Ferrentino & Chiacchio 2020). Layer r holds solutions Q_r of inverse
/// kinematics within limits for the pose at path parameter s_r. The chosen knots solve
///     min  sum_r c(q_r) + sum_{r>0} sum_k ((q_{r,k} - q_{r-1,k}) / v_k)^2   over q_r in Q_r,
///     c(q) = w sum_k 1 / (margin of joint k to its limits + 0.02),
/// where v_k are the velocity limits. An edge joins nodes that are near each other and have a
/// solution near their midpoint, so that a continuous motion between them is likely. The knots are
/// then smoothed in the null space, at constant tool pose. This does not prove that the arm can
/// move from knot to knot: see track_segment(). Where the budget ends it, the knots are those so
/// far.
KnotSequence search_layered_graph(const Arm& arm, const ToolPath& path,
                                  const LayeredGraphOptions& options);

/// Interpolates knots, as a guide for track_segment(): cubic splines in span_to() (joint_spline()),
/// from corner to corner of the path.
class KnotSpline {
 public:
  KnotSpline(const std::vector<Knot>& knots, const ToolPath& path);
  Configuration at(double s) const;

 private:
  ToolPath path_;
  Configuration first_;
  std::vector<JointPath> parts_;
};

}  // namespace beeline::internal
