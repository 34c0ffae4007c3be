#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/certificate/verify.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/planning/internal/program_parts.h>

namespace beeline::internal {

/// A part that is a path, in the trajectory of a program.
struct PlannedPart {
  std::size_t part = 0, begin = 0;           ///< index of the part, and its first sample
  std::vector<double> path_parameters = {};  ///< of its samples
};

/// A trajectory that was planned for a program.
struct PlannedProgram {
  const Arm& arm;
  const Program& program;
  const Trajectory& trajectory;
  const std::vector<PlannedMove>& moves;
  const std::vector<ProgramPart>& parts;
  const std::vector<PlannedPart>& planned;
  const PathMotionOptions& options;  ///< with a task
};

/// The move at which verify() refuses a program of `moves` moves: the first that ends after the
/// sample of the fault.
std::size_t refused_move(const Verification& found, std::size_t moves);

/// Why a program has no motion.
struct ProgramRefusal {
  std::size_t move = 0;  ///< the move that fails
  MotionStatus status = MotionStatus::not_proved;
  Reason reason = {};
  std::string name = {};  ///< of the part with the move, for the reason; empty: the move's own
};

/// Returns why the path of a part is refused: by its motion.
ProgramRefusal path_refusal(const Program& program, const ProgramPart& part,
                            const PathMotion& refused);

/// Returns why verify() finds that a trajectory is no motion of its program: the tool is off the
/// path of a part, a joint is beyond its limits, or what verify() says. None if the budget ends.
std::optional<ProgramRefusal> program_refusal(const PlannedProgram& planned,
                                              const Verification& found, BudgetMeter& budget);

}  // namespace beeline::internal
