#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/certificate/verify.h>
#include <beeline/control/joint.h>
#include <beeline/io/text/json.h>
#include <beeline/planning/branch.h>
#include <beeline/trajectory/limit_usage.h>
#include <beeline/trajectory/trajectory.h>

#include "arguments.h"

namespace beeline::command {

/// Reports of a motion that several verbs print: as text, and as members added to a JSON document.

/// The deviation of a motion from its path, which begins after the recovery: at the samples,
/// measured, proved.
std::string deviation_text(const PathDeviation& deviation, Interpolation interpolation,
                           const UnitArgument& unit,
                           const std::optional<Recovery>& recovery = std::nullopt);
/// Members deviation_... and orientation_...; null if there is no deviation to report.
Json deviation_members(const std::optional<PathDeviation>& deviation, const UnitArgument& unit);

/// An inverse condition number, with three significant digits.
std::string condition_text(double inverse_condition);

/// The largest distance of a joint from the middle of its range, with the joint and the time.
std::string position_text(const LimitUsage& limits);

/// The largest fraction of each limit of a derivative that a motion uses, with joint and time.
std::string limits_text(const LimitUsage& limits);
Json json_limits(const LimitUsage& limits);

/// The radii of the blends at the inner waypoints of a path in joint space.
Json json_blends(const std::vector<double>& radii);

/// The jump of velocity with which a motion begins; nothing, and null, for a motion from rest.
std::string start_jump_text(const Arm& arm, const StartJump& jump, const UnitArgument& unit);
Json json_start_jump(const Arm& arm, const StartJump& jump, const UnitArgument& unit);

/// --limit-tolerance, and the line that reports it where it is above 0.
Option limit_tolerance_option(double* target);
std::string limit_tolerance_text(double limit_tolerance);

/// The differences of each joint and of the tool between two recordings.
std::string difference_text(const Arm& arm, const TrajectoryDifference& difference,
                            const UnitArgument& unit);
/// Members joints, position, position_time, orientation, orientation_time, overlap, longer.
Json difference_members(const Arm& arm, const TrajectoryDifference& difference,
                        const UnitArgument& unit);

/// The outcome of each branch along a path.
std::string branches_text(const Arm& arm, const std::vector<Branch>& branches,
                          const UnitArgument& unit);
Json json_branches(const Arm& arm, const std::vector<Branch>& branches, const UnitArgument& unit);

}  // namespace beeline::command
