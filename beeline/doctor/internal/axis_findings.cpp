#include <algorithm>
#include <cmath>

#include <beeline/doctor/internal/explanations.h>
#include <beeline/doctor/internal/findings.h>
#include <beeline/doctor/internal/link_table.h>
#include <beeline/doctor/internal/number_relation.h>
#include <beeline/doctor/internal/reconciliation.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/numbers.h>
#include <beeline/kinematics/forward.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {
namespace {

constexpr double max_angle = 2e-3;     // rad: 1.57 for pi/2 is 8e-4 off, 3.14 for pi 1.6e-3
constexpr double max_distance = 5e-5;  // metres

/// The direction made exactly parallel or perpendicular to the one before.
Vector3 exact_direction(const Vector3& before, const Vector3& direction) {
  const double cosine = before.dot(direction);
  if (std::abs(cosine) < std::sin(max_angle)) return (direction - cosine * before).normalized();
  if (before.cross(direction).norm() < std::sin(max_angle)) return cosine < 0 ? -before : before;
  return direction;
}

/// The foot of the common normal of two axes on the first one, and the vector from there to the
/// second.
struct Normal {
  Vector3 foot, vector;
};
Normal common_normal(const JointLine& a, const JointLine& b) {
  const Vector3 cross = a.direction.cross(b.direction);
  return {foot_of_normal(a, b), (b.point - a.point).dot(cross) / cross.squaredNorm() * cross};
}

/// The arm with its joint axes moved to the special position that they nearly have: parallel or
/// perpendicular if they are within 2e-3 rad of it, concurrent if they pass each other within 5e-5
/// m.
struct ExactAxes {
  Arm arm;
  double angle = 0;     ///< largest change of an angle between neighbours, rad
  double distance = 0;  ///< largest distance between neighbours that are made to meet, m
};
ExactAxes with_exact_axes(const Arm& arm) {
  const std::vector<JointLine> given = joint_lines(arm);
  std::vector<JointLine> lines = given;
  double angle = 0, distance = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    JointLine& line = lines[i];
    const JointLine& before = lines[i - 1];
    line.direction = exact_direction(before.direction, given[i].direction);
    const double turned = given[i].direction.cross(line.direction).norm();
    if (turned > 1e-10) angle = std::max(angle, turned);
    if (line.kind == JointKind::prismatic || before.kind == JointKind::prismatic) continue;
    if (before.direction.cross(line.direction).norm() < 1e-3) continue;
    Normal normal = common_normal(before, line);
    if (normal.vector.norm() > max_distance) continue;
    if (normal.vector.norm() > 1e-10) distance = std::max(distance, normal.vector.norm());
    line.point -= normal.vector;
    if (i < 2 || lines[i - 2].direction.cross(before.direction).norm() < 1e-3) continue;
    const Normal earlier = common_normal(lines[i - 2], before);
    if (earlier.vector.norm() > 1e-9) continue;
    const Vector3 apart = earlier.foot + earlier.vector - normal.foot;  // along the axis before
    if (apart.norm() > max_distance) continue;
    if (apart.norm() > 1e-10) distance = std::max(distance, apart.norm());
    line.point += apart;
  }
  const Pose tool = forward_kinematics(arm, Configuration::Zero(arm.dof()));
  return {arm_along(lines, tool, arm), angle, distance};
}

/// The joints whose frames have a right angle that was written with few digits, and the first one.
struct RoundedAngles {
  std::vector<std::size_t> joints;
  double angle = 0, exact = 0;
  std::string digits;  ///< `pi/2 with 5 digits`
};
RoundedAngles rounded_angles(const Arm& arm) {
  RoundedAngles found;
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    const RollPitchYaw rpy = roll_pitch_yaw(arm.joints()[i].offset.linear());
    for (const double angle : {rpy.roll, rpy.pitch, rpy.yaw}) {
      double exact = 0;
      const std::string digits = truncated_right_angle(angle, &exact);
      if (digits.empty() || std::abs(angle - exact) < 1e-9) continue;
      if (found.joints.empty()) {
        found.angle = angle;
        found.exact = exact;
        found.digits = digits;
      }
      if (found.joints.empty() || found.joints.back() != i) found.joints.push_back(i);
    }
  }
  return found;
}

/// Returns the present method of inverse kinematics and the possible one; empty if both are the
/// same.
std::string lost_method(const Arm& arm, const ExactAxes& exact) {
  constexpr int most = 7;  // joints
  if (arm.dof() > most || arm.dof() != static_cast<int>(arm.joints().size())) return "";
  const std::string now = inverse_method(arm), then = inverse_method(exact.arm);
  if (now == then) return "";
  return "inverse kinematics: " + now + "; with exact axes: " + then;
}

