#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/kinematics/jacobian.h>

namespace beeline {

/// Which components of the tool's motion matter, in the order [x y z wx wy wz] and in the axes of
/// `frame` (base or tool).
struct Task {
  std::array<bool, 6> rows{true, true, true, true, true, true};
  Frame frame = Frame::base;

  static Task spatial() { return {}; }
  static Task position() { return {{true, true, true, false, false, false}}; }
  static Task planar() { return {{true, true, false, false, false, true}}; }
  bool operator==(const Task&) const = default;

  int size() const;                                                 ///< how many rows matter
  int positions() const { return rows[0] + rows[1] + rows[2]; }     ///< of them
  int orientations() const { return rows[3] + rows[4] + rows[5]; }  ///< of them
};

/// Throws Error unless poses can be compared by the task: it has a row, in the axes of the base or
/// of the tool.
void check_task(const Task& task);

/// `spatial`, `position`, `planar`, or a mask such as `111110`; with `:tool` behind it the rows are
/// those of the tool's axes (`111110:tool` leaves the turn about the tool's own z free).
/// Throws Error for anything else and for a mask without a row.
Task task_named(std::string_view name);
std::string name(const Task& task);

/// planar for a planar arm, spatial for all others.
Task default_task(const Arm& arm);

/// The names of the task's Jacobian rows: `x, y, theta` for planar, else of `vx vy vz wx wy wz`.
std::vector<std::string> row_names(const Task& task);

/// The task's rows of the Jacobian in the task's frame, its linear rows divided by `length_unit`
/// metres: so scaled, metres and radians compare in a condition number.
Eigen::MatrixXd task_jacobian(const Arm& arm, const ConfigurationRef& q, const Task& task,
                              double length_unit = 1);

/// What leads from `current` to `desired`, linear first, in the axes of `frame`: base, or tool for
/// those of `current`.
Twist pose_error(const Pose& desired, const Pose& current, Frame frame);

/// The task's rows of what leads from `current` to `desired`: the chapter's E (section 1.8), with
/// the orientation's part the shortest rotation vector, of length at most pi.
Eigen::VectorXd task_error(const Task& task, const Pose& desired, const Pose& current);

/// The rows of a twist that the task has, in its order.
Eigen::VectorXd task_rows(const Task& task, const Twist& twist);

/// All six rows, those that the task does not have set to zero; of a position its three.
Twist masked(const Task& task, Twist twist);
Vector3 masked_position(const Task& task, Vector3 position);
void mask_rows(const Task& task, Eigen::Ref<Jacobian> columns);

/// The lengths of the linear and the angular part of what matters, metres and radians.
struct Deviation {
  double position = 0;
  double orientation = 0;
};
Deviation task_deviation(const Task& task, const Pose& desired, const Pose& current);

/// Makes `largest` no less than what was met.
inline void grow(Deviation& largest, const Deviation& met) {
  largest.position = std::max(largest.position, met.position);
  largest.orientation = std::max(largest.orientation, met.orientation);
}

/// Neither part is above that of the tolerance.
inline bool within(const Deviation& deviation, const Deviation& tolerance) {
  return deviation.position <= tolerance.position && deviation.orientation <= tolerance.orientation;
}

}  // namespace beeline
