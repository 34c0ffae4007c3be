#pragma once

#include <algorithm>
#include <array>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>
#include <beeline/kinematics/jacobian.h>

namespace beeline {

/// The components of the tool's motion that a task constrains, in the order [x y z wx wy wz] and in
/// the axes of `frame`: base, which are the world's, or tool.
struct Task {
  std::array<bool, 6> rows{true, true, true, true, true, true};
  Frame frame = Frame::base;

  static Task spatial() { return {}; }
  static Task position() { return {{true, true, true, false, false, false}}; }
  static Task planar() { return {{true, true, false, false, false, true}}; }
  bool operator==(const Task&) const = default;

  int size() const;                                                 ///< number of rows
  int positions() const { return rows[0] + rows[1] + rows[2]; }     ///< linear rows
  int orientations() const { return rows[3] + rows[4] + rows[5]; }  ///< angular rows
};

/// Throws Error for a task without rows, or in Frame::space.
void check_task(const Task& task);

/// Returns the task of a name:
/// - `spatial`, `position`, `planar`;
/// - `direction`: position and direction of the tool's z axis, about which the tool may rotate;
///   `direction:x` and `direction:y` for its other axes. They are the
///   masks 111110:tool, 111011:tool and 111101:tool;
/// - `approach:xy`, `approach:xz`, `approach:yz`: position and orientation, except for rotation
///   about the normal of this plane of the world. An axis of the tool that lies in the plane stays
///   in it; every axis keeps its angle to it. They are 111110, 111101 and 111011;
/// - a mask such as `111010`, of a planar arm also one of x, y, theta such as `110`.
/// The suffix `:tool`, after a mask or one of the first three names, selects the tool's axes.
/// Throws Error for another name and for a mask without rows. name() is the inverse.
Task task_named(std::string_view name);
/// The same for an arm. Throws Error for a mask of three digits, x, y, theta, if the arm is not
/// planar.
Task task_named(std::string_view name, const Arm& arm);
std::string name(const Task& task);
std::ostream& operator<<(std::ostream& out, const Task& task);  ///< prints name()

/// The planar task for a planar arm, the spatial one for all others.
Task default_task(const Arm& arm);

/// The names of the task's rows: `x, y, theta` for the planar task, else some of `vx vy vz wx wy
/// wz`.
std::vector<std::string> row_names(const Task& task);

/// The task's rows of the Jacobian in the task's frame, its linear rows divided by `length_unit`
/// metres: so scaled, metres and radians compare in a condition number.
Eigen::MatrixXd task_jacobian(const Arm& arm, const ConfigurationRef& q, const Task& task,
                              double length_unit = 1);
/// The same for default_task(): the planar rows of a planar arm, all six rows of any other arm.
Eigen::MatrixXd task_jacobian(const Arm& arm, const ConfigurationRef& q);

/// Returns pose_difference(desired, current) in the axes of `frame`: base for the axes of the
/// world, tool for the axes of `current`.
Twist pose_error(const Pose& desired, const Pose& current, Frame frame);

/// The task's rows of pose_error(), the error E of the chapter's section 1.8. Its angular part is a
/// rotation vector of length at most pi.
Eigen::VectorXd task_error(const Task& task, const Pose& desired, const Pose& current);

/// The task's rows of a matrix that has all six, such as a Jacobian.
Eigen::MatrixXd selected_rows(const Task& task, const Eigen::Ref<const Jacobian>& columns);

/// The task's rows of a twist.
Eigen::VectorXd task_rows(const Task& task, const Twist& twist);

/// Norms of the linear and the angular part of a task error.
struct Deviation {
  double position = 0;     ///< metres
  double orientation = 0;  ///< radians
};
std::ostream& operator<<(std::ostream& out, const Deviation& deviation);  ///< `1e-05 m, 0.002 rad`

/// Formats a deviation for a sentence: `1e-05 m and 0.002 rad (0.114592 deg)`.
std::string deviation_text(const Deviation& deviation);

/// The norms of task_error()'s two parts.
Deviation task_deviation(const Task& task, const Pose& desired, const Pose& current);

/// Replaces each part of `largest` by the larger of both.
inline void grow(Deviation& largest, const Deviation& other) {
  largest.position = std::max(largest.position, other.position);
  largest.orientation = std::max(largest.orientation, other.orientation);
}

/// Whether neither part of the deviation exceeds the same part of the tolerance.
inline bool within(const Deviation& deviation, const Deviation& tolerance) {
  return deviation.position <= tolerance.position && deviation.orientation <= tolerance.orientation;
}

}  // namespace beeline
