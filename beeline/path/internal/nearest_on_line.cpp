#include <algorithm>
#include <cmath>
#include <numeric>

#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/pose/angle.h>

namespace beeline {
namespace {

/// Only the turn about the line's own axis leads along it: the twist of a swing and a twist. The
/// line is an arc of a circle, centred at half its angle.
double fraction_by_turn(const Line& line, const LineExtent& extent, const Pose& pose) {
  const Eigen::Quaterniond done(pose.linear() * line.from.linear().transpose());
  const double twist = 2 * std::atan2(done.vec().dot(extent.turn) / extent.angle, done.w());
  return std::clamp(wrap_angle(twist - extent.angle / 2) / extent.angle + 0.5, 0.0, 1.0);
}

/// With orientation rows left free there is no closed form: a scan, then thirds.
double fraction_by_search(const Line& line, const Pose& pose, const Task& task) {
  constexpr int scan = 64, refinements = 90;
  const auto left = [&](double s) {
    return task_deviation(task, interpolate(line.from, line.to, s), pose).orientation;
  };
  double best = 0, least = left(0);
  for (int i = 1; i <= scan; ++i) {
    const double here = left(double(i) / scan);
    if (here < least) best = double(i) / scan, least = here;
  }
  double low = std::max(0.0, best - 1.0 / scan), high = std::min(1.0, best + 1.0 / scan);
  for (int i = 0; i < refinements; ++i) {
    const double third = (high - low) / 3;
    if (left(low + third) < left(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  const double refined = std::midpoint(low, high);
  return left(refined) < least ? refined : best;
}

}  // namespace

LineExtent extent_of(const Line& line, const Task& task) {
  const Twist whole = pose_difference(line.to, line.from);
  LineExtent extent{whole.head<3>(), whole.tail<3>()};
  if (task.frame == Frame::base) extent.way = in_position_rows(task, line.from, extent.way);
  if (task.positions() == 0) extent.way.setZero();
  if (task.orientations() == 0) extent.turn.setZero();
  extent.length = extent.way.norm();
  extent.angle = extent.turn.norm();
  return extent;
}

Vector3 in_position_rows(const Task& task, const Pose& pose, const Vector3& v) {
  if (task.positions() == 3) return v;
  return masked_position(task,
                         task.frame == Frame::tool ? Vector3(pose.linear().transpose() * v) : v);
}

bool turns_within_rows(const Task& task, const Vector3& turn) {
  constexpr double tilt = 1e-9;
  if (task.orientations() == 3) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!task.rows[3 + i] && std::abs(turn[static_cast<int>(i)]) > tilt) return false;
  }
  return task.frame == Frame::base;
}

double nearest_fraction(const Line& line, const Pose& pose, const Task& task) {
  const LineExtent extent = extent_of(line, task);
  if (extent.told_by_way()) {
    const Vector3 way = in_position_rows(task, pose, extent.way);
    const Vector3 done = in_position_rows(task, pose, pose.translation() - line.from.translation());
    if (way.norm() > LineExtent::nothing) {
      return std::clamp(done.dot(way) / way.squaredNorm(), 0.0, 1.0);
    }
  }
  if (!extent.told_by_turn()) return 1;
  const Vector3 done = pose_difference(pose, line.from).tail<3>();
  const bool whole = turns_within_rows(task, extent.turn) && turns_within_rows(task, done);
  return whole ? fraction_by_turn(line, extent, pose) : fraction_by_search(line, pose, task);
}

Pose nearest_on(const Line& line, const Pose& pose, const Task& task) {
  return interpolate(line.from, line.to, nearest_fraction(line, pose, task));
}

Deviation deviation_from(const Line& line, const Pose& pose, const Task& task) {
  return task_deviation(task, nearest_on(line, pose, task), pose);
}

}  // namespace beeline
