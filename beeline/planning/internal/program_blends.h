#pragma once

#include <beeline/planning/internal/program_refusal.h>

namespace beeline::internal {

/// A motion of a program that passes waypoints in blends with joint moves.
struct BlendedProgram {
  Trajectory trajectory;
  std::vector<PlannedMove> moves;
  std::vector<PlannedPart> planned;  ///< the parts that have no such blend
};

/// Whether moves of a program blend with joint moves.
bool has_joint_blends(const Program& program);

/// Returns the motion of a program that was planned with stops, with its blends with joint moves:
/// from one stop to the next as large as they are proved, if this is quicker. With a model, the arm
/// in its scene before the program, they also keep its clearance.
BlendedProgram with_joint_blends(const PlannedProgram& planned, const CollisionModel* model,
                                 BudgetMeter& budget);

/// Sets what became of the blends with joint moves of a motion that stops there.
void set_stops(const Program& program, std::vector<PlannedMove>& moves);

}  // namespace beeline::internal
