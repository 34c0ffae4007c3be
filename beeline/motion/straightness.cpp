#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/motion/chord.h>
#include <beeline/motion/straightness.h>
#include <beeline/pose/angle.h>

namespace beeline {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double way_of_a_radian = 0.01;  // metres: a line that moves less is told by its turn
constexpr double nothing = 1e-12;         // metres or radians that count as none

/// How many of the task's three position rows (first = 0) or orientation rows (3) matter.
int rows(const Task& task, std::size_t first) {
  return task.rows[first] + task.rows[first + 1] + task.rows[first + 2];
}

/// The position rows turn with the tool, and some of them do not matter.
bool turning_rows(const Task& task) {
  return task.frame == Frame::tool && rows(task, 0) > 0 && rows(task, 0) < 3;
}

/// Nothing of the turn is in rows that do not matter: so it is for planar arms.
bool turns_within_rows(const Task& task, const Vector3& turn) {
  constexpr double tilt = 1e-9;
  if (rows(task, 3) == 3) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!task.rows[3 + i] && std::abs(turn[static_cast<int>(i)]) > tilt) return false;
  }
  return task.frame == Frame::base;
}

/// The way that a vector has in the position rows that matter, for a tool at `pose`.
Vector3 position_rows(const Task& task, const Pose& pose, const Vector3& v) {
  if (rows(task, 0) == 3) return v;
  Vector3 kept = task.frame == Frame::tool ? Vector3(pose.linear().transpose() * v) : v;
  for (int i = 0; i < 3; ++i) {
    if (!task.rows[static_cast<std::size_t>(i)]) kept[i] = 0;
  }
  return kept;
}

/// A line as far as the task asks.
struct Extent {
  Vector3 way, turn;  ///< in the world's axes; zero when no row of the kind matters
  double length = 0;  ///< metres; in base axes of the rows that matter alone
  double angle = 0;   ///< radians
  bool told_by_way() const { return length > nothing && length >= way_of_a_radian * angle; }
  bool told_by_turn() const { return !told_by_way() && angle > nothing; }
};

Extent extent_of(const Line& line, const Task& task) {
  const Twist whole = pose_difference(line.to, line.from);
  Extent extent{whole.head<3>(), whole.tail<3>()};
  if (task.frame == Frame::base) extent.way = position_rows(task, line.from, extent.way);
  if (rows(task, 0) == 0) extent.way.setZero();
  if (rows(task, 3) == 0) extent.turn.setZero();
  extent.length = extent.way.norm();
  extent.angle = extent.turn.norm();
  return extent;
}

/// Only the turn about the line's own axis leads along it: the twist of a swing and a twist. The
/// line is an arc of a circle, centred at half its angle.
double fraction_by_turn(const Line& line, const Extent& extent, const Pose& pose) {
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

double nearest_fraction(const Line& line, const Extent& extent, const Pose& pose,
                        const Task& task) {
  if (extent.told_by_way()) {
    const Vector3 way = position_rows(task, pose, extent.way);
    const Vector3 done = position_rows(task, pose, pose.translation() - line.from.translation());
    if (way.norm() > nothing) return std::clamp(done.dot(way) / way.squaredNorm(), 0.0, 1.0);
  }
  if (!extent.told_by_turn()) return 1;
  const Vector3 done = pose_difference(pose, line.from).tail<3>();
  const bool whole = turns_within_rows(task, extent.turn) && turns_within_rows(task, done);
  return whole ? fraction_by_turn(line, extent, pose) : fraction_by_search(line, pose, task);
}

/// Where the nearest point is not moved by what a step of both ends in proportion tells, it is at
/// the fraction s' in proportion between those of the two ends. What is known of them:
struct Ends {
  Deviation deviation;   ///< the larger one
  double slack = 1;      ///< two turns with such ends part by at most 1 / slack of it between them
  double apart = 0;      ///< between their fractions
  double off = 0;        ///< metres from their points of the line, rows that do not matter counted
  double along = 0;      ///< least length of the line in the rows that matter during the step
};

}  // namespace
