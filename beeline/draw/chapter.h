#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/draw/figure.h>
#include <beeline/model/arm.h>
#include <beeline/pose/se2.h>

namespace beeline {

/// The numbers of the chapter's figures that chapter_figure() draws: 1.3, 1.6, 1.7, 1.8, 1.9.
std::vector<std::string> chapter_figures();

/// A figure of the chapter, drawn from our own computation on its arm with links 3.5, 3.5, 2.
/// Throws Error for another number, naming those that there are.
Figure chapter_figure(std::string_view number);

/// Figure 1.7's motion: eq. 1.3 from rest to q_d = (99.2, -68.8, -30.4) degrees.
std::vector<Configuration> figure_1_7_motion();

/// Figure 1.9: where the arm starts, the three poses that its tool goes to in straight lines, and
/// the motion, by eq. 1.6.
Configuration figure_1_9_start();
std::vector<Pose2> figure_1_9_waypoints();
std::vector<Configuration> figure_1_9_motion();

}  // namespace beeline
