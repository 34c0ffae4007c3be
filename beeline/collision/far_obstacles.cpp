#include <algorithm>
#include <cmath>

#include <beeline/collision/collision_model.h>
#include <beeline/collision/internal/convex_body.h>

namespace beeline {

std::vector<std::string> far_obstacles(const Arm& arm, const Scene& scene) {
  const Arm::Reach& reach = arm.reach();
  const auto is_far = [&](const Shape& shape) {
    const internal::ConvexBody body = internal::convex_body(shape);
    constexpr double large = 10;  // times the distance that is far
    const bool is_large = std::isfinite(body.bound) && far_from(reach, body.bound / large);
    return is_large || far_from(reach, (body.centre - reach.centre).norm() - body.bound);
  };
  std::vector<std::string> names;
  for (const Obstacle& obstacle : scene.obstacles) {
    bool all = std::all_of(obstacle.shapes.begin(), obstacle.shapes.end(), is_far);
    if (obstacle.cloud) {
      const auto& [points, radius] = *obstacle.cloud;
      all = all && std::all_of(points.begin(), points.end(), [&, size = radius](const Vector3& p) {
              return far_from(reach, (p - reach.centre).norm() - size);
            });
    }
    if (all && (obstacle.cloud || !obstacle.shapes.empty())) names.push_back(obstacle.name);
  }
  return names;
}

}  // namespace beeline
