#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/motion/chord.h>
#include <beeline/motion/path/turning.h>
#include <beeline/motion/straightness.h>
#include <beeline/pose/angle.h>

namespace beeline {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double nothing = 1e-12;  // metres or radians that count as none

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

/// All of the arm's turns, and the line's, are in rows that matter, or none is: then their angles
/// are distances.
bool whole_turns(const Arm& arm, const Line& line, const Extent& extent, const Task& task,
                 const ConfigurationRef& q) {
  if (rows(task, 3) % 3 == 0) return true;
  return arm.planar() && turns_within_rows(task, Vector3::UnitZ()) &&
         turns_within_rows(task, extent.turn) &&
         turns_within_rows(task, pose_difference(forward_kinematics(arm, q), line.from).tail<3>());
}

/// The step's bend has a part along its chord `way`, which moves the tool on the line but not off
/// it, unless it is enough to lead back beyond an end of the chord.
bool stays_on_chord(const ChordBound& step, const Vector3& bend, const Vector3& way) {
  const double length = way.norm();
  return length > nothing && 4 * std::abs(bend.dot(way)) / length + 6 * step.rest <= length;
}

/// How far beyond the line's ends the tool is by its nearest fraction, which is none there.
double beyond_ends(const Line& line, const Extent& extent, const Pose& pose, const Task& task) {
  const Vector3 done = position_rows(task, pose, pose.translation() - line.from.translation());
  const double s = done.dot(extent.way) / extent.way.squaredNorm();
  return std::max({0.0, -s, s - 1});
}

double part_across(const Vector3& v, const Vector3& way) {
  return (v - v.dot(way) / way.squaredNorm() * way).norm();
}

/// As ChordBound::orientation, but measured from the line's orientation at the point nearest by
/// position, of which the fraction s of the line has s'' = p''.way / length^2. The change of the
/// line's angular velocity is compared in the axes of the other: they differ by `turned` at most.
double orientation_at_nearest(const ChordBound& step, const Extent& extent, double ends) {
  const double square = extent.length * extent.length;
  const double pull = 8 * step.bend.dot(extent.way) / square;
  const double swing =
      (step.swing - pull * extent.turn).norm() + step.swing_rest +
      extent.angle * (8 * step.rest / extent.length + std::abs(pull) * (step.turned + ends));
  return swing_bound(swing, step.turned);
}

/// With one row free, along an axis e of the task's frame, the turn in the other two is at most
/// f / (2 sin(f/2)) times the distance of the tool's e from the line's, f being the whole angle.
/// As for positions |e''| counts: |w'| + |w|^2 <= 3/2 `turned`^2, and `line_turned`^2 of the
/// line's.
double with_row_free(double ends, double turned, double line_turned, double angle_at_ends) {
  const double f = std::min(pi, angle_at_ends + turned + line_turned);
  const double ratio = f > nothing ? f / (2 * std::sin(f / 2)) : 1;
  return ratio * (ends + (1.5 * turned * turned + line_turned * line_turned) / 8);
}

}  // namespace

Pose nearest_on(const Line& line, const Pose& pose, const Task& task) {
  return interpolate(line.from, line.to, nearest_fraction(line, extent_of(line, task), pose, task));
}

Deviation deviation_from(const Line& line, const Pose& pose, const Task& task) {
  return task_deviation(task, nearest_on(line, pose, task), pose);
}

