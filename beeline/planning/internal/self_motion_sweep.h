#pragma once

#include <optional>
#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/path/tool_path.h>
#include <beeline/planning/internal/knot_sequence.h>
#include <beeline/planning/internal/self_motion.h>

namespace beeline::internal {

/// The configurations of a motion along a path at one path parameter: curves of self-motion, whose
/// nodes are numbered from curve to curve.
struct SelfMotionLayer {
  using Place = SelfMotionCurves::Place;
  static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

  double s = 0;
  std::vector<SelfMotionCurve> curves;
  std::vector<std::size_t> first;        ///< of each curve: the number of its first node
  std::vector<double> margin;            ///< of each node: SelfMotion::margin()
  std::vector<double> clearance_margin;  ///< of each node: GraphOptions::clearance_margin()
  std::vector<Place> continuation;       ///< of each node, in the next layer; curve `nowhere`: none

  /// Nodes count as blocked from where the budget ends.
  SelfMotionLayer(double at, std::vector<SelfMotionCurve> of, const SelfMotion& motion,
                  const GraphOptions& options, BudgetMeter& budget);
  std::size_t size() const { return margin.size(); }
  const RedundantConfiguration& node(std::size_t i) const;
};

/// Computes all configurations within the limits that a motion along a path can reach, for an arm
/// with one joint more than the task has rows. As a motion along the path may be arbitrarily slow,
/// it can reach a whole curve of self-motion if it can reach one configuration of it.
///
/// - The first layer has the start, or all curves at the path's beginning (self_motion_starts()).
/// - Newton's method continues the nodes of a layer to the next path parameter; the next layer has
///   the curves through the continuations within limits.
/// - Where none is within limits, the margin is maximised along the curve. Where no curve
///   continues, or Newton's method loses one, the step is halved. So the last layer is where the
///   last curve shrinks to a point between limits, or where all are singular.
/// - Segments at rest in the task's rows have no layers.
class SelfMotionSweep {
 public:
  /// Coordinates in `cyclic` are taken for angles without limits. The first layer has the start, if
  /// there is one. Keeps references to the arm, the path, the options and the meter.
  SelfMotionSweep(const Arm& arm, const ToolPath& path, const GraphOptions& options,
                  const std::vector<bool>& cyclic, BudgetMeter& budget);

  /// Computes the layers; returns whether they reach the path's end.
  bool run();

  const std::vector<SelfMotionLayer>& layers() const { return layers_; }
  const SelfMotion& motion() const { return motion_; }

 private:
  struct Continued {
    std::vector<RedundantConfiguration> q;
    std::vector<std::size_t> node;  ///< that each continues
    bool lost = false;              ///< a curve may continue that has no q
  };

  void add_first();
  bool add_layers(double s, double end, double regular);
  Continued continued_to(const Pose& pose);
  void continue_curve(const Pose& pose, std::size_t c, Continued& continued);
  void add(double s, const Pose& pose, const Continued& continued);

  const Arm& arm_;
  const ToolPath& path_;
  const GraphOptions& options_;
  SelfMotion motion_;
  BudgetMeter& budget_;
  std::vector<SelfMotionLayer> layers_;
};

}  // namespace beeline::internal
