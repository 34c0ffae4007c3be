#pragma once

#include <string>
#include <vector>

#include <beeline/draw/scene.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

/// Returns the tool positions of a motion, metres, in the world.
std::vector<Vector3> tool_positions(const Arm& arm, const std::vector<Configuration>& motion);

/// Adds the trail of the tool: a thin line, and dots whose spacing shows the speed. Of more than
/// `max_dots` points every m-th gets a dot; the line keeps the extremes between them.
void add_trail(Scene& scene, const std::vector<Vector3>& points, std::size_t max_dots = 2000);

/// Adds a ring and a small frame at each pose, with its label from `names` where there is one.
void add_poses(Scene& scene, const std::vector<Pose>& poses,
               const std::vector<std::string>& names = {});

/// Returns the samples that divide the tool's trail into `count` parts of equal length: the start
/// first, without the end.
std::vector<std::size_t> evenly_along(const std::vector<Vector3>& tool, int count);

}  // namespace beeline::internal
