#pragma once

#include <beeline/inverse/analytic/general_elimination.h>

namespace beeline {

/// Eight configurations, joint by joint.
struct EightConfigurations {
  alignas(64) double q[6][8];
};

/// A rigid motion for the kernels: the rotation's rows, then the translation in units.
struct Motion {
  double rotation[3][3];
  double translation[3];
};

/// Turns joint `last` of each to where it agrees best with the goal's orientation, then takes
/// Newton steps towards the goal. Bit k of the answer: configuration k has arrived there, to
/// `tolerance` (units of length, and radians).
unsigned newton(const SixLinks& six, const Motion& goal, int last, double tolerance,
                EightConfigurations& eight);

}  // namespace beeline
