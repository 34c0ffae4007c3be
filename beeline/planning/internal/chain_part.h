#pragma once

#include <optional>

#include <beeline/planning/internal/planned_lines.h>
#include <beeline/planning/internal/program_refusal.h>
#include <beeline/timing/internal/blended_path.h>

namespace beeline::internal {

/// The joint path of one joint move of a program, or along lines from one joint move or stop to the
/// next.
struct ChainPart {
  MoveRange moves;
  bool joint = false;
  LimitedPath limited = {};
  // Of lines: the first and last one, and the parts of the joint path along them.
  std::optional<Line> begin = std::nullopt, end = std::nullopt;
  double begin_length = 0, end_length = 0;
};

/// Returns the joint path of moves of a program that was planned with stops. None if the joints do
/// not move, no joint path is found, or the budget ends.
std::optional<ChainPart> chain_part(const PlannedProgram& planned, const MoveRange& moves,
                                    BudgetMeter& budget);

/// Returns the radius of the largest blend between two parts that is within its deviation, follows
/// the lines beside it and is within the joint limits at some samples. 0, a stop, if there is none.
double largest_radius(const PlannedProgram& planned, const ChainPart& before,
                      const ChainPart& after);

/// Adds a grid point, and so a sample without a rate, in the middle between any two.
void add_grid_points(JointPath& path);

}  // namespace beeline::internal
