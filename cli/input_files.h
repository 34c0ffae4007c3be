#pragma once

#include <string>

#include <beeline/trajectory/trajectory.h>

#include "pose_argument.h"

/// The trajectory of a file with its joints in the arm's order. Throws FileError if it does not fit
/// the arm or has a value or a time that is out of range.
beeline::Trajectory checked_for_arm(const std::string& path, const beeline::Arm& arm,
                                    const beeline::Trajectory& recorded);

/// A recorded trajectory, its joints in the arm's order. A file without an ending, such as a pipe,
/// is .json if it begins with a brace and otherwise .csv.
beeline::Trajectory read_recording(const std::string& path, const beeline::Arm& arm);

/// The poses in the world of the file of an option such as --through, with this text, given in the
/// frame of --work, each in a form that fits the arm and the task.
beeline::PoseList waypoints_from(const std::string& text, const std::string& path,
                                 const beeline::Arm& arm, const TaskArgument& task,
                                 const WorkArgument& work, const UnitArgument& unit,
                                 const std::string& option = "--through");

/// --through.
Option through_option(std::string help, std::string* target);

/// FILE, a trajectory.
Positional trajectory_argument(std::string name, std::string help, std::string* target);
