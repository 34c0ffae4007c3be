#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/certificate/internal/chord_bound.h>
#include <beeline/certificate/internal/matched_step.h>
#include <beeline/certificate/internal/orientation_gap.h>
#include <beeline/certificate/internal/path_checks.h>
#include <beeline/certificate/internal/segment_chord_bound.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {
namespace {

/// Bounds the angle f between the orientations of tool and segment; `ends` bounds it at both ends.
///
/// First bound: between two shortest rotations in SO(3), locally a sphere of radius 2, the distance
/// exceeds the larger distance between their ends by at most the factor 1 / cos(angle/4) (Jacobi's
/// equation); each motion's own distance from its chord is added. Second bound, if f < pi is
/// certain: orientation_gap().
double orientation_between(const ChordBound& tool, const SegmentChordBound& segment, double ends) {
  using std::numbers::pi;
  const double angle = tool.rotation + 2 * ends;
  const double rotation = std::max(tool.rotation, segment.rotation);
  double bound = pi;
  if (angle < pi) bound = ends / std::cos(angle / 4) + tool.orientation + segment.orientation;
  if (rotation + ends < pi) {
    const double angular_acceleration =
        (tool.angular_acceleration - segment.angular_acceleration).norm() + tool.angular_remainder +
        segment.angular_remainder;
    const double k = rotation * std::numbers::inv_sqrtpi;
    bound =
        std::min(bound, ends / std::cos(k / 2) + orientation_gap(angular_acceleration, rotation));
  }
  return std::min(bound, pi);
}

}  // namespace

Deviation matched_step_bound(const Arm& arm, const Segment& segment, const Task& task,
                             const StepEnd& a, const StepEnd& b) {
  const ChordBound tool = chord_bound(arm, a.q, b.q);
  const SegmentChordBound wanted = segment_chord_bound(segment, a.s, b.s);
  Deviation bound;
  if (task.positions() > 0) {
    bound.position = std::max(a.deviation.position, b.deviation.position) +
                     std::min(tool.position + wanted.position,
                              (tool.curvature_term - wanted.curvature_term).norm() +
                                  tool.remainder + wanted.remainder);
  }
  if (task.orientations() > 0) {
    const double ends = std::max(a.deviation.orientation, b.deviation.orientation);
    bound.orientation = orientation_between(tool, wanted, ends);
  }
  return bound;
}

void check_matched(const Arm& arm, const Segment& segment, const Task& task) {
  const int positions = task.positions(), orientations = task.orientations();
  const bool all_or_none = orientations % 3 == 0 || (task.rows[5] && task.frame == Frame::base &&
                                                     all_rotate_about_z(arm, segment));
  if (task.frame == Frame::space || !all_or_none ||
      (positions % 3 != 0 && task.frame != Frame::base)) {
    throw Error("task " + name(task) +
                " is possible along straight lines only; along other segments a task has all "
                "orientation rows or none, and position rows in base axes (a planar arm: its rows "
                "in the plane)");
  }
}

}  // namespace beeline::internal
