#pragma once

#include <span>
#include <string>
#include <vector>

#include <beeline/io/text/pose_list.h>

#include "arguments.h"

namespace beeline::command {

/// What three numbers without names mean for the arm: x,y,theta if it is planar, otherwise x,y,z.
Triple triple_of(const Arm& arm);

/// A pose of the arm as typed for `option`. Throws Error that begins with the option.
WrittenPose parse_pose_option(const Arm& arm, const std::string& option, const std::string& text,
                              const UnitArgument& unit);

/// The pose of a frame of the arm's cell as typed for `option`, in the same forms; a position has
/// no rotation. Throws Error that begins with the option.
WrittenPose parse_frame_option(const Arm& arm, const std::string& option, const std::string& text,
                               const UnitArgument& unit);

/// --work: the frame in which poses are given.
struct WorkArgument {
  std::string text = {};

  Option option();
  /// world_T_work, planar if it was given as x,y,theta or not at all.
  WrittenPose read(const Arm& arm, const UnitArgument& unit) const;
};

/// The pose in the world of a pose in the frame of --work. A planar pose of a planar arm is in the
/// arm's plane.
WrittenPose in_world(const Arm& arm, const WrittenPose& world_T_work, const WrittenPose& pose);

/// The distance from the arm, m, of a pose in the world that is far out of its reach in metres and
/// within it in millimetres; 0 for another pose.
double distance_in_millimetres(const Arm& arm, const Pose& pose);
/// The same of a pose relative to a frame at the tool, such as a tool or a relative row: its
/// distance from this frame.
double offset_in_millimetres(const Arm& arm, const Pose& pose);

/// The distance of the base from the world's origin, m, if it is probably in millimetres: beyond
/// 100 m; else 0.
double mount_in_millimetres(const Pose& world_T_base);

/// Warns on stderr that positions read with `option` are probably in millimetres, as one of them is
/// this far away; of distance 0 nothing.
void warn_of_distance(const std::string& option, double distance, const UnitArgument& unit);

/// The same of the first such pose.
void warn_of_positions(const std::string& option, const Arm& arm, std::span<const Pose> poses,
                       const UnitArgument& unit);

/// Warns on stderr how a table of poses without a header is read.
void warn_of_missing_header(const std::string& path, const std::vector<std::string>& columns);

/// Throws Error for a planar pose given to an arm that is not planar; for a position given to a
/// task with an orientation; and, without --task, for a spatial pose outside the plane of a planar
/// arm, whose height and tilt would be ignored.
void check_pose_form(const Arm& arm, const WrittenPose& pose, const TaskArgument& task);

/// The poses in the world of the file of an option such as --through, with this text, given in the
/// frame of --work, each in a form that fits the arm and the task.
PoseList waypoints_from(const std::string& text, const std::string& path, const Arm& arm,
                        const TaskArgument& task, const WorkArgument& work,
                        const UnitArgument& unit, const std::string& option = "--through");

/// --through.
Option through_option(std::string help, std::string* target);

}  // namespace beeline::command
