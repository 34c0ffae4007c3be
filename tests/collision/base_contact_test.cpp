// Where the base of an arm can stand.

#include <gtest/gtest.h>

#include <beeline/collision/collision_model.h>
#include <beeline/io/text/scene.h>
#include <beeline/model/catalog.h>

#include <tests/degrees.h>
#include <tests/random.h>
#include <tests/reason.h>

namespace beeline {
namespace {

using testing::Random;

Obstacle box_obstacle(const std::string& name, const Vector3& centre, const Vector3& size) {
  return {.name = name, .shapes = {{.body = Box{size}, .pose = make_pose(centre)}}};
}

Reason base_reason(const Arm& arm, const std::vector<LinkShapes>& links,
                   const std::vector<Obstacle>& obstacles, const CollisionOptions& options = {}) {
  return base_blocked_by(CollisionModel(arm, links, {.obstacles = obstacles}, options));
}

/// The base is a cube of 0.2 m that stands on the mount.
const std::vector<LinkShapes> cube{
    {.name = "base",
     .link = 0,
     .shapes = {{.body = Box{Vector3::Constant(0.2)}, .pose = make_pose({0, 0, 0.1})}}},
    {.name = "tip", .link = 6, .shapes = {{.body = Sphere{0.01}}}}};

TEST(BaseContact, StandsOnFloorsAndTables) {
  for (const char* name : {"panda", "ur3", "ur5", "ur10", "ur5e", "iiwa7", "xarm7"}) {
    const std::vector<LinkShapes> links = read_arm_shapes(name).links;
    const Obstacle floor{.name = "floor", .shapes = {{.body = HalfSpace{}}}};
    EXPECT_FALSE(base_reason(built_in(name), links, {floor})) << name;
    EXPECT_FALSE(
        base_reason(built_in(name), links, {box_obstacle("table", {0, 0, -0.02}, {1, 1, 0.04})}))
        << name;
    const Reason inside =
        base_reason(built_in(name), links, {box_obstacle("crate", {0, 0, 0}, {1, 1, 0.2})});
    EXPECT_EQ(inside.code, ReasonCode::bodies_collide) << name;
    EXPECT_EQ(testing::field<std::string>(inside, ReasonField::other_body), "crate");
  }
}

// Along its own z axis: on a wall it stands on the wall.
TEST(BaseContact, StandsOnTheWallAtWhichItIsMounted) {
  const Obstacle floor{.name = "floor", .shapes = {{.body = HalfSpace{}}}};
  const Obstacle wall{
      .name = "wall",
      .shapes = {{.body = HalfSpace{},
                  .pose = make_pose({0, 0, 0}, Rotation(Eigen::AngleAxisd(90 * testing::deg,
                                                                          Vector3::UnitY())))}}};
  const Arm arm = with_mount(built_in("ur5"), wall.shapes[0].pose);
  EXPECT_FALSE(base_reason(arm, cube, {wall}));
  EXPECT_EQ(base_reason(arm, cube, {floor}).code, ReasonCode::bodies_collide);
}

TEST(BaseContact, StandsOnTheFloorInEveryHeading) {
  const Obstacle floor{.name = "floor", .shapes = {{.body = HalfSpace{}}}};
  for (int i = 0; i < 360; ++i) {
    const Rotation heading(Eigen::AngleAxisd(i * testing::deg, Vector3::UnitZ()));
    const Arm arm = with_mount(built_in("ur5"), make_pose({1, 2, 0}, heading));
    EXPECT_FALSE(base_reason(arm, cube, {floor})) << i;
  }
}

TEST(BaseContact, KeepsTheClearanceBesideIt) {
  const Arm arm = built_in("ur5");
  const auto beside = [&](double gap, const CollisionOptions& options = {}) {
    return base_reason(arm, cube, {box_obstacle("pillar", {0.15 + gap, 0, 0.5}, {0.1, 0.1, 1})},
                       options);
  };
  EXPECT_FALSE(beside(0.0011));
  EXPECT_EQ(beside(0.0009).code, ReasonCode::bodies_too_close);
  EXPECT_EQ(beside(-0.01).code, ReasonCode::bodies_collide);
  EXPECT_EQ(testing::field<std::string>(beside(-0.01), ReasonField::body), "base");
  EXPECT_EQ(beside(0.04, {.clearance = 0.05}).code, ReasonCode::bodies_too_close);
  EXPECT_FALSE(beside(-0.01, {.allowed_pairs = {{"pillar", "base"}}}));
}

TEST(BaseContact, AnObstacleThatEndsHigherThanTheOverlapBlocks) {
  const Arm arm = built_in("ur5");
  const auto on_top = [&](double z) {
    return base_reason(arm, cube, {box_obstacle("plinth", {0, 0, z - 0.5}, {1, 1, 1})});
  };
  EXPECT_FALSE(on_top(0.99 * max_standing_overlap));
  EXPECT_TRUE(on_top(1.01 * max_standing_overlap));
}

// Against the boxes themselves: cubes along the axes, and points of a cloud among them.
TEST(BaseContact, OfRandomScenesIsBlockedWhereItsCubeIs) {
  Random random;
  const Arm arm = built_in("ur5");
  int free = 0, blocked = 0;
  for (int i = 0; i < testing::cases(2000); ++i) {
    const Vector3 centre = random.vector(0.5),
                  size = random.vector(0.15).cwiseAbs() + Vector3::Constant(0.01);
    const Vector3 gap = ((centre - Vector3(0, 0, 0.1)).cwiseAbs() - size / 2).array() - 0.1;
    const double distance = gap.cwiseMax(0).norm();
    const bool stands_on = centre.z() + size.z() / 2 <= max_standing_overlap;
    if (std::abs(distance - 1e-3) < 1e-9) continue;
    const Reason reason = base_reason(arm, cube, {box_obstacle("box", centre, size)});
    EXPECT_EQ(static_cast<bool>(reason), !stands_on && distance < 1e-3) << centre.transpose();
    (reason ? blocked : free) += 1;
    Obstacle scan{.name = "scan", .cloud = PointCloud{{Vector3(3, 3, 3), centre}, 0.05}};
    const Vector3 to_point = ((centre - Vector3(0, 0, 0.1)).cwiseAbs()).array() - 0.1;
    const bool near = to_point.cwiseMax(0).norm() - 0.05 < 1e-3;
    const Reason of_cloud = base_reason(arm, cube, {scan});
    EXPECT_EQ(static_cast<bool>(of_cloud), near && centre.z() + 0.05 > max_standing_overlap);
    if (of_cloud) {
      EXPECT_EQ(testing::field<std::size_t>(of_cloud, ReasonField::point), 1U);
    }
  }
  EXPECT_GT(free, testing::cases(2000) / 60);
  EXPECT_GT(blocked, testing::cases(2000) / 60);
}

}  // namespace
}  // namespace beeline
