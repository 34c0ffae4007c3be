#pragma once

#include <ostream>

#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// Prints `deviation at most 1.5e-05 m, 2.01e-06 rad`, rounded up to three digits.
inline std::ostream& print_bound(std::ostream& out, const Deviation& bound) {
  return out << "deviation at most "
             << Deviation{rounded_up(bound.position, 3), rounded_up(bound.orientation, 3)};
}

}  // namespace beeline::internal
