#pragma once

#include <vector>

#include <beeline/draw/figure.h>
#include <beeline/model/arm.h>

namespace beeline {

struct ArmFigureOptions {
  std::string title = {};    ///< default: the arm's name
  std::string caption = {};  ///< default: the tool's position
  bool frames = false;       ///< every link's frame
  bool jacobian = false;     ///< the Jacobian's columns as arrows at the tool
  double azimuth = -0.87;    ///< of the spatial view, radians
  double elevation = 0.44;   ///< of the spatial view, radians
  bool small_views = true;   ///< spatial arms also from above and from the side
  int ghosts = 3;            ///< how many configurations of a motion are shown faded
  std::size_t dots = 80;     ///< most dots on a motion's trail
};

/// The arm at configuration q: seen from above when planar, else a large oblique view with two
/// small ones beside it.
Figure arm_figure(const Arm& arm, const ConfigurationRef& q, const ArmFigureOptions& options = {});

/// A motion, as samples at equal times: the tool's trail, the arm at its end, faded arms at its
/// start and on the way, and the waypoints, numbered. Throws Error when there is no sample.
Figure motion_figure(const Arm& arm, const std::vector<Configuration>& motion,
                     const std::vector<Pose>& waypoints = {}, const ArmFigureOptions& options = {});

/// The samples whose tools divide its way into `count` equal lengths, the start first, the end left
/// out.
std::vector<std::size_t> evenly_along(const std::vector<Vector3>& tool, int count);

/// "(2.44, 6.28, 0°)" for a planar arm, else the tool's position "(0.31, 0.00, 0.59) m".
std::string tool_text(const Arm& arm, const ConfigurationRef& q);

}  // namespace beeline
