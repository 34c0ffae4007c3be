#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <sstream>

#include <beeline/error.h>
#include <beeline/model/arm.h>
#include <beeline/pose/se3.h>

namespace beeline {
namespace {

constexpr double Limits::*rates[] = {&Limits::velocity, &Limits::acceleration, &Limits::jerk};

/// Writes numbers with six significant digits, angles in one unit.
struct TableUnit {
  bool degrees;

  const char* name() const { return degrees ? "deg" : "rad"; }
  double angle(double radians) const {
    return degrees ? radians * 180 / std::numbers::pi : radians;
  }
  /// A joint's value or a derivative of it.
  double of_joint(const Joint& joint, double value) const {
    return kind(joint) == JointKind::prismatic ? value : angle(value);
  }
};

/// Rounding errors near zero are written as 0.
std::string rounded(double value) { return number(std::abs(value) < 5e-13 ? 0 : value); }

std::string rounded(const Vector3& v) {
  return rounded(v.x()) + ", " + rounded(v.y()) + ", " + rounded(v.z());
}

std::string left(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

std::string right(const std::string& text, std::size_t width) {
  return std::string(width - std::min(width, text.size()), ' ') + text;
}

/// The poses of all links and of the tool where every coordinate is 0.
std::vector<Pose> frames_at_zero(const Arm& arm) {
  std::vector<Pose> frames{arm.base()};
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    frames.push_back(frames.back() * joint_transform(arm.joints()[i], arm.couplings()[i].shift));
  }
  frames.push_back(frames.back() * arm.tool());
  return frames;
}

std::string joint_row(const Arm& arm, std::size_t i, const Pose& link, std::size_t width,
                      const TableUnit& unit) {
  const Joint& joint = arm.joints()[i];
  const Limits& limits = joint_limits(arm, i);
  const Twist screw = adjoint(link, joint.screw);
  const bool prismatic = kind(joint) == JointKind::prismatic;
  std::string row = right(std::to_string(i + 1), 3) + "  " + left(joint.name, width) + "  " +
                    left(name(kind(joint)), 9) + "  " +
                    left(rounded(prismatic ? screw.head<3>() : screw.tail<3>()), 22);
  for (const double limit : {limits.lower, limits.upper}) {
    const double value = unit.of_joint(joint, limit);
    row += "  " + right(std::isfinite(limit) ? rounded(value) : "none", 9);
  }
  const Limits kept = motion_limits(limits);
  for (const auto rate : rates) {
    const bool known = limits.*rate < Limits::none;
    row += "  " + right(rounded(unit.of_joint(joint, kept.*rate)) + (known ? "  " : " a"), 12);
  }
  row.erase(row.find_last_not_of(' ') + 1);
  if (kind(joint) == JointKind::helical) row += "  pitch " + rounded(pitch(joint)) + " m/rad";
  if (joint.mimic) {
    row += "  = " + rounded(joint.mimic->multiplier) + " x " + joint.mimic->leader + " + " +
           rounded(unit.of_joint(joint, joint.mimic->offset));
  }
  return row + "\n";
}

std::string joint_rows(const Arm& arm, const std::vector<Pose>& frames, const TableUnit& unit) {
  std::size_t width = 5;
  for (const Joint& joint : arm.joints()) width = std::max(width, joint.name.size());
  std::string table = "     " + left("joint", width) + "  " + left("type", 9) + "  " +
                      left("axis in the world", 22) +
                      "      lower      upper    velocity    acceleration          jerk\n";
  bool assumed = false;
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    table += joint_row(arm, i, frames[i + 1], width, unit);
    for (const auto rate : rates) {
      assumed = assumed || !(joint_limits(arm, i).*rate < Limits::none);
    }
  }
  if (assumed) table += "     (a: not known, assumed in motions)\n";
  return table + "     (revolute joints in " + unit.name() +
         ", prismatic joints in m; velocity per s, acceleration per s^2, jerk per s^3)\n";
}

std::string frame_rows(const Arm& arm, const std::vector<Pose>& frames, const TableUnit& unit) {
  std::string table =
      std::string("\nframes in the world, all joints at 0 (x y z in m; roll pitch yaw in ") +
      unit.name() + ")\n";
  for (std::size_t i = 0; i < frames.size(); ++i) {
    std::string label = "tool";
    if (i == 0) {
      label = "0 (base)";
    } else if (i + 1 < frames.size()) {
      label = std::to_string(i) + " " + arm.joints()[i - 1].link;
    }
    const RollPitchYaw rpy = roll_pitch_yaw(frames[i].linear());
    const Vector3 angles(unit.angle(rpy.roll), unit.angle(rpy.pitch), unit.angle(rpy.yaw));
    table += "  " + left(label, 24) + "  " + left(rounded(frames[i].translation()), 30) + "  " +
             rounded(angles) + "\n";
  }
  return table;
}

}  // namespace

std::string arm_table(const Arm& arm, bool degrees) {
  const TableUnit unit{degrees};
  const auto counted = [](std::size_t count, const std::string& one, const std::string& many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
  };
  const std::vector<Pose> frames = frames_at_zero(arm);
  const std::string table =
      arm.name() + ": " + counted(arm.joints().size(), "joint", "joints") + ", " +
      counted(static_cast<std::size_t>(arm.dof()), "degree of freedom", "degrees of freedom") +
      ", " + (arm.planar() ? "planar" : "spatial") + "\n\n" + joint_rows(arm, frames, unit) +
      frame_rows(arm, frames, unit);
  const Arm::Reach& reach = arm.reach();
  if (!std::isfinite(reach.radius)) {
    return table + "\nreach: unlimited, because a prismatic or helical joint has no limits\n";
  }
  return table + "\nreach: the tool stays within " + rounded(reach.radius) + " m of the point " +
         rounded(reach.centre) + "\n";
}

std::ostream& operator<<(std::ostream& out, const Arm& arm) { return out << arm_table(arm); }

}  // namespace beeline
