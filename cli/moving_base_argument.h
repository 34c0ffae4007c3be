#pragma once

#include <string>
#include <vector>

#include <beeline/model/arm.h>

#include "arguments.h"

namespace beeline::command {

/// --rail and --mobile-base: joints that move the whole arm.
struct MovingBaseArgument {
  std::string rail = {};         ///< AXIS:LENGTH or AXIS:LOWER:UPPER; empty: none
  std::string mobile_base = {};  ///< ranges of x, y and, if limited, the heading; empty: none

  std::vector<Option> options();
  bool given() const { return !rail.empty() || !mobile_base.empty(); }
  /// The arm on the rail, and this on the mobile base. Throws Error naming the option.
  Arm on(const Arm& arm, const UnitArgument& unit) const;
  /// The number of joints before the arm's own.
  std::size_t joints() const { return (rail.empty() ? 0U : 1U) + (mobile_base.empty() ? 0U : 3U); }
  /// A configuration of the arm alone, with the joints before it at 0 or at the limit next to 0.
  /// `moving` is the arm with these joints.
  Configuration at_zero(const Arm& moving, const Configuration& q) const;
};

}  // namespace beeline::command
