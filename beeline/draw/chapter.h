#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/draw/animation.h>
#include <beeline/draw/figure.h>
#include <beeline/error.h>
#include <beeline/model/arm.h>
#include <beeline/pose/se2.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// Returns the figure numbers of Dellaert, *Serial Link Manipulators*, that chapter_figure() draws:
/// 1.1 to 1.9, and "splines", the waypoints of Figure 1.9 by lines and by a spline.
std::vector<std::string> chapter_figures();

/// Draws a figure of the chapter; 1.3 and 1.6 to 1.9 are computed for its arm with link
/// lengths 3.5, 3.5 and 2. Throws Error for an unknown number; the message lists the known ones.
Figure chapter_figure(std::string_view number);

/// Draws Figure 1.7 or 1.9 with the arm in motion. Throws Error for any other number.
Animation chapter_animation(std::string_view number);

/// Returns the motion of Figure 1.7: proportional control (eq. 1.3) from q = 0 to
/// q_d = (99.2, -68.8, -30.4) degrees, in steps of 0.05 s.
Trajectory figure_1_7_motion();

/// Returns the start configuration of Figure 1.9, its three waypoints, and the motion of the tool
/// in straight lines through them by the inverse Jacobian (eq. 1.6), in steps of 0.005 s.
Configuration figure_1_9_start();
std::vector<Pose2> figure_1_9_waypoints();
Trajectory figure_1_9_motion();

}  // namespace beeline
