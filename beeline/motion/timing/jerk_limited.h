#pragma once

#include <beeline/motion/timing/joint_path.h>
#include <beeline/motion/timing/path_law.h>

namespace beeline {

/// A motion along the path from rest to rest that keeps the limits of velocity, acceleration and
/// jerk, and `limits.speed`; the acceleration begins and ends at zero and is continuous, so the
/// path must bend steadily (q'' continuous). It starts as the quintic along the path, whose clock
/// then runs faster or slower on the way, as far as the limits allow: an interior-point method
/// (clock_barrier.h) on the squared rate of the clock, a quadratic spline. Between the moments that
/// the method sees the limits are looked at again, and the motion is slowed down as a whole where
/// that is needed. A local optimum up to about a thousandth, never slower than the quintic.
/// Throws Error for a path or limits that make no sense, and without any limit of jerk.
PathLaw jerk_limited(const JointPath& path, const PathLimits& limits);

}  // namespace beeline
