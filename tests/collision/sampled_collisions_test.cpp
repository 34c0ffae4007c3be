#include <gtest/gtest.h>

#include <beeline/collision/internal/furthest_vertex.h>
#include <beeline/collision/internal/sampled_collisions.h>

#include <tests/collision/random_model.h>

namespace beeline::internal {
namespace {

using testing::Random;

/// Adds a cloud and clearances of their own to some obstacles.
void vary(Random& random, const Arm& arm, Scene& scene) {
  PointCloud cloud{.points = {}, .radius = random.uniform(0.001, 0.05)};
  for (int i = 0; i < 50; ++i) {
    cloud.points.push_back(arm.base().translation() + 2 * random.vector());
  }
  scene.obstacles.push_back({.name = "cloud", .shapes = {}, .cloud = cloud});
  for (Obstacle& obstacle : scene.obstacles) {
    if (random.integer(0, 3) == 0) obstacle.clearance = random.uniform(1e-3, 0.1);
  }
}

TEST(SampledCollisions, AgreeWithDistances) {
  Random random;
  int blocked = 0, free = 0;
  for (int i = 0; i < 60; ++i) {
    const Arm arm = testing::random_arm(random, random.integer(2, 7), 4);
    const auto links = testing::random_link_shapes(random, arm, 0.15);
    Scene scene = testing::random_scene(random, arm, random.integer(0, 12), 0.3, 3);
    vary(random, arm, scene);
    if (random.integer(0, 1) == 0) scene.allowed_pairs.push_back({"link1", "cloud"});
    const CollisionModel model(arm, links, scene, {.clearance = random.uniform(1e-3, 0.05)});
    SampledCollisions samples(model.bodies());
    for (int k = 0; k < 8; ++k) {
      Eigen::Matrix<double, SampledCollisions::at_once, Eigen::Dynamic> q(8, arm.dof());
      int first = SampledCollisions::at_once;
      bool is_clear = true;  // not between two bounds
      for (int lane = 0; lane < SampledCollisions::at_once; ++lane) {
        const Configuration at = random.configuration(arm);
        q.row(lane) = at.transpose();
        const BodyDistance nearest = nearest_pair(model, at);
        if (std::abs(nearest.lower - nearest.clearance) < 1e-6) is_clear = false;
        if (nearest.lower >= nearest.clearance) continue;
        first = std::min(first, lane);
      }
      if (!is_clear) continue;
      ASSERT_EQ(samples.first_blocked(q.data()), first) << "model " << i;
      ++(first < SampledCollisions::at_once ? blocked : free);
    }
  }
  EXPECT_GT(blocked, 50);
  EXPECT_GT(free, 50);
}

TEST(FurthestVertex, IsTheFurthestOfAll) {
  Random random;
  for (int count = 1; count <= 40; ++count) {
    std::vector<Vector3> vertices;
    for (int i = 0; i < count; ++i) vertices.push_back(random.vector());
    const Vector3 direction = random.vector();
    double most = direction.dot(vertices.front());
    for (const Vector3& vertex : vertices) most = std::max(most, direction.dot(vertex));
    EXPECT_NEAR(direction.dot(furthest_vertex(vertices, direction)), most, 1e-15);
  }
}

}  // namespace
}  // namespace beeline::internal
