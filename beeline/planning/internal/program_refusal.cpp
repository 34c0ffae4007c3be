#include <algorithm>

#include <beeline/kinematics/internal/deviation_reason.h>
#include <beeline/planning/internal/program_refusal.h>
#include <beeline/trajectory/internal/append.h>

namespace beeline::internal {
namespace {

/// The move during or before which sample k is.
std::size_t move_at(const std::vector<PlannedMove>& moves, std::size_t k) {
  std::size_t move = 0;
  while (move + 1 < moves.size() && moves[move].end <= k) ++move;
  return move;
}

/// The deviation of the tool from the path of a part.
Deviation deviation_of(const PlannedProgram& program, const PlannedPart& planned,
                       BudgetMeter& budget) {
  const std::size_t end = planned.begin + planned.path_parameters.size() - 1;
  return path_deviation(program.arm, samples_between(program.trajectory, planned.begin, end),
                        planned.path_parameters, program.parts[planned.part].route.path,
                        *program.options.task, budget.part())
      .bound;
}

}  // namespace

std::size_t refused_move(const Verification& found, std::size_t moves) {
  const std::vector<std::size_t>& ends = found.arrivals;
  const auto after = std::upper_bound(ends.begin(), ends.end(), found.sample);
  return std::min(static_cast<std::size_t>(after - ends.begin()), moves - 1);
}

ProgramRefusal path_refusal(const Program& program, const ProgramPart& part,
                            const PathMotion& refused) {
  ProgramRefusal why{part.first, refused.status, refused.reason};
  if (const ReasonValue* const segment = why.reason.find(ReasonField::segment)) {
    why.move = part.moves[std::get<std::size_t>(*segment) - 1];
  } else if (part.first > 0 && why.reason.has(ReasonField::beginning)) {
    std::erase_if(why.reason.fields,
                  [](const auto& entry) { return entry.first == ReasonField::beginning; });
    why.move = part.first - 1;  // its waypoint
  } else {
    why.name = part_name(program, part);
  }
  return why;
}

std::optional<ProgramRefusal> program_refusal(const PlannedProgram& planned,
                                              const Verification& found, BudgetMeter& budget) {
  const PathMotionOptions& options = planned.options;
  for (const PlannedPart& path : planned.planned) {
    const Deviation bound = deviation_of(planned, path, budget);
    if (!budget.complete()) return std::nullopt;
    if (within(bound, {options.tolerance, options.orientation_tolerance})) continue;
    const ProgramPart& part = planned.parts[path.part];
    return ProgramRefusal{part.first, MotionStatus::not_proved,
                          deviation_reason(ReasonCode::path_not_proved, bound),
                          part_name(planned.program, part)};
  }
  const auto fault = first_joint_fault(planned.arm, planned.trajectory, {}, budget.part());
  if (!budget.complete()) return std::nullopt;
  const std::size_t move = move_at(planned.moves, fault ? fault->sample : found.sample);
  if (!fault) return ProgramRefusal{move, MotionStatus::not_proved, found.reason};
  Reason reason = fault->reason;
  reason.set(ReasonField::time, planned.trajectory.times[fault->sample]);
  return ProgramRefusal{move, MotionStatus::outside_limits, std::move(reason)};
}

}  // namespace beeline::internal
