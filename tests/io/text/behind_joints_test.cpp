#include <gtest/gtest.h>

#include <beeline/collision/collision_model.h>
#include <beeline/io/text/scene.h>
#include <beeline/model/catalog.h>
#include <beeline/model/moving_base.h>

#include <tests/random.h>

namespace beeline {
namespace {

TEST(BehindJoints, TheShapesOfTheArmAreCarriedByItsMovingBase) {
  if (testing::slow_build) GTEST_SKIP() << "distances of hulls, which take a minute";
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
  const std::vector<LinkShapes> links{{.name = "foot", .link = 0, .shapes = {{Sphere{0.05}}}},
                                      {.name = "wrist", .link = 6, .shapes = {{Sphere{0.05}}}}};
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

TEST(BehindJoints, TheBaseOfAFileStaysANeighbour) {
  const std::string box = "<collision><geometry><box size='0.1 0.1 0.1'/></geometry></collision>";
  const std::string turn =
      "<axis xyz='0 0 1'/><limit lower='-1' upper='1' velocity='1' effort='1'/>";
  const std::string urdf = "<robot name='two'><link name='foot'>" + box +
                           "</link><link name='arm'>" + box +
                           "</link><joint name='turn' type='revolute'><parent link='foot'/>" +
                           "<child link='arm'/>" + turn + "</joint></robot>";
  const Arm moving = with_rail(arm_from_urdf(urdf, "two.urdf"), Vector3::UnitX(), {0, 1});
  std::vector<LinkShapes> links = behind_joints(arm_shapes_from_text(urdf, "two.urdf").links, 1);
  links.push_back({.name = "floor", .link = 0, .shapes = {{Sphere{0.1}}}});
  const std::string written = arm_to_json(moving, links);
  EXPECT_EQ(written.find("attached"), std::string::npos);
  const std::vector<LinkShapes> read = arm_shapes_from_text(written, "two.json").links;
  const auto neighbours = CollisionModel(moving, links).neighbour_pairs();
  EXPECT_EQ(neighbours.size(), 2U);
  EXPECT_EQ(CollisionModel(moving, read).neighbour_pairs(), neighbours);
}

TEST(BehindJoints, NamedBodiesStandAndTooManyJointsAreRefused) {
  const std::vector<LinkShapes> links{{.name = "table", .link = 0, .shapes = {}},
                                      {.name = "foot", .link = 0, .shapes = {}},
                                      {.name = "arm", .link = 1, .shapes = {}}};
  const std::vector<LinkShapes> behind = behind_joints(links, 3, {"table", "arm"});
  EXPECT_EQ(behind[0].link, 0U);
  EXPECT_FALSE(behind[0].at_distal_joint);
  EXPECT_EQ(behind[1].link, 3U);
  EXPECT_EQ(behind[2].link, 4U);
  EXPECT_THROW(behind_joints(links, 101), Error);
  EXPECT_THROW(behind_joints(links, static_cast<std::size_t>(-1)), Error);
}

}  // namespace
}  // namespace beeline
