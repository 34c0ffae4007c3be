#include "pose_argument.h"

#include <cmath>
#include <fmt/format.h>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/pose/se2.h>

#include "command/streams.h"

namespace beeline::command {
namespace {

/// The distance of a position from the centre if it is far outside the sphere in metres, and within
/// it in millimetres; else 0.
double far_distance(const Arm::Reach& sphere, const Pose& pose) {
  const auto note = distance_note(sphere, pose);
  return note ? note->value : 0;
}

}  // namespace

Triple triple_of(const Arm& arm) { return arm.planar() ? Triple::planar : Triple::position; }

Option WorkArgument::option() {
  return Option("--work POSE",
                "The frame that poses are given in: its pose in the world, as --mount. Answers are "
                "in the world; positions in the reasons of `line` are in this frame.",
                &text);
}

WrittenPose WorkArgument::read(const Arm& arm, const UnitArgument& unit) const {
  if (text.empty()) return {.pose = Pose::Identity(), .planar = true};
  return parse_frame_option(arm, "--work", text, unit);
}

WrittenPose parse_pose_option(const Arm& arm, const std::string& option, const std::string& text,
                              const UnitArgument& unit) {
  try {
    WrittenPose written = parse_pose(text, unit.pose_format(triple_of(arm)));
    written.pose = checked_pose(written.pose);
    warn_of_angle(option, written.max_angle, written.form, unit);
    return written;
  } catch (const Error& error) {
    // An error of a number begins with the argument's name, and the number's position follows.
    if (error.argument() == "pose") throw Error(error.message_for(option));
    throw error.behind(option + ": ");
  }
}

WrittenPose parse_frame_option(const Arm& arm, const std::string& option, const std::string& text,
                               const UnitArgument& unit) {
  const WrittenPose frame = parse_pose_option(arm, option, text, unit);
  if (!frame.planar || arm.planar()) return frame;
  throw Error(option + ": x,y is for planar arms; " + arm.name() +
              " needs x,y,z, x,y,z,roll,pitch,yaw or x,y,z,qw,qx,qy,qz");
}

WrittenPose in_world(const Arm& arm, const WrittenPose& world_T_work, const WrittenPose& pose) {
  WrittenPose world = pose;
  world.pose = world_T_work.pose * pose.pose;
  world.planar = world_T_work.planar && pose.planar;
  if (world.planar && arm.planar()) {
    world.pose.translation().z() = pose_in_plane(arm, {}).translation().z();
  }
  return world;
}

double distance_in_millimetres(const Arm& arm, const Pose& pose) {
  return far_distance(arm.reach(), pose);
}

double offset_in_millimetres(const Arm& arm, const Pose& pose) {
  return far_distance({.radius = arm.reach().radius}, pose);
}

double mount_in_millimetres(const Pose& world_T_base) {
  constexpr double far = 100;  // metres
  const double distance = world_T_base.translation().norm();
  return distance > far ? distance : 0;
}

void warn_of_distance(const std::string& option, double distance, const UnitArgument& unit) {
  if (unit.millimetres || distance == 0) return;
  warn(sentence({.kind = PoseNoteKind::likely_millimetres, .value = distance}, option,
                OptionStyle::command));
}

void warn_of_positions(const std::string& option, const Arm& arm, std::span<const Pose> poses,
                       const UnitArgument& unit) {
  for (const Pose& pose : poses) {
    const double distance = distance_in_millimetres(arm, pose);
    if (distance > 0) return warn_of_distance(option, distance, unit);
  }
}

void check_pose_form(const Arm& arm, const WrittenPose& written, const TaskArgument& task) {
  if (written.planar && !arm.planar()) {
    throw Error(std::string(written.oriented ? "x,y,theta" : "x,y") + " is for planar arms; " +
                arm.name() + " needs x,y,z,roll,pitch,yaw or x,y,z,qw,qx,qy,qz" +
                (task.offered ? ", or x,y,z with --task position" : ""));
  }
  if (!written.oriented && task.read(arm).orientations() > 0) {
    throw Error(std::string(written.planar ? "x,y" : "x,y,z") + " gives no orientation; give " +
                (task.offered ? "--task position, or " : "") +
                (arm.planar() ? "x,y,theta" : "x,y,z,roll,pitch,yaw or x,y,z,qw,qx,qy,qz"));
  }
  if (written.planar || !arm.planar() || !task.text.empty()) return;
  try {
    check_in_plane(arm, written.pose, "the pose", task.offered);
  } catch (const Error& error) {
    if (error.argument() != "task") throw;
    throw Error(error.message_for("--task"));
  }
}

void warn_of_missing_header(const std::string& path, const std::vector<std::string>& columns) {
  warn(sentence({.kind = PoseNoteKind::no_header, .columns = columns}, path));
}

PoseList waypoints_from(const std::string& text, const std::string& path, const Arm& arm,
                        const TaskArgument& task, const WorkArgument& work,
                        const UnitArgument& unit, const std::string& option) {
  const WrittenPose world_T_work = work.read(arm, unit);
  const PoseFormat format = unit.pose_format(triple_of(arm));
  PoseList list = poses_from_csv(text, path, format);
  if (list.poses.size() > max_poses) {
    throw FileError(path, list.lines[max_poses],
                    fmt::format("has {} poses; a path has at most {}: divide it", list.poses.size(),
                                max_poses));
  }
  for (const PoseNote& note : notes_on(list, format)) {
    const bool of_file = note.kind == PoseNoteKind::no_header;
    warn(sentence(note, of_file ? path : option + " " + path, OptionStyle::command));
  }
  for (std::size_t i = 0; i < list.poses.size(); ++i) {
    try {
      const WrittenPose pose =
          in_world(arm, world_T_work,
                   {.pose = list.poses[i], .planar = list.planar, .oriented = list.oriented});
      check_pose_form(arm, pose, task);
      list.poses[i] = pose.pose;
    } catch (const Error& error) {
      throw FileError(path, list.lines[i], error.what());
    }
  }
  warn_of_positions(option + " " + path, arm, list.poses, unit);
  return list;
}

Option through_option(std::string help, std::string* target) {
  return Option(
      "--through FILE",
      std::move(help) +
          " A .csv file with the header x,y,theta (planar arms), x,y,z,roll,pitch,yaw, "
          "x,y,z,qw,qx,qy,qz, x,y,z,rx,ry,rz, x,y,z,A,B,C or m11,m12,...,m44, or with --task "
          "position x,y,z or x,y, and a pose in each row; or a program, whose rows also have "
          "motion, relative, q, speed, blend or dwell (see `beeline help line`).",
      target, {.required = true});
}

}  // namespace beeline::command