void find_special(const Arm& arm, std::vector<Finding>& found) {
  const RoundedAngles rounded = rounded_angles(arm);
  const ExactAxes exact = with_exact_axes(arm);
  const bool nearly = exact.angle > 0 || exact.distance > 0;
  const std::string lost = nearly ? lost_method(arm, exact) : "";
  if (!rounded.joints.empty()) {
    found.push_back({.kind = FindingKind::rounded_angle,
                     .joint = rounded.joints.size() == 1 ? static_cast<int>(rounded.joints[0]) : -1,
                     .place = joints_text(arm, rounded.joints),
                     .what = number(rounded.angle) + " is " + rounded.digits + ", off by " +
                             number(std::abs(rounded.angle - rounded.exact)) + " rad",
                     .cost = lost,
                     .remedy = "write " + beeline::exact(rounded.exact)});
  } else if (!lost.empty()) {
    const std::string angle = exact.angle > 0 ? number(exact.angle) +
                                                    " rad from parallel or "
                                                    "perpendicular"
                                              : "";
    const std::string distance =
        exact.distance > 0 ? number(exact.distance) + " m from meeting" : "";
    found.push_back({.kind = FindingKind::nearly_special,
                     .place = "axes",
                     .what = "neighbouring axes are " + angle +
                             (angle.empty() || distance.empty() ? "" : " and ") + distance,
                     .cost = lost,
                     .remedy = "make the axes exact, unless these numbers are a calibration"});
  }
}

/// Finds two neighbouring joints with one axis: the task loses a degree of freedom at every
/// configuration. Trunks and necks have such joints, apart from each other along the axis. In a
/// table, or with equal frames, they are a mistake.
void find_coincident(const Arm& arm, std::vector<Finding>& found) {
  const std::vector<JointLine> lines = joint_lines(arm);
  const bool table =
      own_dh_rows(arm, DhConvention::standard) || own_dh_rows(arm, DhConvention::modified);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const JointLine &a = lines[i - 1], &b = lines[i];
    if (a.kind != b.kind || a.pitch != b.pitch) continue;
    if (arm.joints()[i].mimic || arm.joints()[i - 1].mimic) continue;
    if (a.direction.cross(b.direction).norm() > 1e-6) continue;
    const Vector3 apart = (b.point - a.point).cross(a.direction);
    if (a.kind != JointKind::prismatic && apart.norm() > 1e-6) continue;
    if (!table && !arm.joints()[i].offset.matrix().isIdentity(1e-9)) continue;
    found.push_back({.kind = FindingKind::coincident_axes,
                     .joint = static_cast<int>(i),
                     .place = joints_text(arm, {i - 1, i}),
                     .what = a.kind == JointKind::prismatic ? "both slide in one direction"
                                                            : "both turn about one axis",
                     .cost = "the Jacobian loses one rank at every configuration",
                     .remedy = "a row or an axis is wrong, or one of the two is superfluous"});
  }
}

}  // namespace

void find_axes(const Arm& arm, std::vector<Finding>& found) {
  find_special(arm, found);
  find_coincident(arm, found);
}

void find_units(const Arm& arm, std::vector<Finding>& found) {
  constexpr double longest_link = 20;  // metres
  std::vector<std::size_t> joints;
  double longest = 0;
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    const Joint& joint = arm.joints()[i];
    double length = joint.offset.translation().cwiseAbs().maxCoeff();
    if (kind(joint) != JointKind::prismatic) {
      length = std::max(length, joint.screw.head<3>().cwiseAbs().maxCoeff());
    }
    if (!(length > longest_link)) continue;
    joints.push_back(i);
    longest = std::max(longest, length);
  }
  const double tool = arm.tool().translation().cwiseAbs().maxCoeff();
  if (joints.empty() && !(tool > longest_link)) return;
  longest = std::max(longest, tool);
  found.push_back({.kind = FindingKind::length_unit,
                   .joint = joints.size() == 1 ? static_cast<int>(joints[0]) : -1,
                   .place = joints.empty() ? "tool" : joints_text(arm, joints),
                   .what = "a length of " + number(longest) + " m: millimetres?",
                   .remedy = "in metres: " + number(longest / 1000)});
}

std::string joints_text(const Arm& arm, const std::vector<std::size_t>& joints) {
  if (joints.size() == 1) return joint_text(arm, joints[0]);
  if (joints.size() == arm.joints().size()) return "all joints";
  std::vector<std::string> numbers;
  for (const std::size_t joint : joints) numbers.push_back(std::to_string(joint + 1));
  return "joints " + listed(numbers);
}

}  // namespace beeline::internal
