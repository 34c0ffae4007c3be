#pragma once

#include <optional>

#include <beeline/certificate/internal/interval_deviation.h>
#include <beeline/kinematics/internal/taylor_bound.h>
#include <beeline/kinematics/task.h>
#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/path/segment.h>

namespace beeline::internal {

/// A vector or matrix with its first and second derivative.
template <class Value>
struct Jet {
  Value value = Value::Zero(), first = Value::Zero(), second = Value::Zero();

  void rescale(double k) {  // the new parameter is 1 / k times the old one
    first *= k;
    second *= k * k;
  }
};

/// The error e of interval_deviation.h: a position in metres, and a difference of rotation
/// matrices. Only the rows or columns of the task count.
struct ToolError {
  Jet<Vector3> position;
  Jet<Eigen::Matrix3d> orientation;

  void rescale(double k) {
    position.rescale(k);
    orientation.rescale(k);
  }
};

/// The rows of a task for which the tool's error along a segment is bounded.
class ToolErrorRows {
 public:
  ToolErrorRows(const Arm& arm, const Segment& segment, const Task& task);

  ToolError at(const PoseMotion& tool, const PoseMotion& path) const;

  /// Returns `factor` times the sixth Taylor bounds of the error, from the bounds of the distance
  /// between the origins and of both rotation matrices.
  Deviation remainder(const TaylorBound& distance, const TaylorBound& tool, const TaylorBound& path,
                      double factor) const;

  /// Further quantities in the bound, over the whole interval.
  struct Range {
    double angle = 0;  ///< bound of the angle between the orientations, free rows included
    double s_min = 0, s_max = 1;  ///< range of s(u)
    double row_length = 0;  ///< the least length of a line in the task's position rows, metres
  };

  /// Bounds the deviation on an interval with these errors at its ends. On a line the deviation is
  /// measured from the nearest point (nearest_on_line.h), whose parameter is not s(u).
  Deviation bound(const ToolError& a, const ToolError& b, const Deviation& remainder,
                  const Range& range) const;

  /// Whether the segment is a line by position whose rows do not rotate. Then the error along the
  /// line does not count in bound(), and the tool has a projection on the line.
  bool projects() const { return !direction_.isZero(0); }

  /// Returns the distance along such a line at which its pose changes by the tolerance, metres;
  /// infinite for other segments.
  double along_tolerance(const Deviation& tolerance) const;

  /// Returns the tool's projection on such a line to within `error` metres, on an interval with
  /// these errors from its pose at s(u).
  LineProjection projection(const Polynomial& s, const ToolError& a, const ToolError& b,
                            double error) const;

 private:
  /// The form of the orientation error.
  enum class Orientation {
    none,
    whole,  ///< R - P
    axis,   ///< (R - P) e, or the same for the transposes: the orientation row along e is free
    rotation_row  ///< the antisymmetric part of the relative rotation: two rows are free
  };

  double orientation_bound(double chord, double angle) const;
  Deviation at_nearest(const Deviation& at_s, double along, const Range& range) const;

  Task task_;
  bool rotating_rows_ = false;  ///< some position rows are free, in tool axes
  Orientation orientation_ = Orientation::none;
  int row_ = 0;  ///< the free row (axis), or the only row (rotation_row)
  std::optional<LineExtent> line_;
  Vector3 direction_ =
      Vector3::Zero();  ///< direction of a line by position whose rows do not rotate
};

}  // namespace beeline::internal
