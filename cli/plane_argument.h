#pragma once

#include <string>
#include <vector>

#include <beeline/reach/surface.h>

#include "command/option.h"

namespace beeline::command {

/// --at and --measure: a plane perpendicular to an axis of the world, and what is shown of the
/// positions in it.
class PlaneArgument {
 public:
  std::vector<Option> options(bool required = true);

  bool given() const { return !plane_.empty(); }
  int normal() const;  ///< the axis: 0 x, 1 y, 2 z; throws Error for no plane
  double at() const;   ///< the coordinate, m
  ReachMeasure measure() const;

 private:
  std::string plane_, measure_ = "directions";
};

}  // namespace beeline::command
