#pragma once

#include <beeline/motion/timing/joint_path.h>
#include <beeline/motion/timing/path_law.h>

namespace beeline {

/// A motion along the path from rest to rest that keeps the limits of velocity, acceleration and
/// jerk, and `limits.speed`; the acceleration begins and ends at zero and is continuous, so the
/// path must bend steadily (q'' continuous). It starts as the quickest s-curve along the path,
/// whose clock then runs faster or slower on the way, as far as the limits allow: an interior-point
/// method (Boyd and Vandenberghe, Convex Optimization, chapter 11) on the squared rate of the
/// clock, a quadratic spline. A local optimum, never slower than the quickest s-curve or quintic.
/// Throws Error for a path or limits that make no sense, and without any limit of jerk.
PathLaw jerk_limited(const JointPath& path, const PathLimits& limits);

}  // namespace beeline