// Let s_a and s_b be the nearest fractions at the ends, s' the one in proportion between them.
// First comes a bound on the deviation from the line's point at s', then one on how far s' is from
// nearest.
Deviation step_bound(const Arm& arm, const Line& line, const Task& task,
                     const ConfigurationRef& q_a, const ConfigurationRef& q_b, const Deviation& a,
                     const Deviation& b) {
  const Extent extent = extent_of(line, task);
  const ChordBound step = chord_bound(arm, q_a, q_b);
  const bool still = !turning_rows(task);
  const bool whole = whole_turns(arm, line, extent, task, q_a);
  Deviation bound{std::max(a.position, b.position), std::max(a.orientation, b.orientation)};

  const Pose at_a = forward_kinematics(arm, q_a), at_b = forward_kinematics(arm, q_b);
  const Vector3 way = position_rows(task, at_a, at_b.translation() - at_a.translation());
  const Vector3 bend = position_rows(task, at_a, step.bend);
  const bool on_chord = still && extent.told_by_way() && stays_on_chord(step, bend, way);
  const double beyond = extent.told_by_way() ? std::max(beyond_ends(line, extent, at_a, task),
                                                        beyond_ends(line, extent, at_b, task))
                                             : 0;
  double apart = 0, off = 0, length = extent.length, full_angle = 0;
  if (!still || !whole) {
    const double s_a = nearest_fraction(line, extent, at_a, task);
    const double s_b = nearest_fraction(line, extent, at_b, task);
    const auto distance = [&line](const Pose& pose, double s) {
      return (interpolate(line.from, line.to, s).translation() - pose.translation()).norm();
    };
    apart = std::abs(s_b - s_a);
    off = std::max(distance(at_a, s_a), distance(at_b, s_b));
    for (const auto& [pose, s] : {std::pair{at_a, s_a}, {at_b, s_b}}) {
      const Pose there = interpolate(line.from, line.to, s);
      full_angle = std::max(full_angle, pose_difference(there, pose).tail<3>().norm());
    }
    const double shown = position_rows(task, at_a, extent.way).norm();
    if (!still) length = shown - extent.length * step.turned;  // the least that the rows may show
  }
  if (still) {  // distance from a straight segment is convex
    if (rows(task, 0) > 0) {
      bound.position +=
          std::min(step.position, on_chord ? part_across(bend, way) + step.rest : step.position);
    }
  } else {  // from the nearer end, at most half of all motion
    bound.position += (step.moved + extent.length * apart + off * step.turned) / 2;
  }
  if (rows(task, 3) > 0 && whole) {
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
  } else if (rows(task, 3) > 0) {  // |d log| <= pi/2 |d angle| wherever the free rows stand
    double by_curve = pi;
    if (rows(task, 3) == 2 && (still || !extent.told_by_way())) {
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
  } else if (extent.told_by_turn() && rows(task, 0) > 0) {
    const double drift = whole ? std::min(1.0, 2 * bound.orientation / extent.angle) : 1;
    bound.position += extent.length * drift;
  }
  bound.orientation = std::min(bound.orientation, pi);
  return bound;
}

HalvedStep halved_step(const Arm& arm, const Line& line, const Task& task,
                       const ConfigurationRef& q_a, const ConfigurationRef& q_b, const Deviation& a,
                       const Deviation& b) {
  const Configuration half_way = (q_a + q_b) / 2;
  const Deviation middle = deviation_from(line, forward_kinematics(arm, half_way), task);
  const Deviation whole = step_bound(arm, line, task, q_a, q_b, a, b);
  const Deviation first = step_bound(arm, line, task, q_a, half_way, a, middle);
  const Deviation second = step_bound(arm, line, task, half_way, q_b, middle, b);
  return {middle,
          {std::min(whole.position, std::max(first.position, second.position)),
           std::min(whole.orientation, std::max(first.orientation, second.orientation))}};
}

Straightness straightness(const Arm& arm, std::span<const Configuration> samples,
                          std::span<const Pose> waypoints, std::span<const std::size_t> arrivals,
                          const Task& task) {
  if (samples.empty() || waypoints.size() != arrivals.size()) {
    throw Error("straightness needs samples, and an arrival for each waypoint");
  }
  Straightness result;
  Line line{forward_kinematics(arm, samples.front()), Pose::Identity()};
  std::size_t first = 0;
  for (std::size_t w = 0; w < waypoints.size(); ++w) {
    if (arrivals[w] < first || arrivals[w] >= samples.size()) {
      throw Error("arrival " + std::to_string(w + 1) + " is not among the samples, in order");
    }
    line.to = waypoints[w];
    Deviation before = deviation_from(line, forward_kinematics(arm, samples[first]), task);
    grow(result.sampled, before);
    grow(result.bound, before);
    for (std::size_t k = first + 1; k <= arrivals[w]; ++k) {
      const Deviation now = deviation_from(line, forward_kinematics(arm, samples[k]), task);
      grow(result.sampled, now);
      const auto [middle, bound] =
          halved_step(arm, line, task, samples[k - 1], samples[k], before, now);
      grow(result.measured, middle);
      grow(result.bound, bound);
      before = now;
    }
    line.from = line.to;
    first = arrivals[w];
  }
  grow(result.measured, result.sampled);
  return result;
}

}  // namespace beeline
