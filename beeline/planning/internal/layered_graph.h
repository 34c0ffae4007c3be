#pragma once

#include <optional>
#include <vector>

#include <beeline/kinematics/task.h>
#include <beeline/path/joint_path.h>
#include <beeline/path/tool_path.h>

namespace beeline {

/// A configuration at a place on a path: `place` whole segments, with a fraction of the next.
struct Knot {
  double place = 0;
  Configuration q;
};

struct LayeredGraphOptions {
  Task task;
  std::optional<Configuration> start = std::nullopt;  ///< the first knot; default: any
  int grid = 16;          ///< solutions of each pose: values of the joint to spare, all branches
  double spacing = 0.06;  ///< between knots, metres; turns by metres_per_radian
};

struct KnotSequence {
  std::vector<Knot> knots;  ///< all the way, or as far as it goes
  bool through = false;
};

/// What joints to spare do along a path, decided for the whole way at once: solutions of inverse
/// kinematics within limits at path parameters along it, of which a chain is chosen whose joints
/// move least and stay away from their limits (dynamic programming over a ladder graph, as in
/// Descartes and in Ferrentino & Chiacchio 2020). Neighbours in the chain can be joined without
/// leaving the path by more than the joints move; it is then drawn taut in the joints' self-motion.
/// That the arm can follow is not proved by this: see track_segment().
KnotSequence search_layered_graph(const Arm& arm, const ToolPath& path,
                                  const LayeredGraphOptions& options);

/// The knots' spline at a place, for track_segment() to keep near: cubic by the way (span_to()),
/// with continuous curvature (joint_spline()) but where the path has a corner.
class KnotSpline {
 public:
  KnotSpline(const std::vector<Knot>& knots, const ToolPath& path);
  Configuration at(double place) const;

 private:
  ToolPath path_;
  Configuration first_;
  std::vector<JointPath> parts_;  ///< from corner to corner
};

}  // namespace beeline
