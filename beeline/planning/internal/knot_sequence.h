#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/numerical/bounds.h>
#include <beeline/path/joint_path.h>
#include <beeline/path/tool_path.h>
#include <beeline/planning/branch.h>

namespace beeline::internal {

/// A configuration at a path parameter s: whole segments, with a fraction of the next.
struct Knot {
  double s = 0;
  Configuration q;
};

/// Work of one evaluation of BranchOptions::spare_clearance.
constexpr std::int64_t spare_clearance_work = 8;

/// The options of a search for knots in a graph of configurations along a path.
struct GraphOptions {
  Task task;
  std::optional<Configuration> start = std::nullopt;  ///< the first knot; default: any
  double spacing = 0.06;                              ///< of the layers, as weighted_length()
  double step = 0.15;  ///< of the nodes along a self-motion, radians or metres
  int grid =
      16;  ///< of a layered graph: solutions per pose, values of a redundant joint x branches
  std::function<double(const ConfigurationRef&)> spare_clearance = {};  ///< see BranchOptions
  Budget budget = {};

  /// The spare clearance of a configuration as a margin comparable with limit_margin(), negative
  /// where it is blocked; infinite without `spare_clearance`.
  double clearance_margin(const ConfigurationRef& q) const;
  /// The same within a budget; nothing if it has ended.
  std::optional<double> clearance_margin(const ConfigurationRef& q, BudgetMeter& budget) const;
};

struct KnotSequence {
  std::vector<Knot> knots;  ///< one per layer, as far as the path can be reached
  bool complete = false;
};

/// The costs of knots and of the steps between them, seconds squared:
///     c(q) = w sum_k 1 / (m_k + 0.02)   with the margins m_k of the joints to their limits and,
///                                       as one of them, the clearance margin,
///     d(p, q) = sum_k ((q_k - p_k) / v_k)^2   with the velocity limits v_k.
struct KnotCosts {
  Eigen::VectorXd seconds_per_unit;  ///< 1 / v_k: seconds per radian or metre
  Bounds bounds;

  explicit KnotCosts(const Arm& arm);
  double node(const ConfigurationRef& q, double clearance_margin) const;
  double edge(const ConfigurationRef& step) const;  ///< of a step q - p
};

/// Returns the configuration nearest to `guess` with the tool at `pose`, by damped least squares.
std::optional<Configuration> solved_near(const Arm& arm, const Pose& pose, const Task& task,
                                         const Bounds& bounds, const Configuration& guess);

/// The length of the tool's path along a segment, by chords, in units of unit_of_length(arm), with
/// a fifth of the unit for each radian that the tool rotates. It does not depend on the unit of
/// length of the arm and the path.
double weighted_length(const Arm& arm, const Segment& segment);

/// Returns the path parameters of a graph's layers after the first layer, which is at 0. They are
/// at most `spacing` apart, as weighted_length(), with at least four for each segment. Short
/// segments without a corner between them have fewer: their layers are at least an eighth of the
/// spacing apart. Segments that are at rest in the task's rows have none.
std::vector<double> layer_parameters(const Arm& arm, const ToolPath& path, const Task& task,
                                     double spacing);

/// Smooths the knots, except a given start, in the null space: moves each towards the line between
/// its neighbours and away from the joint limits, then restores the tool's pose by damped least
/// squares. Each keeps this margin to the joint limits (see limit_margin()) and this clearance
/// margin, or its own if smaller.
void smooth_knots(const Arm& arm, const ToolPath& path, const GraphOptions& options, double margin,
                  BudgetMeter& budget, std::vector<Knot>& knots);

/// Interpolates knots, as a guide for track_segment(): cubic splines in span_to() (joint_spline()),
/// from corner to corner of the path.
class KnotSpline {
 public:
  KnotSpline(const std::vector<Knot>& knots, const ToolPath& path);
  Configuration at(double s) const;

 private:
  double span_at(double s) const;

  ToolPath path_;
  std::vector<double> spans_;  ///< to the beginning of each segment
  Configuration first_;
  std::vector<JointPath> parts_;
};

}  // namespace beeline::internal
