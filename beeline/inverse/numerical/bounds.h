#pragma once

#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// The box lower <= q <= upper. A coordinate without a limit has an infinite bound.
struct Bounds {
  Configuration lower;
  Configuration upper;
};
Bounds bounds_of(const Arm& arm);  ///< the position limits
Bounds no_bounds(const Arm& arm);

/// Whether a coordinate has a finite bound.
bool any_finite(const Bounds& bounds);
bool within(const Bounds& bounds, const Configuration& q);

/// Returns the nearest point of the box.
Configuration clamped(const Bounds& bounds, Configuration q);

/// Returns the sum over the coordinates of the distances of q from the interval between its bounds,
/// radians and metres.
double excess(const Bounds& bounds, const Configuration& q);

/// Throws Error unless the task has rows, in the base or tool frame, and the bounds fit the arm.
void check_task(const Arm& arm, const Task& task, const Bounds& bounds);

/// Returns the length that is equivalent to one radian in sums of errors, metres: Arm::Reach::size,
/// or 1 if that is zero.
double unit_of_length(const Arm& arm);

}  // namespace beeline::internal
