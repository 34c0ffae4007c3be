#pragma once

#include <optional>
#include <span>
#include <vector>

#include <beeline/kinematics/task.h>

namespace beeline {

/// A configuration at a place on lines: `place` whole lines, with a fraction of the next.
struct Knot {
  double place = 0;
  Configuration q;
};

struct LadderOptions {
  Task task;
  std::optional<Configuration> start = std::nullopt;  ///< the first knot; default: any
  int grid = 16;          ///< solutions of each pose: values of the joint to spare, all branches
  double spacing = 0.06;  ///< metres and fifths of a radian between knots
};

struct Ladder {
  std::vector<Knot> knots;  ///< all the way, or as far as it goes
  bool through = false;
};

/// What joints to spare do along lines, decided for the whole way at once: solutions of inverse
/// kinematics within limits at places along them, of which a chain is chosen whose joints move
/// least and stay away from their limits (dynamic programming over a ladder graph, as in Descartes
/// and in Ferrentino & Chiacchio 2020). Neighbours in the chain can be joined without leaving the
/// line by more than the joints move; it is then drawn taut in the joints' self-motion. That the
/// arm can follow is not proved by this: see follow().
Ladder ladder(const Arm& arm, std::span<const Pose> poses, const LadderOptions& options);

/// The knots' spline at a place, for follow() to keep near.
class KnotSpline {
 public:
  explicit KnotSpline(const std::vector<Knot>& knots);
  Configuration at(double place) const;

 private:
  std::vector<Knot> knots_;
  std::vector<Configuration> slopes_;
};

}  // namespace beeline
