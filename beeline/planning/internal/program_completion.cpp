#include <utility>

#include <beeline/planning/internal/motion_request.h>
#include <beeline/planning/internal/program_blends.h>
#include <beeline/planning/internal/program_completion.h>
#include <beeline/planning/internal/program_trajectory.h>
#include <beeline/trajectory/internal/tool_speed.h>

namespace beeline::internal {
namespace {

PlannedProgram planned_with(const DividedProgram& program, const std::vector<PlannedPart>& planned,
                            const ProgramMotion& motion) {
  return {program.arm,   program.program, motion.trajectory, motion.moves,
          program.parts, planned,         program.options};
}

Verification proof_of(const DividedProgram& program, const Trajectory& trajectory,
                      BudgetMeter& budget) {
  VerifyOptions options = proof_options(program.options);
  options.budget = budget.part();
  return verify(program.arm, trajectory, program.program, options);
}

/// Replaces stops by blends with joint moves, if the motion is proved with them.
std::optional<Verification> blend(const DividedProgram& program, std::vector<PlannedPart>& planned,
                                  BudgetMeter& budget, ProgramMotion& motion) {
  set_stops(program.program, motion.moves);
  BlendedProgram blended =
      with_joint_blends(planned_with(program, planned, motion), program.model, budget);
  if (!budget.complete()) return std::nullopt;
  Verification found = proof_of(program, blended.trajectory, budget);
  if (!found) return std::nullopt;
  motion.trajectory = std::move(blended.trajectory);
  motion.moves = std::move(blended.moves);
  planned = std::move(blended.planned);
  for (std::size_t i = 0; i < motion.moves.size(); ++i) {
    if (!is_passed(program.program, i)) continue;
    motion.moves[i].end = motion.moves[i + 1].begin = found.arrivals[i];
  }
  return found;
}

}  // namespace

std::optional<ProgramRefusal> complete_program(const DividedProgram& program,
                                               std::vector<PlannedPart> planned,
                                               BudgetMeter& budget, ProgramMotion& motion) {
  std::optional<Verification> found;
  if (has_joint_blends(program.program)) found = blend(program, planned, budget, motion);
  if (!budget.complete()) return std::nullopt;
  if (!found) found = proof_of(program, motion.trajectory, budget);
  if (!budget.complete()) return std::nullopt;
  if (!*found) return program_refusal(planned_with(program, planned, motion), *found, budget);
  motion.deviation = std::move(found->deviation);
  for (PlannedMove& move : motion.moves) {
    for (std::size_t k = move.begin; k < move.end; ++k) {
      grow(move.bound, motion.deviation.interval_bounds[k]);
    }
    move.tool_speed =
        tool_speed_bound(program.arm, samples_between(motion.trajectory, move.begin, move.end));
  }
  motion.limits = limit_usage(program.arm, motion.trajectory, budget.part());
  return std::nullopt;
}

}  // namespace beeline::internal
