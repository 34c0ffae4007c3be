#include "input_files.h"

#include <cmath>
#include <fmt/format.h>

#include <beeline/error.h>
#include <beeline/model/internal/ranges.h>
#include <beeline/path/internal/checked_poses.h>
#include <beeline/record/trajectory_file.h>

#include "command/streams.h"

using namespace beeline;

namespace {

constexpr double max_time = 1e10;  // seconds: times since 1970 are accepted

void check_times(const std::string& path, const std::vector<double>& times) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (std::abs(times[i]) <= max_time) continue;
    throw FileError(path, 0,
                    fmt::format("sample {}: the time {} s is outside -{} to {} s", i + 1,
                                number(times[i]), number(max_time), number(max_time)));
  }
}

void check_size(const std::string& path, const Arm& arm, const std::vector<Configuration>& column,
                double largest) {
  for (std::size_t i = 0; i < column.size(); ++i) {
    for (int k = 0; k < arm.dof(); ++k) {
      if (std::abs(column[i][k]) <= largest) continue;
      throw FileError(
          path, 0,
          fmt::format("sample {}: joint {} has the value {}; the largest accepted is {}", i + 1,
                      arm.joint_of(k).name, number(column[i][k]), number(largest)));
    }
  }
}

}  // namespace

Trajectory checked_for_arm(const std::string& path, const Arm& arm, const Trajectory& recorded) {
  Trajectory trajectory;
  try {
    trajectory = matched_to(arm, recorded);
  } catch (const Error& error) {
    throw FileError(path, 0, error.what());
  }
  check_times(path, trajectory.times);
  check_size(path, arm, trajectory.positions, internal::max_position_limit);
  check_size(path, arm, trajectory.velocities, internal::max_rate);
  check_size(path, arm, trajectory.accelerations, internal::max_rate);
  return trajectory;
}

Trajectory read_recording(const std::string& path, const Arm& arm) {
  return checked_for_arm(path, arm, read_trajectory(path));
}

PoseList waypoints_from(const std::string& text, const std::string& path, const Arm& arm,
                        const TaskArgument& task, const WorkArgument& work,
                        const UnitArgument& unit, const std::string& option) {
  const WrittenPose world_T_work = work.read(arm, unit);
  PoseList list = poses_from_csv(text, path, unit.pose_format(triple_of(arm)));
  if (!list.has_header)
    warn(path + " has no header; its columns are read as " + listed(list.columns));
  if (list.poses.size() > internal::max_poses) {
    throw FileError(path, list.lines[internal::max_poses],
                    fmt::format("has {} poses; a path has at most {}: divide it", list.poses.size(),
                                internal::max_poses));
  }
  warn_of_angle(option + " " + path, list.max_angle, list.form, unit);
  for (std::size_t i = 0; i < list.poses.size(); ++i) {
    try {
      const WrittenPose pose =
          in_world(arm, world_T_work,
                   {.pose = list.poses[i], .planar = list.planar, .oriented = list.oriented});
      check_pose_form(arm, pose, task);
      list.poses[i] = pose.pose;
      if (i == 0) warn_of_position(option + " " + path, arm, pose.pose, unit);
    } catch (const Error& error) {
      throw FileError(path, list.lines[i], error.what());
    }
  }
  return list;
}

Option through_option(std::string help, std::string* target) {
  return {.name = "--through",
          .value = "FILE",
          .help = std::move(help) +
                  " A .csv file with the header x,y,theta (planar arms), x,y,z,roll,pitch,yaw, "
                  "x,y,z,qw,qx,qy,qz, x,y,z,rx,ry,rz, x,y,z,A,B,C or m11,m12,...,m44, or with "
                  "--task position x,y,z or x,y, and a pose in each row; or a program, whose rows "
                  "also have motion, relative, q, speed, blend or dwell (see `beeline help line`).",
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
