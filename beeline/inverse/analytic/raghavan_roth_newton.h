#pragma once

#include <beeline/inverse/analytic/raghavan_roth_elimination.h>
#include <beeline/inverse/analytic/rigid_motion.h>

namespace beeline::internal {

/// Eight configurations, by joint and lane.
struct EightConfigurations {
  alignas(64) double q[6][8];
  /// The larger of position and orientation error before the first step, in units and radians; 1 if
  /// the orientation is more than a right angle away, not a number if the candidate is none.
  alignas(64) double error[8];
  alignas(64) double determinant[8] = {};  ///< of the Jacobian before the last step, units^3
};

/// Sets joint `last` of each configuration to the value with the least orientation error, then
/// takes Newton steps towards the goal (lengths in units). Returns a mask of the lanes that have
/// converged to `tolerance` (units of length, and radians).
unsigned newton(const RevoluteLinks& links, const RigidMotion& goal, int last, double tolerance,
                EightConfigurations& eight);

}  // namespace beeline::internal
