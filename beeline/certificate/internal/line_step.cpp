#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/certificate/internal/chord_bound.h>
#include <beeline/certificate/internal/line_step.h>
#include <beeline/certificate/internal/orientation_gap.h>
#include <beeline/kinematics/forward.h>
#include <beeline/path/internal/nearest_on_line.h>

namespace beeline::internal {
namespace {

constexpr double pi = std::numbers::pi;

/// Whether the task's position rows rotate with the tool: they are in tool axes, and some are free.
bool rotating_rows(const Task& task) {
  return task.frame == Frame::tool && task.positions() > 0 && task.positions() < 3;
}

/// Whether all rotations of the arm and the line lie in rows of the task, or the task has no
/// orientation rows. Then the angle between orientations is a metric.
bool whole_rotations(const Arm& arm, const Line& line, const LineExtent& extent, const Task& task,
                     const ConfigurationRef& q) {
  if (task.orientations() % 3 == 0) return true;
  return arm.rotates_about_z() && rotates_within_rows(task, Vector3::UnitZ()) &&
         rotates_within_rows(task, extent.rotation) &&
         rotates_within_rows(task,
                             pose_difference(forward_kinematics(arm, q), line.from).tail<3>());
}

/// A step of the arm along a line, and the quantities in its bounds.
struct LineStep {
  LineExtent extent;
  ChordBound chord;
  Deviation ends = {};         ///< the larger deviation at both ends
  bool fixed_rows = true;      ///< the position rows do not rotate with the tool
  bool whole_rotation = true;  ///< see whole_rotations()
  /// Whether the nearest point stays inside the line. The component of curvature_term along the
  /// step then moves the tool along the line, not away from it.
  bool inside_line = false;
  Vector3 step = Vector3::Zero();       ///< step of the tool's origin, in the position rows
  Vector3 curvature = Vector3::Zero();  ///< chord.curvature_term in the position rows
  double beyond = 0;                    ///< the larger beyond_ends() of both ends of the step
  double change = 0;                    ///< |s_b - s_a|
  double distance = 0;  ///< the larger distance between the origins of tool and line at s_a and s_b
  double full_angle = 0;  ///< angle between the orientations there, free rows included
  double length = 0;      ///< least length of the line in the position rows, metres
};

/// The distance of the tool's projection beyond the line's ends, as a fraction of its length.
double beyond_ends(const Line& line, const LineExtent& extent, const Pose& pose, const Task& task) {
  const Vector3 moved = in_position_rows(task, pose, pose.translation() - line.from.translation());
  const double s = moved.dot(extent.translation) / extent.translation.squaredNorm();
  return std::max({0.0, -s, s - 1});
}

/// Fills in the members for tasks whose rows rotate with the tool or leave rotations free.
void measure_ends(LineStep& step, const Line& line, const Task& task, const Pose& at_a,
                  const Pose& at_b) {
  const double s_a = nearest_fraction(line, at_a, task), s_b = nearest_fraction(line, at_b, task);
  step.change = std::abs(s_b - s_a);
  for (const auto& [pose, s] : {std::pair{at_a, s_a}, {at_b, s_b}}) {
    const Pose nearest = interpolate(line.from, line.to, s);
    step.distance = std::max(step.distance, (nearest.translation() - pose.translation()).norm());
    step.full_angle = std::max(step.full_angle, pose_difference(nearest, pose).tail<3>().norm());
  }
  if (step.fixed_rows) return;
  const double length = in_position_rows(task, at_a, step.extent.translation).norm();
  step.length = length - step.extent.length * step.chord.rotation;
}

LineStep line_step(const Arm& arm, const Line& line, const Task& task, const ConfigurationRef& q_a,
                   const ConfigurationRef& q_b) {
  LineStep step{.extent = extent_of(line, task), .chord = chord_bound(arm, q_a, q_b)};
  step.fixed_rows = !rotating_rows(task);
  step.whole_rotation = whole_rotations(arm, line, step.extent, task, q_a);
  step.length = step.extent.length;
  const Pose at_a = forward_kinematics(arm, q_a), at_b = forward_kinematics(arm, q_b);
  step.step = in_position_rows(task, at_a, at_b.translation() - at_a.translation());
  step.curvature = in_position_rows(task, at_a, step.chord.curvature_term);
  if (step.extent.by_position()) {
    const double moved = step.step.norm();
    step.inside_line =
        step.fixed_rows && moved > LineExtent::nothing &&
        4 * std::abs(step.curvature.dot(step.step)) / moved + 6 * step.chord.remainder <= moved;
    step.beyond = std::max(beyond_ends(line, step.extent, at_a, task),
                           beyond_ends(line, step.extent, at_b, task));
  }
  if (!step.fixed_rows || !step.whole_rotation) measure_ends(step, line, task, at_a, at_b);
  return step;
}

/// Bounds the deviation in position from the line's point at s'.
double position_bound(const LineStep& step, const Task& task) {
  if (!step.fixed_rows) {  // at most half of all motion away from the nearer end
    return step.ends.position + (step.chord.path_length + step.extent.length * step.change +
                                 step.distance * step.chord.rotation) /
                                    2;
  }
  if (task.positions() == 0) return step.ends.position;
  // The distance from a straight segment is convex.
  if (!step.inside_line) return step.ends.position + step.chord.position;
  const Vector3 across =
      step.curvature - step.curvature.dot(step.step) / step.step.squaredNorm() * step.step;
  return step.ends.position + std::min(step.chord.position, across.norm() + step.chord.remainder);
}

/// Bounds the angle as ChordBound::orientation does, but relative to the line's orientation at the
/// point nearest by position. Its parameter s satisfies s'' = p'' . d / |d|^2 with the line's
/// translation d. The angular acceleration of the line is expressed in the tool's axes, which
/// rotate by at most ChordBound::rotation.
double orientation_at_nearest(const LineStep& step) {
  const LineExtent& extent = step.extent;
  const ChordBound& chord = step.chord;
  const double square = extent.length * extent.length;
  const double acceleration = 8 * chord.curvature_term.dot(extent.translation) / square;  // s''
  const double angular_acceleration =
      (chord.angular_acceleration - acceleration * extent.rotation).norm() +
      chord.angular_remainder +
      extent.angle * (8 * chord.remainder / extent.length +
                      std::abs(acceleration) * (chord.rotation + step.ends.orientation));
  return orientation_gap(angular_acceleration, chord.rotation);
}

/// Bounds the rotation in the two constrained rows, for a task with one free orientation row along
/// an axis e of its frame. The rotation is at most f / (2 sin(f/2)) times the distance of the
/// tool's e from the line's e, where f is the whole angle. |e''| is bounded as p'' is for
/// positions: |w'| + |w|^2 <= 3/2 rotation^2 for the tool, and `line_rotation`^2 for the line.
double bound_with_free_row(const LineStep& step, double line_rotation) {
  const double rotation = step.chord.rotation;
  const double f = std::min(pi, step.full_angle + rotation + line_rotation);
  const double ratio = f > LineExtent::nothing ? f / (2 * std::sin(f / 2)) : 1;
  return ratio *
         (step.ends.orientation + (1.5 * rotation * rotation + line_rotation * line_rotation) / 8);
}

/// Bounds the deviation in orientation from the line's orientation at s', or at the nearest point
/// if inside_line.
double orientation_bound(const LineStep& step, const Task& task, const Deviation& a,
                         const Deviation& b) {
  const double ends = step.ends.orientation;
  const double beyond = std::min(1.0, step.beyond);
  if (task.orientations() == 0) return ends;
  if (step.whole_rotation) {
    // Between two shortest rotations in SO(3), locally a sphere of radius 2, the distance exceeds
    // the larger distance between their ends by at most the factor 1 / cos(angle/4) (Jacobi's
    // equation).
    const double angle = step.chord.rotation + a.orientation + b.orientation;
    const double between = angle < pi ? ends / std::cos(angle / 4) : pi;
    if (!step.inside_line) return between + step.chord.orientation;
    return between + (orientation_at_nearest(step) + 2 * step.extent.angle * beyond);
  }
  // |d log| <= pi/2 |d angle| for any orientation of the free rows.
  const double line_rotation = step.extent.angle * step.change;
  const double linear = ends + pi / 4 * (step.chord.rotation + line_rotation);
  if (task.orientations() != 2) return std::min(linear, pi);
  if (!step.fixed_rows && step.extent.by_position()) return std::min(linear, pi);
  return std::min(linear,
                  pi / 2 * step.extent.angle * beyond + bound_with_free_row(step, line_rotation));
}

}  // namespace

Deviation line_step_bound(const Arm& arm, const Line& line, const Task& task,
                          const ConfigurationRef& q_a, const ConfigurationRef& q_b,
                          const Deviation& a, const Deviation& b) {
  LineStep step = line_step(arm, line, task, q_a, q_b);
  step.ends = {std::max(a.position, b.position), std::max(a.orientation, b.orientation)};
  Deviation bound{position_bound(step, task), orientation_bound(step, task, a, b)};
  // Adds the line's change of pose between s' and the parameter of the nearest point.
  if (step.extent.by_position() && !(step.whole_rotation && step.inside_line)) {
    const double shift =
        step.fixed_rows ? step.ends.position + step.chord.position : 2 * bound.position;
    const double change = shift < step.length ? shift / step.length : 1;
    bound.orientation += (step.whole_rotation ? 1 : pi / 2) * step.extent.angle * change;
  } else if (step.extent.by_rotation() && task.positions() > 0) {
    const double change =
        step.whole_rotation ? std::min(1.0, 2 * bound.orientation / step.extent.angle) : 1;
    bound.position += step.extent.length * change;
  }
  bound.orientation = std::min(bound.orientation, pi);
  return bound;
}

}  // namespace beeline::internal
