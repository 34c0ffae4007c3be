#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/motion/straightness.h>

namespace beeline {
namespace {

constexpr double no_length = 1e-9;  // metres or radians below which a line does not move or turn

/// The linear rows of `v` that matter, for tasks in base axes; others are measured in full.
Vector3 linear_rows(const Task& task, Vector3 v) {
  if (task.frame == Frame::tool) return v;
  for (int i = 0; i < 3; ++i) {
    if (!task.rows[static_cast<std::size_t>(i)]) v[i] = 0;
  }
  return v;
}

double nearest_fraction(const Line& line, const Pose& pose, const Task& task) {
  const Twist whole = pose_difference(line.to, line.from);
  const Twist done = pose_difference(pose, line.from);
  const Vector3 along = linear_rows(task, whole.head<3>());
  if (along.norm() > no_length) {
    return std::clamp(linear_rows(task, done.head<3>()).dot(along) / along.squaredNorm(), 0.0, 1.0);
  }
  const Vector3 turn = whole.tail<3>();
  if (turn.norm() < no_length) return 1;
  return std::clamp(done.tail<3>().dot(turn) / turn.squaredNorm(), 0.0, 1.0);
}

/// What one joint contributes to a step: only sizes matter, not signs and directions.
struct Contribution {
  double turn = 0;    ///< |dq| of a joint that turns, radians
  double slide = 0;   ///< |dq| of travel along the axis, metres
  double radius = 0;  ///< the tool's largest distance from the axis during the motion
};

std::vector<Contribution> contributions(const Arm& arm, const ConfigurationRef& q_a,
                                        const ConfigurationRef& q_b) {
  const std::vector<Pose> world_T_link = link_poses(arm, q_a);
  const Vector3 tool = (world_T_link.back() * arm.tool()).translation();
  std::vector<Contribution> parts(arm.joints().size());
  double carried = 0;  // how far the joints behind this one can move the tool
  for (std::size_t i = parts.size(); i-- > 0;) {
    const Arm::Drive& drive = arm.drives()[i];
    const double step = std::abs(drive.ratio * (q_b[drive.coordinate] - q_a[drive.coordinate]));
    const Twist screw = adjoint(world_T_link[i + 1], arm.joints()[i].screw);
    const Vector3 axis = screw.tail<3>();
    if (axis.isZero(0)) {
      parts[i].slide = step;
    } else {
      const double along = std::abs(axis.dot(screw.head<3>()));
      const Vector3 around = screw.head<3>() + axis.cross(tool) - axis.dot(screw.head<3>()) * axis;
      parts[i] = {step, along * step, around.norm() + carried};
    }
    carried += parts[i].slide + parts[i].radius * parts[i].turn;
  }
  return parts;
}

/// How far one step of all joints together can carry and bend the tool's motion.
struct StepSize {
  Deviation chord;    ///< how far it leaves the straight line between its ends
  double moved = 0;   ///< the way of the tool's origin, at most, metres
  double turned = 0;  ///< the tool's turn, at most, radians
  double slack = 1;   ///< cos(turn/4): shortest turns whose ends are close part by 1/slack at most
};

StepSize step_size(const Arm& arm, const ConfigurationRef& q_a, const ConfigurationRef& q_b) {
  check_configuration(arm, q_a);
  check_configuration(arm, q_b);
  StepSize step;
  double acceleration = 0;  // of the tool's position
  double turn_change = 0;   // of its angular velocity
  for (const Contribution& part : contributions(arm, q_a, q_b)) {
    acceleration +=
        part.radius * part.turn * (part.turn + 2 * step.turned) + 2 * part.slide * step.turned;
    turn_change += part.turn * step.turned;
    step.moved += part.slide + part.radius * part.turn;
    step.turned += part.turn;
  }
  if (arm.planar()) turn_change = 0;  // about parallel axes angles simply add
  step.slack = std::cos(std::min(step.turned, std::numbers::pi) / 4);
  step.chord = {acceleration / 8, turn_change / 4 / step.slack};
  return step;
}

bool all_rows(const Task& task, std::size_t first) {
  return task.rows[first] && task.rows[first + 1] && task.rows[first + 2];
}

bool no_rows(const Task& task, std::size_t first) {
  return !task.rows[first] && !task.rows[first + 1] && !task.rows[first + 2];
}

}  // namespace

Deviation deviation_from(const Line& line, const Pose& pose, const Task& task) {
  const double s = nearest_fraction(line, pose, task);
  return task_deviation(task, interpolate(line.from, line.to, s), pose);
}

Deviation chord_bound(const Arm& arm, const ConfigurationRef& q_a, const ConfigurationRef& q_b) {
  return step_size(arm, q_a, q_b).chord;
}

Deviation step_bound(const Arm& arm, const Line& line, const Task& task,
                     const ConfigurationRef& q_a, const ConfigurationRef& q_b, const Deviation& a,
                     const Deviation& b) {
  const StepSize step = step_size(arm, q_a, q_b);
  // Rows that are left free in turning axes bound nothing by the chord: there, all motion counts.
  const bool straight_rows = task.frame == Frame::base || all_rows(task, 0);
  const bool turning_rows = all_rows(task, 3) || arm.planar();
  const double bend = straight_rows ? step.chord.position : step.moved;
  const double twist = turning_rows ? step.chord.orientation : step.turned;

  Deviation bound{std::max(a.position, b.position) + bend, 0};
  if (no_rows(task, 3)) return bound;
  bound.orientation = std::max(a.orientation, b.orientation) / step.slack + twist;
  // The nearest point of the line, whose orientation is compared, is not where the chord has it.
  const Twist whole = pose_difference(line.to, line.from);
  const double length = linear_rows(task, whole.head<3>()).norm();
  const double turn = whole.tail<3>().norm();
  bound.orientation +=
      length > no_length ? turn * std::min(1.0, bend / length) : std::min(turn, bound.orientation);
  return bound;
}

Straightness straightness(const Arm& arm, std::span<const Configuration> samples,
                          std::span<const Pose> waypoints, std::span<const std::size_t> arrivals,
                          const Task& task) {
  if (samples.empty() || waypoints.size() != arrivals.size()) {
    throw Error("straightness needs samples, and an arrival for each waypoint");
  }
  Straightness result;
  const auto grow = [](Deviation& largest, const Deviation& met) {
    largest.position = std::max(largest.position, met.position);
    largest.orientation = std::max(largest.orientation, met.orientation);
  };
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
      grow(result.bound, step_bound(arm, line, task, samples[k - 1], samples[k], before, now));
      before = now;
    }
    line.from = line.to;
    first = arrivals[w];
  }
  return result;
}

}  // namespace beeline
