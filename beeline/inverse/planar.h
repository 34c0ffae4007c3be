#pragma once

#include <optional>
#include <vector>

#include <beeline/kinematics/task.h>

namespace beeline {

/// Whether planar_solutions() covers this arm and task: a planar arm whose joints, none of them
/// mimic joints, number one to three, and the task `planar`; or one or two and the task `position`.
bool has_planar_closed_form(const Arm& arm, const Task& task);

/// All configurations that bring the tool to `world_T_tool`, limits ignored, in closed form: both
/// elbows where there are two. Revolute values are the representatives nearest to `seed`.
/// Where solutions form a continuum (parallel slides, a folded arm whose elbow turns freely) the
/// one nearest to the seed stands for it. Empty when the pose is out of reach.
/// Requires has_planar_closed_form(arm, task).
std::vector<Configuration> planar_solutions(const Arm& arm, const Pose& world_T_tool,
                                            const Task& task, const Configuration& seed);

}  // namespace beeline
