#pragma once

#include <beeline/draw/drawing.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

struct ArmStyle {
  bool frames = false;  ///< draw the frame of every link, labelled {0} to {n} for up to 40 links
  bool faded = false;   ///< whether the arm is behind everything else, as an earlier configuration
  bool tool = true;     ///< draw the tool frame
  bool thin = false;    ///< draw small symbols, which show in the shapes of the links
};

/// Adds the arm at configuration q to the drawing. Throws Error when q does not fit the arm.
void add_arm(Drawing& drawing, const Arm& arm, const ConfigurationRef& q,
             const ArmStyle& style = {});

}  // namespace beeline::internal
