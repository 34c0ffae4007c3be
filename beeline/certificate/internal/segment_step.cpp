#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/certificate/internal/chord_bound.h>
#include <beeline/certificate/internal/segment_chord.h>
#include <beeline/certificate/internal/segment_step.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>

namespace beeline {
namespace {

/// The tool and the segment both stand upright all the way.
bool planar(const Arm& arm, const Segment& segment) {
  constexpr double tilt = 1e-9;
  const Rotation r = pose_at(segment, 0).linear();
  return arm.planar() && turns_about_z(segment) && r.col(2).head<2>().norm() <= tilt && r(2, 2) > 0;
}

/// Most of the angle f between the tool's orientation and the segment's, which at the ends is
/// `ends` at most. Between two shortest turns in SO(3), a sphere of radius 2, the distance exceeds
/// that of their ends by 1 / cos(angle/4) at most (Jacobi's equation): that is one bound. The other
/// needs f < pi, as it is where half of either turn and `ends` do not come to it.
double turn_between(const ChordBound& tool, const SegmentChordBound& way, double ends) {
  using std::numbers::pi;
  const double angle = tool.turned + 2 * ends, most = std::max(tool.turned, way.turned);
  double bound = pi;
  if (angle < pi) bound = ends / std::cos(angle / 4) + tool.orientation + way.orientation;
  if (most + ends < pi) {
    const double swing = (tool.swing - way.swing).norm() + tool.swing_rest + way.swing_rest;
    const double k = most * std::numbers::inv_sqrtpi;
    bound = std::min(bound, ends / std::cos(k / 2) + orientation_bound(swing, most));
  }
  return std::min(bound, pi);
}

}  // namespace

Deviation matched_step_bound(const Arm& arm, const Segment& segment, const Task& task,
                             const StepEnd& a, const StepEnd& b) {
  const ChordBound tool = chord_bound(arm, a.q, b.q);
  const SegmentChordBound way = segment_chord_bound(segment, a.s, b.s);
  Deviation bound;
  if (task.positions() > 0) {
    bound.position = std::max(a.off.position, b.off.position) +
                     std::min(tool.position + way.position,
                              (tool.bend - way.bend).norm() + tool.rest + way.rest);
  }
  if (task.orientations() > 0) {
    const double ends = std::max(a.off.orientation, b.off.orientation);
    bound.orientation = turn_between(tool, way, ends);
  }
  return bound;
}

void check_matched(const Arm& arm, const Segment& segment, const Task& task) {
  const int positions = task.positions(), turns = task.orientations();
  const bool whole =
      turns % 3 == 0 || (task.rows[5] && task.frame == Frame::base && planar(arm, segment));
  if (task.frame == Frame::space || !whole || (positions % 3 != 0 && task.frame != Frame::base)) {
    throw Error(
        "the task " + name(task) +
        " is followed along straight lines alone: other segments need all orientation rows or "
        "none, and position rows in the base's axes; a planar arm its rows in the plane");
  }
}

}  // namespace beeline
