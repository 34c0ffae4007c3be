#pragma once

#include <string>
#include <vector>

#include <beeline/draw/scene.h>
#include <beeline/model/arm.h>

namespace beeline {

/// The tool's positions over a motion.
std::vector<Vector3> tool_positions(const Arm& arm, const std::vector<Configuration>& motion);

/// Where the tool went: a thin line, and dots that lie closer where it went slower. Of more than
/// `most_dots` points every m-th gets a dot; the line keeps the extremes between them.
void add_trail(Scene& scene, const std::vector<Vector3>& points, std::size_t most_dots = 2000);

/// Goals: a ring and a little frame at each, with its name from `names` where there is one.
void add_poses(Scene& scene, const std::vector<Pose>& poses,
               const std::vector<std::string>& names = {});

}  // namespace beeline
