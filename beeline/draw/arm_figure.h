#pragma once

#include <vector>

#include <beeline/draw/figure.h>
#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {

/// Options of arm_figure() and motion_figure().
struct ArmFigureOptions {
  std::string title = {};     ///< default: the arm's name
  std::string caption = {};   ///< default: the tool's position
  bool frames = false;        ///< draw the frame of every link
  bool jacobian = false;      ///< draw the Jacobian's columns as arrows at the tool
  double azimuth = -0.87;     ///< of the spatial view, radians
  double elevation = 0.44;    ///< of the spatial view, radians
  bool small_views = true;    ///< add small views from above and from the front (spatial arms)
  int ghosts = 3;             ///< number of earlier configurations of a motion, drawn faded
  std::size_t max_dots = 80;  ///< max dots on the trail of a motion
};

/// Draws the arm at configuration q: from above when it is planar, otherwise in an oblique view
/// with two small views beside it. Throws Error when q does not fit the arm.
Figure arm_figure(const Arm& arm, const ConfigurationRef& q, const ArmFigureOptions& options = {});

/// Draws a motion, sampled at equal times: the trail of the tool, the arm at the last sample, faded
/// arms at the start and between, and the numbered waypoints. Throws Error for a motion without
/// samples and for samples that do not fit the arm.
Figure motion_figure(const Arm& arm, const std::vector<Configuration>& motion,
                     const std::vector<Pose>& waypoints = {}, const ArmFigureOptions& options = {});

}  // namespace beeline
