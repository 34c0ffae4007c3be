#include <gtest/gtest.h>

#include <beeline/certificate/clearance.h>

#include <tests/certificate/random_motion.h>
#include <tests/collision/random_model.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::Random;

/// A scene with a cloud, and the same one with a sphere for each of its points.
struct SameScenes {
  Scene cloud, spheres;
};

SameScenes random_cloud(Random& random, const Arm& arm, int points) {
  SameScenes scenes{testing::random_scene(random, arm, 3, 0.2, 2), {}};
  const double radius = random.integer(0, 3) == 0 ? 0 : random.uniform(0.01, 0.1);
  Obstacle scan{.name = "scan", .shapes = {}, .cloud = PointCloud{{}, radius}};
  if (random.integer(0, 1) == 0) scan.clearance = random.uniform(0.001, 0.1);
  Obstacle spheres = scan;
  spheres.cloud.reset();
  for (int i = 0; i < points; ++i) {
    const Vector3 at = arm.base().translation() + random.vector(2);
    scan.cloud->points.push_back(at);
    spheres.shapes.push_back({Sphere{radius}, Pose(Eigen::Translation3d(at))});
  }
  scenes.spheres = scenes.cloud;
  scenes.cloud.obstacles.push_back(scan);
  scenes.spheres.obstacles.push_back(spheres);
  return scenes;
}

void expect_same(const BodyDistance& a, const BodyDistance& b) {
  EXPECT_EQ(a.names, b.names);
  EXPECT_EQ(a.lower, b.lower);
  EXPECT_EQ(a.upper, b.upper);
  EXPECT_EQ(a.clearance, b.clearance);
  EXPECT_EQ(a.on_second, b.on_second);
  EXPECT_EQ(a.gradient, b.gradient);
}

TEST(PointCloud, AnswersAsTheSpheresAroundItsPoints) {
  Random random;
  int hits = 0, points_named = 0;
  const int count = testing::cases(120);
  for (int i = 0; i < count; ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 6));
    const auto links = testing::random_link_shapes(random, arm, 0.1);
    const SameScenes scenes = random_cloud(random, arm, random.integer(1, 300));
    const CollisionOptions options{.clearance = random.uniform(0.001, 0.05)};
    const CollisionModel cloud(arm, links, scenes.cloud, options);
    const CollisionModel spheres(arm, links, scenes.spheres, options);
    ASSERT_EQ(cloud.pair_count(), spheres.pair_count());
    EXPECT_EQ(far_obstacles(arm, scenes.cloud), far_obstacles(arm, scenes.spheres));
    const Configuration q = random.configuration(arm);
    const BodyDistance nearest = nearest_pair(cloud, q);
    expect_same(nearest, nearest_pair(spheres, q));
    EXPECT_EQ(nearest.point.has_value(), nearest.names[1] == "scan");
    if (nearest.point) {
      ++points_named;
      const PointCloud& scan = *scenes.cloud.obstacles.back().cloud;
      ASSERT_LT(*nearest.point, scan.points.size());
      EXPECT_LE((nearest.on_second - scan.points[*nearest.point]).norm(), scan.radius + 1e-9);
      EXPECT_EQ(names_text(nearest),
                nearest.names[0] + " and scan[" + std::to_string(*nearest.point) + "]");
    }
    const auto close = pairs_too_close(cloud, q), close_spheres = pairs_too_close(spheres, q);
    ASSERT_EQ(close.size(), close_spheres.size());
    for (std::size_t k = 0; k < close.size(); ++k) expect_same(close[k], close_spheres[k]);
    EXPECT_EQ(blocked_by(cloud, q).code, blocked_by(spheres, q).code);
    const Trajectory motion = testing::random_motion(
        random, arm, testing::random_interpolation(random), random.integer(2, 5), 0.1);
    const ClearanceProof proof = prove_clearance(cloud, motion),
                         expected = prove_clearance(spheres, motion);
    EXPECT_EQ(proof.status, expected.status);
    EXPECT_EQ(proof.time, expected.time);
    EXPECT_EQ(proof.parts, expected.parts);
    EXPECT_EQ(proof.least_distance, expected.least_distance);
    expect_same(proof.pair, expected.pair);
    hits += proof.status == ClearanceStatus::collides ? 1 : 0;
    EXPECT_EQ(proof.reason.has(ReasonField::point),
              proof.reason.code != ReasonCode::none && proof.pair.point.has_value());
  }
  EXPECT_TRUE(hits > 0 || count < 40);
  EXPECT_GT(points_named, 0);
}

TEST(PointCloud, WhatIsNoCloudIsRefused) {
  const auto check = [](std::vector<Vector3> points, double radius) {
    check_cloud({std::move(points), radius});
  };
  check({{1, 2, 3}}, 0);
  EXPECT_REFUSED(check({}, 0.1), "has no points");
  EXPECT_REFUSED(check({{1, 2, 3}}, -0.1), "radius of -0.1 m");
  EXPECT_REFUSED(check({{1, 2, 3}}, NAN), "radius of nan m");
  EXPECT_REFUSED(check({{1, 2, 3}, {0, NAN, 0}}, 0.1), "point 1 of a point cloud");
  EXPECT_REFUSED(check({{1, 2, 3}, {0, 0, INFINITY}}, 0.1), "leave such points out");
  EXPECT_REFUSED(check({{1, 2e6, 3}}, 0.1), "beyond 1e+06 m");
  EXPECT_REFUSED(check(std::vector<Vector3>(max_cloud_points + 1, Vector3::Zero()), 0.1),
                 "1000001 points; at most 1000000");
}

}  // namespace
}  // namespace beeline
