#pragma once

#include <string>

#include <beeline/trajectory/trajectory.h>

#include "arguments.h"

/// A recorded trajectory, its joints in the arm's order.
beeline::Trajectory read_recording(const std::string& path, const beeline::Arm& arm);

/// The poses of the file of --through, each in a form that fits the arm and the task.
beeline::PoseList read_waypoints(const std::string& path, const beeline::Arm& arm,
                                 const TaskArgument& task, const UnitArgument& unit);

/// --through.
Option through_option(std::string help, std::string* target);

/// FILE, a trajectory.
Positional trajectory_argument(std::string name, std::string help, std::string* target);
