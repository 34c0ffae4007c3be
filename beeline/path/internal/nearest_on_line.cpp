#include <algorithm>
#include <cmath>

#include <beeline/kinematics/internal/mask.h>
#include <beeline/math/minimise.h>
#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {
namespace {

/// The fraction from the rotation about the line's own axis: the twist of the swing-twist
/// decomposition. Rotations about the axis form a circle, of which the line is an arc, centred at
/// half its angle.
double fraction_by_rotation(const Line& line, const LineExtent& extent, const Pose& pose) {
  const Eigen::Quaterniond done(pose.linear() * line.from.linear().transpose());
  const double twist = 2 * std::atan2(done.vec().dot(extent.rotation) / extent.angle, done.w());
  return std::clamp(wrap_angle(twist - extent.angle / 2) / extent.angle + 0.5, 0.0, 1.0);
}

/// The same where some orientation rows are free: there is no closed form.
double fraction_by_search(const Line& line, const Pose& pose, const Task& task) {
  constexpr int intervals = 64, sections = 75;  // to rounding
  return scan_and_refine(
             0, 1, intervals, sections,
             [&](double s) {
               return task_deviation(task, interpolate(line.from, line.to, s), pose).orientation;
             })
      .x;
}

}  // namespace

LineExtent extent_of(const Line& line, const Task& task) {
  const Twist whole = pose_difference(line.to, line.from);
  LineExtent extent{whole.head<3>(), whole.tail<3>()};
  if (task.frame == Frame::base)
    extent.translation = in_position_rows(task, line.from, extent.translation);
  if (task.positions() == 0) extent.translation.setZero();
  if (task.orientations() == 0) extent.rotation.setZero();
  extent.length = extent.translation.norm();
  extent.angle = extent.rotation.norm();
  return extent;
}

Vector3 in_position_rows(const Task& task, const Pose& pose, const Vector3& v) {
  if (task.positions() == 3) return v;
  return masked_position(task,
                         task.frame == Frame::tool ? Vector3(pose.linear().transpose() * v) : v);
}

bool rotates_within_rows(const Task& task, const Vector3& rotation) {
  constexpr double tilt = 1e-9;
  if (task.orientations() == 3) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!task.rows[3 + i] && std::abs(rotation[static_cast<int>(i)]) > tilt) return false;
  }
  return task.frame == Frame::base;
}

double nearest_fraction(const Line& line, const Pose& pose, const Task& task) {
  const LineExtent extent = extent_of(line, task);
  if (extent.by_position()) {
    const Vector3 whole = in_position_rows(task, pose, extent.translation);
    const Vector3 done = in_position_rows(task, pose, pose.translation() - line.from.translation());
    if (whole.norm() > LineExtent::nothing) {
      return std::clamp(done.dot(whole) / whole.squaredNorm(), 0.0, 1.0);
    }
  }
  if (!extent.by_rotation()) return 1;
  const Vector3 done = pose_difference(pose, line.from).tail<3>();
  const bool whole = rotates_within_rows(task, extent.rotation) && rotates_within_rows(task, done);
  return whole ? fraction_by_rotation(line, extent, pose) : fraction_by_search(line, pose, task);
}

Pose nearest_on(const Line& line, const Pose& pose, const Task& task) {
  return interpolate(line.from, line.to, nearest_fraction(line, pose, task));
}

Deviation deviation_from(const Line& line, const Pose& pose, const Task& task) {
  return task_deviation(task, nearest_on(line, pose, task), pose);
}

}  // namespace beeline::internal
