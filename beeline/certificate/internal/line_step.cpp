#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/certificate/internal/chord_bound.h>
#include <beeline/certificate/internal/line_step.h>
#include <beeline/kinematics/forward.h>
#include <beeline/path/internal/nearest_on_line.h>

namespace beeline {
namespace {

constexpr double pi = std::numbers::pi;

/// The position rows turn with the tool, and some of them do not matter.
bool turning_rows(const Task& task) {
  return task.frame == Frame::tool && task.positions() > 0 && task.positions() < 3;
}

/// All of the arm's turns, and the line's, are in rows that matter, or none is: then their angles
/// are distances.
bool whole_turns(const Arm& arm, const Line& line, const LineExtent& extent, const Task& task,
                 const ConfigurationRef& q) {
  if (task.orientations() % 3 == 0) return true;
  return arm.planar() && turns_within_rows(task, Vector3::UnitZ()) &&
         turns_within_rows(task, extent.turn) &&
         turns_within_rows(task, pose_difference(forward_kinematics(arm, q), line.from).tail<3>());
}

/// The step's bend has a part along its chord `way`, which moves the tool on the line but not off
/// it, unless it is enough to lead back beyond an end of the chord.
bool stays_on_chord(const ChordBound& step, const Vector3& bend, const Vector3& way) {
  const double length = way.norm();
  return length > LineExtent::nothing &&
         4 * std::abs(bend.dot(way)) / length + 6 * step.rest <= length;
}

/// How far beyond the line's ends the tool is by its nearest fraction, which is none there.
double beyond_ends(const Line& line, const LineExtent& extent, const Pose& pose, const Task& task) {
  const Vector3 done = in_position_rows(task, pose, pose.translation() - line.from.translation());
  const double s = done.dot(extent.way) / extent.way.squaredNorm();
  return std::max({0.0, -s, s - 1});
}

double part_across(const Vector3& v, const Vector3& way) {
  return (v - v.dot(way) / way.squaredNorm() * way).norm();
}

/// As ChordBound::orientation, but measured from the line's orientation at the point nearest by
/// position, of which the fraction s of the line has s'' = p''.way / length^2. The change of the
/// line's angular velocity is compared in the axes of the other: they differ by `turned` at most.
double orientation_at_nearest(const ChordBound& step, const LineExtent& extent, double ends) {
  const double square = extent.length * extent.length;
  const double pull = 8 * step.bend.dot(extent.way) / square;
  const double swing =
      (step.swing - pull * extent.turn).norm() + step.swing_rest +
      extent.angle * (8 * step.rest / extent.length + std::abs(pull) * (step.turned + ends));
  return orientation_bound(swing, step.turned);
}

/// With one row free, along an axis e of the task's frame, the turn in the other two is at most
/// f / (2 sin(f/2)) times the distance of the tool's e from the line's, f being the whole angle.
/// As for positions |e''| counts: |w'| + |w|^2 <= 3/2 `turned`^2, and `line_turned`^2 of the
/// line's.
double with_row_free(double ends, double turned, double line_turned, double angle_at_ends) {
  const double f = std::min(pi, angle_at_ends + turned + line_turned);
  const double ratio = f > LineExtent::nothing ? f / (2 * std::sin(f / 2)) : 1;
  return ratio * (ends + (1.5 * turned * turned + line_turned * line_turned) / 8);
}

}  // namespace

bool bound_is_linear(const Arm& arm, const Task& task) {
  const bool flat = arm.planar() && turns_within_rows(task, Vector3::UnitZ());
  return turning_rows(task) || (task.orientations() == 1 && !flat);
}

// Let s_a and s_b be the nearest fractions at the ends, s' the one in proportion between them.
// First comes a bound on the deviation from the line's point at s', then one on how far s' is from
// nearest.
Deviation line_step_bound(const Arm& arm, const Line& line, const Task& task,
                          const ConfigurationRef& q_a, const ConfigurationRef& q_b,
                          const Deviation& a, const Deviation& b) {
  const LineExtent extent = extent_of(line, task);
  const ChordBound step = chord_bound(arm, q_a, q_b);
  const bool still = !turning_rows(task);
  const bool whole = whole_turns(arm, line, extent, task, q_a);
  Deviation bound{std::max(a.position, b.position), std::max(a.orientation, b.orientation)};

  const Pose at_a = forward_kinematics(arm, q_a), at_b = forward_kinematics(arm, q_b);
  const Vector3 way = in_position_rows(task, at_a, at_b.translation() - at_a.translation());
  const Vector3 bend = in_position_rows(task, at_a, step.bend);
  const bool on_chord = still && extent.told_by_way() && stays_on_chord(step, bend, way);
  const double beyond = extent.told_by_way() ? std::max(beyond_ends(line, extent, at_a, task),
                                                        beyond_ends(line, extent, at_b, task))
                                             : 0;
  double apart = 0, off = 0, length = extent.length, full_angle = 0;
  if (!still || !whole) {
    const double s_a = nearest_fraction(line, at_a, task);
    const double s_b = nearest_fraction(line, at_b, task);
    const auto distance = [&line](const Pose& pose, double s) {
      return (interpolate(line.from, line.to, s).translation() - pose.translation()).norm();
    };
    apart = std::abs(s_b - s_a);
    off = std::max(distance(at_a, s_a), distance(at_b, s_b));
    for (const auto& [pose, s] : {std::pair{at_a, s_a}, {at_b, s_b}}) {
      const Pose there = interpolate(line.from, line.to, s);
      full_angle = std::max(full_angle, pose_difference(there, pose).tail<3>().norm());
    }
    const double shown = in_position_rows(task, at_a, extent.way).norm();
    if (!still) length = shown - extent.length * step.turned;  // the least that the rows may show
  }
  if (still) {  // distance from a straight segment is convex
    if (task.positions() > 0) {
      bound.position +=
          std::min(step.position, on_chord ? part_across(bend, way) + step.rest : step.position);
    }
  } else {  // from the nearer end, at most half of all motion
    bound.position += (step.moved + extent.length * apart + off * step.turned) / 2;
  }
  if (task.orientations() > 0 && whole) {
    // Between two shortest turns in SO(3), a sphere of radius 2, the distance exceeds that of their
    // ends by 1 / cos(angle/4) at most (Jacobi's equation).
    const double angle = step.turned + a.orientation + b.orientation;
    const double ends = bound.orientation;
    bound.orientation = angle < pi ? ends / std::cos(angle / 4) : pi;
    if (on_chord) {
      bound.orientation +=
          orientation_at_nearest(step, extent, ends) + 2 * extent.angle * std::min(1.0, beyond);
    } else {
      bound.orientation += step.orientation;
    }
  } else if (task.orientations() > 0) {  // |d log| <= pi/2 |d angle| wherever the free rows stand
    double by_curve = pi;
    if (task.orientations() == 2 && (still || !extent.told_by_way())) {
      by_curve = pi / 2 * extent.angle * std::min(1.0, beyond) +
                 with_row_free(bound.orientation, step.turned, extent.angle * apart, full_angle);
    }
    bound.orientation += pi / 4 * (step.turned + extent.angle * apart);
    bound.orientation = std::min(bound.orientation, by_curve);
  }

  if (extent.told_by_way() && !(whole && on_chord)) {
    const double shift =
        still ? std::max(a.position, b.position) + step.position : 2 * bound.position;
    const double drift = shift < length ? shift / length : 1;
    bound.orientation += (whole ? 1 : pi / 2) * extent.angle * drift;
  } else if (extent.told_by_turn() && task.positions() > 0) {
    const double drift = whole ? std::min(1.0, 2 * bound.orientation / extent.angle) : 1;
    bound.position += extent.length * drift;
  }
  bound.orientation = std::min(bound.orientation, pi);
  return bound;
}

}  // namespace beeline
