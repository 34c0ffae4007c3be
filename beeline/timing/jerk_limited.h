#pragma once

#include <beeline/path/joint_path.h>
#include <beeline/timing/time_scaling.h>

namespace beeline {

/// A motion along the path from rest to rest that keeps the limits of velocity, acceleration and
/// jerk, and `limits.speed`; the acceleration begins and ends at zero and is continuous, so the
/// path must bend steadily (q'' continuous). It starts as the quintic along the path, whose clock
/// then runs faster or slower on the way, as far as the limits allow: an interior-point method
/// (clock_barrier.h) on the squared rate of the clock, a quadratic spline. Between the moments that
/// the method sees the limits are looked at again; where they are broken the spline gets more
/// knots, and what is then left the motion is slowed down for as a whole. Where this is clearly
/// slower than fastest(), as with a tight spot that takes nearly a stop, the motion may come to
/// rest there, if that is quicker. A local optimum up to about a thousandth without a tight spot,
/// never slower than the quintic.
/// Throws Error for a path or limits that make no sense, and without any limit of jerk.
TimeScaling jerk_limited(const JointPath& path, const PathLimits& limits);

}  // namespace beeline
