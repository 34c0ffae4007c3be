#pragma once

#include <beeline/path/joint_path.h>
#include <beeline/timing/s_curve.h>
#include <beeline/timing/time_scaling.h>

namespace beeline {

/// Laws of one form for s alone, from rest to rest, whatever the path does on the way: their shape
/// over time is fixed or has one or two numbers, and they last as long as the limits ask for at the
/// worst place.
enum class ScalarForm {
  trapezoidal,  ///< constant acceleration, cruise, the same mirrored; jerk is free
  quintic,      ///< 10 u^3 - 15 u^4 + 6 u^5 of the duration's fraction u
  s_curve,      ///< the trapezoid whose acceleration is one as well: constant jerks
};

/// The quickest law of the form that keeps the limits of velocity, acceleration and, but for the
/// trapezoid, jerk. The shape is found by a search in one or two numbers, which on a path of many
/// bends may stop at a local optimum. Throws Error for a path or limits that make no sense.
TimeScaling scalar_profile(ScalarForm form, const JointPath& path, const PathLimits& limits);

/// The s-curve that `scalar_profile` is made of, over the path's length.
SCurve quickest_s_curve(const JointPath& path, const PathLimits& limits);

}  // namespace beeline
