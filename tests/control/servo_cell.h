#pragma once

#include <cmath>
#include <memory>

#include <beeline/collision/collision_model.h>
#include <beeline/io/text/scene.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include <tests/random.h>

namespace beeline::testing {

constexpr double loop_step = 1e-3;          // s
constexpr double distance_rounding = 1e-9;  // m

/// Which limits an arm has besides its positions and velocities.
enum class LoopLimits { accelerations, velocities_alone };

/// The built-in arm with velocities where it has none, and with accelerations or without.
inline Arm loop_arm(const std::string& name, LoopLimits limits) {
  const Arm arm = built_in(name);
  std::vector<Joint> joints = arm.joints();
  for (Joint& joint : joints) {
    if (!std::isfinite(joint.limits.velocity)) joint.limits.velocity = 2.5;
    if (limits == LoopLimits::velocities_alone) {
      joint.limits.acceleration = Limits::none;
    } else if (!std::isfinite(joint.limits.acceleration)) {
      joint.limits.acceleration = 8;
    }
  }
  return Arm(name, joints, arm.tool(), arm.base());
}

inline Obstacle box_at(const std::string& name, const Vector3& size, const Vector3& at) {
  return {.name = name, .shapes = {{Box{size}, make_pose(at)}}, .clearance = 0.01};
}

/// No obstacles, a wall in front, or walls in front, beside and above.
inline Scene loop_scene(const std::string& cell) {
  Scene scene;
  if (cell == "itself") return scene;
  scene.obstacles.push_back(box_at("wall", {0.1, 4, 4}, {0.6, 0, 0}));
  if (cell == "wall") return scene;
  scene.obstacles.push_back(box_at("side", {4, 0.1, 4}, {0, 0.5, 0}));
  scene.obstacles.push_back(box_at("ceiling", {4, 4, 0.1}, {0, 0, 1}));
  return scene;
}

inline CollisionModel loop_model(const Arm& arm, const std::string& name, const Scene& scene) {
  const ArmShapes shapes = read_arm_shapes(name);
  return CollisionModel(arm, shapes.links, scene, {.allowed_pairs = shapes.allowed_pairs});
}

/// A configuration at which the model keeps its clearances.
inline Configuration clear_configuration(Random& random, const Arm& arm,
                                         const CollisionModel& model) {
  Configuration q;
  do {
    q = 0.7 * random.configuration(arm) + 0.3 * middle_configuration(arm);
  } while (blocked_by(model, q));
  return q;
}

/// The least distance beyond its clearance at a configuration, computed without a loop's memory.
inline double excess_at(const CollisionModel& model, const Configuration& q) {
  const BodyDistance nearest = nearest_pair(model, q);
  return nearest.lower - nearest.clearance;
}

}  // namespace beeline::testing
