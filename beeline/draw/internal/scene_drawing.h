#pragma once

#include <optional>
#include <string>

#include <beeline/collision/collision_model.h>
#include <beeline/draw/drawing.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Adds the obstacles of the model to the drawing, up to twelve with their names. The page contains
/// what is within 1.2 times the arm's reach of its base; half-spaces are drawn as slabs there.
void add_obstacles(Drawing& drawing, const CollisionModel& model);

/// Adds the shapes of the arm's links at configuration q.
void add_link_shapes(Drawing& drawing, const CollisionModel& model, const ConfigurationRef& q,
                     bool is_faded = false);

/// Adds the line between the nearest points of two bodies, with their distance as a label unless
/// `label` is false: teal if the bodies keep their clearance, red otherwise.
void add_nearest_pair(Drawing& drawing, const BodyDistance& pair, bool label = true);

/// Describes a pair: "nearest: hand and wall, 0.0008 m apart; 0.001 m are required".
std::string nearest_text(const BodyDistance& pair);

/// A pair of bodies at one time of a motion.
struct TimedPair {
  double time = 0;
  BodyDistance pair;
};

/// Returns the pair with the least distance beyond its clearance at 201 times of a motion; nothing
/// if no pair counts at any of them.
std::optional<TimedPair> nearest_sample(const CollisionModel& model, const Trajectory& trajectory);

}  // namespace beeline::internal
