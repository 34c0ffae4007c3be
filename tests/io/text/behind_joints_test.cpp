#include <gtest/gtest.h>

#include <beeline/collision/collision_model.h>
#include <beeline/io/text/scene.h>
#include <beeline/model/catalog.h>
#include <beeline/model/moving_base.h>

#include <tests/random.h>

namespace beeline {
namespace {

TEST(BehindJoints, TheShapesOfTheArmAreCarriedByItsMovingBase) {
  testing::Random random;
  for (const char* name : {"ur5", "panda"}) {
    const Arm arm = built_in(name);
    const std::vector<LinkShapes> links = read_arm_shapes(name).links;
    const CollisionModel alone(arm, links);
    const Limits range{.lower = -2, .upper = 2};
    const std::pair<Arm, std::size_t> moving_arms[] = {
        {with_rail(arm, random.direction(), range), 1},
        {with_mobile_base(arm, {.x = range, .y = range}), 3}};
    for (const auto& [moving, joints] : moving_arms) {
      const CollisionModel model(moving, behind_joints(links, joints));
      EXPECT_EQ(model.neighbour_pairs(), alone.neighbour_pairs());
      EXPECT_EQ(model.pair_count() + model.apart_count(), alone.pair_count() + alone.apart_count());
      for (int i = testing::cases(100); i > 0; --i) {
        const Configuration q = random.configuration(moving);
        EXPECT_NEAR(spare_clearance(model, q), spare_clearance(alone, q.tail(arm.dof())), 1e-9);
      }
    }
  }
}

TEST(BehindJoints, WhatIsFixedToTheBaseMovesAndMeetsObstacles) {
  const Arm arm = built_in("ur5");
  const std::vector<LinkShapes> links = read_arm_shapes("ur5").links;
  Scene scene;
  scene.obstacles.push_back({.name = "post", .shapes = {{Sphere{0.05}}}});
  scene.obstacles.back().shapes.front().pose.translation() = Vector3(1, 0, 0);
  const CollisionModel model(with_rail(arm, Vector3::UnitX()), behind_joints(links, 1), scene);
  Configuration q(7);
  q << 0, 0, -1.57, 0, 0, 0, 0;
  EXPECT_FALSE(blocked_by(model, q));
  q[0] = 1;
  EXPECT_TRUE(blocked_by(model, q));
}

}  // namespace
}  // namespace beeline
