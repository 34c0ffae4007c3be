#pragma once

#include <beeline/planning/internal/blend_chain.h>
#include <beeline/planning/internal/program_refusal.h>

namespace beeline::internal {

/// A motion of a program that passes waypoints in blends with joint moves.
struct BlendedProgram {
  Trajectory trajectory;
  std::vector<PlannedMove> moves;
};

/// Whether moves of a program blend with joint moves.
bool has_joint_blends(const Program& program);

/// Moves from one stop to the next with their motion, which replaces the planned one.
struct BlendedMoves {
  MoveRange moves;
  BlendedMotion motion;
  std::vector<std::size_t> blends;  ///< moves that blend with joint moves
  std::vector<double> largest;      ///< radii of these blends
};

/// Returns motions, in order, of moves of a program that was planned with stops, with their blends
/// with joint moves: from one stop to the next as large as they are proved, if this is quicker.
/// With a model, the arm in its scene before the program, they also keep its clearance.
std::vector<BlendedMoves> blended_moves(const PlannedProgram& planned, const CollisionModel* model,
                                        BudgetMeter& budget);

/// Returns the motion of the program with some of its moves replaced.
BlendedProgram with_blends(const PlannedProgram& planned, const std::vector<BlendedMoves>& motions);

/// Sets what became of the blends with joint moves of a motion that stops there.
void set_stops(const Program& program, std::vector<PlannedMove>& moves);

}  // namespace beeline::internal
