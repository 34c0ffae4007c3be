#pragma once

#include <beeline/collision/collision_model.h>

#include <tests/collision/random_shape.h>
#include <tests/random_arm.h>

namespace beeline::testing {

/// Shapes of random kinds on all links of an arm, one or two on each, near the links' frames.
inline std::vector<LinkShapes> random_link_shapes(Random& random, const Arm& arm, double size) {
  std::vector<LinkShapes> links;
  for (std::size_t i = 0; i <= arm.joints().size(); ++i) {
    links.push_back({.name = "link" + std::to_string(i), .link = i, .shapes = {}});
    for (int k = random.integer(1, 2); k > 0; --k) {
      int kind = random.integer(0, shape_kinds - 1);
      if (kind == place_of<HalfSpace>()) kind = place_of<Sphere>();
      links.back().shapes.push_back(random_shape(random, kind, size, 0.3));
    }
  }
  return links;
}

/// Obstacles of random kinds within `spread` of the arm's base.
inline Scene random_scene(Random& random, const Arm& arm, int obstacles, double size,
                          double spread) {
  Scene scene;
  for (int i = 0; i < obstacles; ++i) {
    int kind = random.integer(0, shape_kinds - 1);
    if (kind == place_of<HalfSpace>() && random.integer(0, 3) != 0) kind = place_of<Box>();
    Obstacle obstacle{.name = "obstacle" + std::to_string(i),
                      .shapes = {random_shape(random, kind, size, spread)}};
    for (Shape& shape : obstacle.shapes) shape.pose.translation() += arm.base().translation();
    if (kind == place_of<HalfSpace>()) {
      obstacle.shapes.front().pose.translation() -=
          2 * spread * obstacle.shapes.front().pose.linear().col(2);
    }
    scene.obstacles.push_back(obstacle);
  }
  return scene;
}

}  // namespace beeline::testing
