#include "pose_argument.h"

#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>

using namespace beeline;

Option WorkArgument::option() {
  return {.name = "--work",
          .value = "POSE",
          .help = "The frame that poses are given in: its pose in the world, as --mount.",
          .target = &text};
}

WrittenPose WorkArgument::read(const Arm& arm, const UnitArgument& unit) const {
  if (text.empty()) return {.pose = Pose::Identity(), .planar = true};
  return parse_frame_option(arm, "--work", text, unit);
}

WrittenPose parse_pose_option(const std::string& option, const std::string& text,
                              const UnitArgument& unit) {
  try {
    const WrittenPose written = parse_pose(text, unit.angle_unit());
    warn_of_angle(option, written.max_angle, unit);
    return {checked_pose(written.pose), written.planar};
  } catch (const Error& error) {
    const std::string message = error.what();
    const bool prefixed = message.starts_with("pose:");  // the number's position follows
    throw Error(option + (prefixed ? message.substr(4) : ": " + message));
  }
}

WrittenPose parse_frame_option(const Arm& arm, const std::string& option, const std::string& text,
                               const UnitArgument& unit) {
  const bool translation = !arm.planar() && std::count(text.begin(), text.end(), ',') == 2;
  return parse_pose_option(option, text + (translation ? ",0,0,0" : ""), unit);
}

WrittenPose in_world(const WrittenPose& world_T_work, const WrittenPose& pose) {
  return {.pose = world_T_work.pose * pose.pose, .planar = world_T_work.planar && pose.planar};
}

void check_pose_form(const Arm& arm, const WrittenPose& written, const TaskArgument& task) {
  if (written.planar && !arm.planar()) {
    throw Error("x,y,theta is for planar arms; " + arm.name() +
                " needs x,y,z,roll,pitch,yaw or x,y,z,qw,qx,qy,qz");
  }
  if (written.planar || !arm.planar() || !task.text.empty()) return;
  constexpr double tolerance = 1e-6;  // metres, and of the unit vector z
  const double height = forward_kinematics(arm, middle_configuration(arm)).translation().z();
  const bool in_plane = std::abs(written.pose.translation().z() - height) < tolerance &&
                        (written.pose.linear().col(2) - Vector3::UnitZ()).norm() < tolerance;
  if (in_plane) return;
  throw Error("the pose is outside the plane z = " + number(height) + " m of arm " + arm.name() +
              "; give x,y,theta, or --task planar to ignore height and tilt");
}
