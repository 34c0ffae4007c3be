#include <algorithm>
#include <utility>

#include <beeline/planning/internal/motion_request.h>
#include <beeline/planning/internal/program_blends.h>
#include <beeline/planning/internal/program_completion.h>
#include <beeline/trajectory/internal/append.h>
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
  options.recover = program.options.recover;
  options.budget = budget.part();
  return verify(program.arm, trajectory, program.program, options);
}

/// Sets the bounds of a proved motion.
void set_bounds(const DividedProgram& program, Verification proof, BudgetMeter& budget,
                ProgramMotion& motion) {
  motion.deviation = std::move(proof.deviation);
  motion.recovery = std::move(proof.recovery);
  for (PlannedMove& move : motion.moves) {
    move.bound = {};
    for (std::size_t k = move.begin; k < move.end; ++k) {
      grow(move.bound, motion.deviation.interval_bounds[k]);
    }
    move.tool_speed = tool_speed_bound(
        program.arm, samples_between(motion.trajectory, move.begin, move.end), budget);
  }
  motion.limits = limit_usage(program.arm, motion.trajectory, budget.part());
}

/// Removes the motion of the moves that are refused, or all.
void remove_refused(const DividedProgram& program, const Verification& found,
                    std::vector<BlendedMoves>& motions) {
  const std::size_t refused = refused_move(found, program.program.moves.size());
  const std::size_t before = motions.size();
  std::erase_if(motions, [&](const BlendedMoves& one) {
    return one.moves.first <= refused && refused <= one.moves.last;
  });
  if (motions.size() == before) motions.clear();
}

/// Replaces stops by blends with joint moves as far as the motion is proved with them before the
/// budget ends. The search leaves an amount for this last proof. Returns whether there are blends.
bool blend(const DividedProgram& program, const std::vector<PlannedPart>& planned,
           const SpentBudget& last_proof, BudgetMeter& budget, ProgramMotion& motion) {
  constexpr int max_refusals = 4;
  const PlannedProgram with_stops = planned_with(program, planned, motion);
  BudgetMeter searching(budget.part_leaving(last_proof));
  std::vector<BlendedMoves> motions = blended_moves(with_stops, program.model, searching);
  motion.search_ending = searching.ending();
  for (int refusals = 0; refusals < max_refusals && !motions.empty(); ++refusals) {
    BlendedProgram blended = with_blends(with_stops, motions);
    Verification found = proof_of(program, blended.trajectory, budget);
    if (!budget.complete()) break;
    if (!found) {
      remove_refused(program, found, motions);
      continue;
    }
    ProgramMotion better = motion;
    better.trajectory = std::move(blended.trajectory);
    better.moves = std::move(blended.moves);
    for (std::size_t i = 0; i < better.moves.size(); ++i) {
      if (!is_passed(program.program, i)) continue;
      better.moves[i].end = better.moves[i + 1].begin = found.arrivals[i];
    }
    set_bounds(program, std::move(found), budget, better);
    if (!budget.complete()) break;
    motion = std::move(better);
    return true;
  }
  if (!budget.complete()) motion.search_ending = budget.ending();
  return false;
}

/// Three times the amount spent since a time: a motion with blends may have more samples, and a
/// proof that is refused is repeated.
SpentBudget for_last_proof(const SpentBudget& before, const SpentBudget& now) {
  return {3 * (now.work - before.work), 3 * (now.time - before.time)};
}

}  // namespace

Completion complete_program(const DividedProgram& program, const std::vector<PlannedPart>& planned,
                            BudgetMeter& budget, ProgramMotion& motion) {
  const SpentBudget before = budget.spent();
  Verification found = proof_of(program, motion.trajectory, budget);
  set_stops(program.program, motion.moves);
  const bool with_stops(found);
  if (with_stops) set_bounds(program, found, budget, motion);
  if (!budget.complete()) return {};
  const SpentBudget last_proof = for_last_proof(before, budget.spent());
  const bool blends =
      has_joint_blends(program.program) && blend(program, planned, last_proof, budget, motion);
  if (blends || with_stops) return {true};
  if (motion.search_ending != Ending::complete) return {};  // blends may have been proved
  return {false, program_refusal(planned_with(program, planned, motion), found, budget)};
}

}  // namespace beeline::internal
