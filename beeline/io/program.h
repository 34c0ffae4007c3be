#pragma once

#include <functional>
#include <optional>
#include <string>

#include <beeline/error.h>
#include <beeline/io/text/pose_list.h>
#include <beeline/planning/program.h>

namespace beeline {

/// Returns the program of the rows of a file, whose poses without `relative` are world_T_tool.
///
/// - A pose relative to `previous` is in the tool frame of the waypoint before it, as that of a
///   retreat; one relative to `next` is in the tool frame of the next waypoint that is not
///   relative, as that of an approach. Before the first waypoint, `previous` is `start`, the tool's
///   pose where the motion starts.
/// - A row with the motion `via` is a position on the arc to the next row, which is an arc.
/// - `configuration` returns the configuration that an item of the column q means.
///
/// Throws FileError for a relative row without such a waypoint, a via row that no arc follows, an
/// arc without via row, and the rest of what move_program() refuses; and where `configuration`
/// throws.
Program program_of(const Arm& arm, const ProgramRows& rows,
                   const std::function<Configuration(const std::string&)>& configuration,
                   const std::optional<Pose>& start = std::nullopt);

}  // namespace beeline
