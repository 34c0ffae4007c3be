#pragma once

#include <optional>
#include <vector>

#include <beeline/planning/internal/program_refusal.h>

namespace beeline::internal {

/// A program with its parts.
struct DividedProgram {
  const Arm& arm;
  const Program& program;
  const PathMotionOptions& options;  ///< with a task
  const std::vector<ProgramPart>& parts;
  const CollisionModel* model;  ///< the arm in its scene before the program; none: no scene
};

/// Completes the motion of a program that was planned with stops, as far as its trajectory and
/// moves: replaces stops by blends with joint moves and proves the whole by verify(), as a check of
/// its file does: the moves one by one, and that each continues the one before. With a model,
/// blends keep the clearance. Returns why it is refused. If the budget ends, the motion is not
/// complete.
std::optional<ProgramRefusal> complete_program(const DividedProgram& program,
                                               std::vector<PlannedPart> planned,
                                               BudgetMeter& budget, ProgramMotion& motion);

}  // namespace beeline::internal
