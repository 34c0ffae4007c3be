#pragma once

#include <functional>
#include <optional>
#include <string>

#include <beeline/error.h>
#include <beeline/io/text/pose_list.h>
#include <beeline/planning/program.h>

namespace beeline {

/// Returns the program of the rows of a file. A pose without `relative` is world_T_tool.
///
/// - A pose relative to `previous`, such as a retreat, is in the tool frame of the waypoint before
///   it. A pose relative to `next`, such as an approach, is in the tool frame of the next waypoint
///   that is not relative. Before the first waypoint, `previous` is `start`, the tool's pose where
///   the motion starts.
/// - A row with the motion `attach` or `detach` is an attachment, or its end. It is at the waypoint
///   of the row before it, or at the start.
/// - A row with the motion `via` is a position on the arc to the next row, which is an arc.
/// - `configuration` returns the configuration that an item of the column q means.
///
/// Throws FileError for a relative row without such a waypoint, for a via row that no arc follows,
/// for an arc without a via row, for a part that is attached already or that is not attached where
/// it is detached, for any program that move_program() refuses, and if
/// `configuration` throws.
Program program_of(const Arm& arm, const ProgramRows& rows,
                   const std::function<Configuration(const std::string&)>& configuration,
                   const std::optional<Pose>& start = std::nullopt);

}  // namespace beeline
