#pragma once

#include <beeline/kinematics/task.h>
#include <beeline/motion/path/through.h>

namespace beeline {

/// The place on the path, from `from` on and up to `to`, at which the tool at `pose` is: on a
/// single line the nearest (nearest_on_line.h); else the first at which the path comes nearest, as
/// far as the task asks, a radian counting as 0.2 m. It is found in steps of a 32nd of a piece,
/// within which a path should not turn back.
double nearest_place(const ToolPath& path, const Task& task, const Pose& pose, double from,
                     double to);

}  // namespace beeline
