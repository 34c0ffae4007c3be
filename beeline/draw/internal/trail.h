#pragma once

#include <string>
#include <vector>

#include <beeline/draw/drawing.h>
#include <beeline/model/arm.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// The path of the tool's origin in the world.
struct ToolTrail {
  std::vector<double> times;    ///< seconds, not decreasing
  std::vector<Vector3> points;  ///< metres
};

/// Returns the positions of the tool along the motion that the columns mean: at every sample and
/// between them, 2000 or more in all. If there are more than 20,000, only the extremes along each
/// axis of each group of neighbours are kept, so that no spike is lost. The trajectory is in the
/// arm's joint order.
ToolTrail tool_trail(const Arm& arm, const Trajectory& trajectory);

/// Returns the diagonal of the box around points, metres.
double extent(const std::vector<Vector3>& points);

struct TrailStyle {
  std::size_t dots = 81;  ///< number of dots at equal times, whose spacing shows the speed
  bool growing = false;  ///< whether every part appears when the tool has passed it (Item::appears)
};

/// Adds the trail of the tool: a thin line through its points, without points that are not visible,
/// and dots. If the drawing has a floor and the arm stands upright on it, the parts below the floor
/// are drawn in their own colour.
void add_trail(Drawing& drawing, const Arm& arm, const Trajectory& trajectory,
               const TrailStyle& style = {});

/// Returns whether a spatial arm stands upright: the z axis of its base is within 60 degrees of the
/// world's. Then the plane of its base is the ground or a table.
bool stands_upright(const Arm& arm);

constexpr Colour below_ground{0.45, 0.10,
                              0.55};  ///< colour of the parts of a trail below the floor

/// Adds a ring and a small frame at each pose, labelled by its name or, without names, by its
/// number from 1.
void add_poses(Drawing& drawing, const std::vector<Pose>& poses,
               const std::vector<std::string>& names = {});

/// Returns the times that divide the trail into `count` parts of equal length: the start first,
/// without the end.
std::vector<double> times_evenly_along(const ToolTrail& trail, int count);

}  // namespace beeline::internal
