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

/// Whether a motion is complete and proved, or why it is refused. Neither, if the budget ends.
struct Completion {
  bool proved = false;
  std::optional<ProgramRefusal> refusal = std::nullopt;
};

/// Completes the motion of a program that was planned with stops, as far as its trajectory and
/// moves: proves it by verify(), as a check of its file does, and replaces stops by blends with
/// joint moves as far as the whole is proved with them. With a model, blends keep the clearance. If
/// the budget ends after the motion with stops is proved, it has the blends that are proved by
/// then, and ProgramMotion::search_ending says so. If it is not proved with stops either, nothing
/// is known, and ProgramMotion::search_ending says why.
Completion complete_program(const DividedProgram& program, const std::vector<PlannedPart>& planned,
                            BudgetMeter& budget, ProgramMotion& motion);

}  // namespace beeline::internal
