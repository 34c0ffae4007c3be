#pragma once

#include <string>
#include <vector>

#include <beeline/control/joint.h>

#include "command/verb.h"

/// A simulated motion with its proportional gain.
struct GainMotion {
  double gain = 0;
  beeline::ControlledMotion motion;
};

/// The motions as one table, as {"gains": [...]} and, unless `picture` is empty, as a picture of
/// their step responses towards the goal. The answer is yes if all reach it.
Answer compared_gains(const std::vector<GainMotion>& motions, const beeline::Configuration& goal,
                      const std::string& picture);
