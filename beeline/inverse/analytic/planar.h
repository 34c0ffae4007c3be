#pragma once

#include <vector>

#include <beeline/inverse/analytic/planar_chain.h>
#include <beeline/kinematics/task.h>

namespace beeline {

/// Whether planar_solutions() covers this arm and task: a planar arm whose joints, none of them
/// mimic joints, number one to three, and the task `planar`; or one or two and the task `position`.
bool has_planar_closed_form(const Arm& arm, const Task& task);

struct PlanarSolution {
  Configuration q;
  bool continuum = false;  ///< stands for infinitely many, of which it is the nearest to the seed
  Deviation error;         ///< what is left of the task at q
};

/// planar_solutions() with what it knows of each. Out of reach: the configurations at the edge, of
/// which the best is as near to the position as the arm can come with the orientation asked for.
std::vector<PlanarSolution> nearest_planar_solutions(const Arm& arm, const Pose& world_T_tool,
                                                     const Task& task, const Configuration& seed,
                                                     double tolerance = 1e-9);

/// All configurations that bring the tool to `world_T_tool`, limits ignored, in closed form: both
/// elbows where there are two. Revolute values are the representatives nearest to `seed`.
/// Where solutions form a continuum (parallel slides, a folded arm whose elbow turns freely) the
/// one nearest to the seed stands for it. Empty when the pose is out of reach by more than
/// `tolerance` (metres and radians). Throws Error unless has_planar_closed_form(arm, task).
std::vector<Configuration> planar_solutions(const Arm& arm, const Pose& world_T_tool,
                                            const Task& task, const Configuration& seed,
                                            double tolerance = 1e-9);

}  // namespace beeline
