#include "input_files.h"

#include <fmt/core.h>

#include <beeline/error.h>
#include <beeline/record/trajectory_file.h>

using namespace beeline;

Trajectory read_recording(const std::string& path, const Arm& arm) {
  const Trajectory recorded = read_trajectory(path);
  try {
    return matched_to(arm, recorded);
  } catch (const Error& error) {
    throw FileError(path, 0, error.what());
  }
}

PoseList read_waypoints(const std::string& path, const Arm& arm, const TaskArgument& task,
                        const UnitArgument& unit) {
  PoseList list = read_poses(path, unit.angle_unit());
  for (std::size_t i = 0; i < list.poses.size(); ++i) {
    check_pose_form(arm, {list.poses[i], list.planar}, task,
                    fmt::format("{}:{}", path, list.lines[i]));
  }
  return list;
}

Option through_option(std::string help, std::string* target) {
  return {.name = "--through",
          .value = "FILE",
          .help = std::move(help) +
                  " A .csv file with the header x,y,theta (planar arms), x,y,z,roll,pitch,yaw or "
                  "x,y,z,qw,qx,qy,qz, and a pose in each row.",
          .target = target,
          .required = true,
          .completes = Completes::file};
}

Positional trajectory_argument(std::string name, std::string help, std::string* target) {
  return {.name = std::move(name),
          .help = std::move(help),
          .target = target,
          .completes = Completes::file};
}
