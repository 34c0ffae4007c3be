#pragma once

#include <string>

#include "pose_argument.h"

namespace beeline::command {

/// The poses in the world of the file of an option such as --through, with this text, given in the
/// frame of --work, each in a form that fits the arm and the task.
PoseList waypoints_from(const std::string& text, const std::string& path, const Arm& arm,
                        const TaskArgument& task, const WorkArgument& work,
                        const UnitArgument& unit, const std::string& option = "--through");

/// --through.
Option through_option(std::string help, std::string* target);

}  // namespace beeline::command
