#include "arguments.h"

#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <numbers>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/read/arm.h>

using namespace beeline;

void ArmArgument::declare(CLI::App& verb) {
  verb.add_option("ARM", text, "A built-in name, a joint string or a file (.urdf, .json)")
      ->required();
  verb.add_option("--base", base, "The link that a URDF's chain begins at (default: its root)");
  verb.add_option("--tip", tip, "The link that a URDF's chain ends at (default: its only leaf)");
}

Arm ArmArgument::read() const { return read_arm(text, {.base = base, .tip = tip}); }

void UnitArgument::declare(CLI::App& verb) {
  verb.add_flag("--degrees", degrees, "Angles in degrees, read and printed (default: radians)");
}

Configuration UnitArgument::configuration(const Arm& arm, const std::string& text,
                                          const std::string& option) const {
  const std::vector<double> values = parse_numbers(text, option);
  Configuration q =
      Eigen::Map<const Configuration>(values.data(), static_cast<Eigen::Index>(values.size()));
  if (q.size() != arm.dof()) {
    try {
      check_configuration(arm, q);
    } catch (const Error& error) {
      throw Error(option + ": " + error.what());
    }
  }
  for (int k = 0; k < arm.dof(); ++k) q[k] = coordinate(arm, k, q[k]);
  return q;
}

double UnitArgument::coordinate(const Arm& arm, int k, double value) const {
  const bool slides = kind(arm.joint_of(k)) == JointKind::prismatic;
  return slides ? value : to_radians(value, angle_unit());
}

double UnitArgument::shown(double radians) const {
  return degrees ? radians * 180 / std::numbers::pi : radians;
}

Configuration UnitArgument::shown(const Arm& arm, const Configuration& q) const {
  Configuration values = q;
  for (int k = 0; k < arm.dof(); ++k) values[k] = shown(arm, k, values[k]);
  return values;
}

double UnitArgument::shown(const Arm& arm, int k, double value) const {
  return kind(arm.joint_of(k)) == JointKind::prismatic ? value : shown(value);
}

void TaskArgument::declare(CLI::App& verb) {
  verb.add_option(
      "--task", text,
      "What matters of the tool's pose: planar, position, spatial, or six of 0 and 1 for\n"
      "x y z wx wy wz such as 111110; :tool behind it takes the tool's axes\n"
      "(default: planar for planar arms, else spatial)");
}

Task TaskArgument::read(const Arm& arm) const {
  return text.empty() ? default_task(arm) : task_named(text);
}

void check_pose_form(const Arm& arm, const WrittenPose& written, const TaskArgument& task,
                     const std::string& where) {
  if (written.planar && !arm.planar()) {
    throw Error(where + ": x,y,theta is for planar arms; " + arm.name() +
                " needs x,y,z,roll,pitch,yaw or x,y,z,qw,qx,qy,qz");
  }
  if (written.planar || !arm.planar() || !task.text.empty()) return;
  constexpr double off_plane = 1e-6;  // metres, and of the z axis
  const double height = forward_kinematics(arm, middle_configuration(arm)).translation().z();
  const bool in_plane = std::abs(written.pose.translation().z() - height) < off_plane &&
                        (written.pose.linear().col(2) - Vector3::UnitZ()).norm() < off_plane;
  if (in_plane) return;
  throw Error(where + ": the pose is off the plane z = " + number(height) + " m of arm " +
              arm.name() + "; give x,y,theta, or --task planar to leave height and tilt out");
}

void warn_outside_limits(const Arm& arm, const Configuration& q) {
  for (const std::string& sentence : limit_violations(arm, q)) {
    fmt::print(stderr, "beeline: warning: {}\n", sentence);
  }
}
