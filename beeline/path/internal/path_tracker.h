#pragma once

#include <optional>
#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/kinematics/task.h>
#include <beeline/path/tool_path.h>

namespace beeline::internal {

/// Finds the path parameters that belong to poses of the tool, in the part of a path from one path
/// parameter to another. The distance is measured in the rows that the task constrains, with
/// rotations weighted by metres_per_radian.
///
/// The part is divided into cells, in each of which the path turns by less than a right angle or is
/// shorter than a twentieth of the tolerance: the distance from a pose within the tolerance has one
/// minimum there, or several that differ by less than a twentieth of the tolerance. On a single
/// line the minimum is its nearest point (nearest_on_line.h).
class PathTracker {
 public:
  /// Keeps a reference to the path. If the budget ends the construction, the tracker cannot be
  /// used.
  PathTracker(const ToolPath& path, const Task& task, double from, double to,
              const Deviation& tolerance, BudgetMeter& budget = unlimited());

  /// Returns the first local minimum of the distance from `from` on; `from` itself if the distance
  /// increases there.
  double nearest(const Pose& pose, double from) const;

  /// The first local minimum from `from` on, at most two segments further, at which the pose is
  /// within the tolerance. Position and orientation may be nearest at different parameters; a
  /// parameter near the minimum is then accepted.
  std::optional<double> first_fit(const Pose& pose, double from) const;

  /// The first parameter from `from` on, at most two segments further, at which the pose is within
  /// the tolerance, to a sixtieth of the way from `from` to the first fit.
  std::optional<double> first_within(const Pose& pose, double from) const;

  /// The last one from `from` back to `to`; `to` if there is none between.
  double last_within(const Pose& pose, double from, double to) const;

  /// All local minima in [from, to] at which the pose is within the tolerance, in order; at most
  /// eight.
  std::vector<double> fits(const Pose& pose, double from, double to) const;

  bool within_tolerance(const Pose& pose, double s) const { return excess(pose, s) <= 1; }

  /// The length of the path between two parameters, rotations weighted, by the chords of the cells.
  double length(double from, double to) const;

  Pose pose(double s) const;  ///< of the path

  /// The distance of two poses in the rows of the task.
  double distance(const Pose& a, const Pose& b) const;

 private:
  struct NearPoint {
    double s = 0, distance = 0;
    double resume = 0;  ///< where to seek the next one
  };

  void divide(double a, double b, int depth);
  double distance_at(const Pose& pose, double s) const;
  double excess(const Pose& pose, double s) const;
  double slope(const Pose& pose, double s, double beside) const;
  double next_node(double s, bool up, double end) const;
  std::optional<NearPoint> minimum(const Pose& pose, double from, double end, bool start) const;
  double refined(const Pose& pose, double a, double b) const;
  std::optional<double> fit(const Pose& pose, double from, double end, double farthest,
                            double& resume, bool start) const;
  std::optional<double> fit_near(const Pose& pose, const NearPoint& at, double low,
                                 double high) const;
  double boundary(const Pose& pose, double outside, double inside) const;

  const ToolPath& path_;
  Task task_;
  double to_;
  Deviation tolerance_;
  std::vector<double> nodes_, lengths_;  ///< ends of the cells, and the path's length up to them
};

}  // namespace beeline::internal
