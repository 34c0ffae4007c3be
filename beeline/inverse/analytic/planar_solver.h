#pragma once

#include <vector>

#include <beeline/inverse/analytic/planar_subproblems.h>
#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// Whether nearest_planar_solutions() covers this arm and task: a planar arm without mimic joints,
/// of one to three joints for the task `planar`, or of one or two joints for the task `position`
/// or its rows x and y alone.
bool has_planar_closed_form(const Arm& arm, const Task& task);

struct PlanarSolution {
  Configuration q;
  /// Whether the solution is one of infinitely many: the one nearest to the seed.
  bool continuum = false;
  Deviation error;  ///< task error at q
};

/// Returns all configurations that bring the tool to `world_T_tool`, joint limits ignored, up to
/// multiples of 2 pi: revolute coordinates are the representatives nearest to `seed`. If solutions
/// form a continuum (parallel prismatic joints, a folded arm), the one nearest to the seed
/// represents it. For a pose out of reach by more than 1000 times the `tolerance` (metres and
/// radians), returns configurations at the workspace boundary. The best one has the least position
/// error at the requested orientation. Throws Error unless has_planar_closed_form(arm, task).
std::vector<PlanarSolution> nearest_planar_solutions(const Arm& arm, const Pose& world_T_tool,
                                                     const Task& task, const Configuration& seed,
                                                     double tolerance = 1e-9);

}  // namespace beeline::internal
