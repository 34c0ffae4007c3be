#pragma once

#include <optional>

#include <beeline/planning/internal/program_refusal.h>
#include <beeline/timing/internal/blended_path.h>

namespace beeline::internal {

/// Moves of a program from one stop to the next, or a part of them.
struct MoveRange {
  std::size_t first = 0, last = 0;
};

/// The joint path of a planned program along lines that the tool follows without a stop.
struct PlannedLines {
  std::size_t part = 0;                             ///< of the program
  std::size_t first_segment = 0, last_segment = 0;  ///< of the part
  LimitedPath limited = {};  ///< with the limits of the tool's speed, one for each segment
};

/// Returns the joint path along the lines of some moves of one part, on the branch of the planned
/// motion. None if no configurations are found near it, or the budget ends.
std::optional<PlannedLines> planned_lines(const PlannedProgram& planned, const MoveRange& moves,
                                          BudgetMeter& budget);

}  // namespace beeline::internal
