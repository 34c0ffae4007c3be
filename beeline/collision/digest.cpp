#include <algorithm>
#include <array>

#include <beeline/collision/internal/collision_bodies.h>
#include <beeline/internal/fingerprint.h>

namespace beeline {
namespace {

using internal::Fingerprint;

void add_numbers(Fingerprint& digest, const auto& matrix) {
  for (const double value : matrix.reshaped()) digest.add(value);
}

/// Adds the sizes of a body.
struct AddBody {
  Fingerprint& digest;

  void operator()(const Sphere& sphere) const { digest.add(sphere.radius); }
  void operator()(const Capsule& capsule) const {
    digest.add(capsule.radius);
    digest.add(capsule.length);
  }
  void operator()(const Box& box) const { add_numbers(digest, box.size); }
  void operator()(const Cylinder& cylinder) const {
    digest.add(cylinder.radius);
    digest.add(cylinder.length);
  }
  void operator()(const HalfSpace&) const {}
  void operator()(const ConvexHull& hull) const {
    digest.add(std::uint64_t{hull.vertices.size()});
    for (const Vector3& vertex : hull.vertices) add_numbers(digest, vertex);
  }
};

void add_shapes(Fingerprint& digest, const std::vector<Shape>& shapes) {
  digest.add(std::uint64_t{shapes.size()});
  for (const Shape& shape : shapes) {
    digest.add(std::uint64_t{shape.body.index()});
    std::visit(AddBody{digest}, shape.body);
    add_numbers(digest, shape.pose.matrix());
    digest.add(shape.padding);
  }
}

void add_points(Fingerprint& digest, const PointCloud& cloud) {
  digest.add(std::uint64_t{cloud.points.size()});
  digest.add(cloud.radius);
  for (const Vector3& point : cloud.points) add_numbers(digest, point);
}

/// Adds the pairs of bodies of links that count, also those that are proved to keep the clearance:
/// how many these are depends on the search.
void add_pairs(Fingerprint& digest, const internal::CollisionBodies& bodies) {
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (const auto* some : {&bodies.self_pairs, &bodies.apart_pairs}) {
    for (const auto& pair : *some) pairs.push_back({pair.first, pair.second});
  }
  std::sort(pairs.begin(), pairs.end());
  digest.add(std::uint64_t{pairs.size()});
  for (const auto& pair : pairs) {
    digest.add(std::uint64_t{pair[0]});
    digest.add(std::uint64_t{pair[1]});
  }
}

/// Adds an obstacle with the bodies of the arm that may touch it. Link 0 does not move.
void add_obstacle(Fingerprint& digest, const internal::CollisionBodies& bodies, std::size_t i) {
  const Obstacle& obstacle = bodies.scene.obstacles[i];
  digest.add(obstacle.clearance.value_or(bodies.options.clearance));
  add_shapes(digest, obstacle.shapes);
  if (obstacle.cloud) add_points(digest, *obstacle.cloud);
  for (std::size_t k = 0; k < bodies.links.size(); ++k) {
    if (bodies.links[k].link == 0) continue;
    const bool allowed = bodies.obstacle_allowed[k * bodies.scene.obstacles.size() + i];
    digest.add(std::uint64_t{allowed});
  }
}

/// Adds the obstacles, in whatever order they stand.
void add_obstacles(Fingerprint& digest, const internal::CollisionBodies& bodies) {
  std::vector<std::string> obstacles;
  for (std::size_t i = 0; i < bodies.scene.obstacles.size(); ++i) {
    Fingerprint of_obstacle;
    add_obstacle(of_obstacle, bodies, i);
    obstacles.push_back(of_obstacle.text());
  }
  std::sort(obstacles.begin(), obstacles.end());
  digest.add(std::uint64_t{obstacles.size()});
  for (const std::string& obstacle : obstacles) digest.add(std::string_view(obstacle));
}

}  // namespace

std::string digest(const CollisionModel& model) {
  const internal::CollisionBodies& bodies = model.bodies();
  Fingerprint digest;
  digest.add(bodies.options.clearance);
  digest.add(std::uint64_t{bodies.links.size()});
  for (const LinkShapes& link : bodies.links) {
    digest.add(std::uint64_t{link.link});
    add_shapes(digest, link.shapes);
  }
  add_obstacles(digest, bodies);
  add_pairs(digest, bodies);
  return digest.text();
}

}  // namespace beeline
