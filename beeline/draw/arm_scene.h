#pragma once

#include <beeline/draw/scene.h>
#include <beeline/model/arm.h>

namespace beeline {

struct ArmStyle {
  bool frames = false;  ///< every link's frame, named {0} to {n} up to 40
  bool faded = false;   ///< behind everything else, as a state of the past
  bool tool = true;     ///< the tool's frame
};

/// The arm at configuration q. Throws Error when q does not fit the arm.
void add_arm(Scene& scene, const Arm& arm, const ConfigurationRef& q, const ArmStyle& style = {});

}  // namespace beeline
