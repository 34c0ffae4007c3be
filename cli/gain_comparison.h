#pragma once

#include <string>
#include <vector>

#include <beeline/control/joint.h>

#include "command/verb.h"

namespace beeline::command {

/// A simulated motion with its proportional gain.
struct GainMotion {
  double gain = 0;
  ControlledMotion motion;
};

/// The motions as one table, as {"gains": [...]} and, unless `picture` is empty, as a picture of
/// their step responses towards the goal. The answer is yes if all reach it.
Answer compared_gains(const std::vector<GainMotion>& motions, const Configuration& goal,
                      const std::string& picture);

}  // namespace beeline::command
