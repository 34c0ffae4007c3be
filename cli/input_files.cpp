#include "input_files.h"

#include <algorithm>
#include <fmt/format.h>

#include <beeline/error.h>

#include "command/streams.h"

namespace beeline::command {

PoseList waypoints_from(const std::string& text, const std::string& path, const Arm& arm,
                        const TaskArgument& task, const WorkArgument& work,
                        const UnitArgument& unit, const std::string& option) {
  const WrittenPose world_T_work = work.read(arm, unit);
  PoseList list = poses_from_csv(text, path, unit.pose_format(triple_of(arm)));
  if (!list.has_header)
    warn(path + " has no header; its columns are read as " + listed(list.columns));
  if (list.poses.size() > max_poses) {
    throw FileError(path, list.lines[max_poses],
                    fmt::format("has {} poses; a path has at most {}: divide it", list.poses.size(),
                                max_poses));
  }
  warn_of_angle(option + " " + path, list.max_angle, list.form, unit);
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
