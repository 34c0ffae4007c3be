// Mounts at which a scene blocks the arm.

#include <algorithm>
#include <gtest/gtest.h>

#include <beeline/collision/collision_model.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/reach/place.h>
#include <beeline/reach/reach.h>

#include <tests/degrees.h>

namespace beeline {
namespace {

TEST(BlockedAtMounts, HaveNoBaseInsideAnObstacle) {
  const Arm arm = built_in("ur5");
  const ReachGrid grid(arm,
                       {.resolution = arm.reach().radius / 4, .directions = 90 * testing::deg});
  const ReachMap map({arm, grid}, reach_cells(arm, grid, 0, grid.positions()));
  Configuration q(6);
  q << 0.2, -1.2, 1.6, -1.9, -1.5, 0.3;
  const std::vector<Pose> poses{forward_kinematics(arm, q)};
  const std::vector<LinkShapes> links{
      {.name = "base", .shapes = {{.body = Sphere{0.1}}}},
      {.name = "tip", .link = 6, .shapes = {{.body = Sphere{0.01}}}}};
  const CollisionModel model(
      arm, links,
      {.obstacles = {{"box", {{Box{Vector3::Constant(0.3)}, make_pose({0.2, 0, 0.1})}}}}});
  PlacementOptions options{.lower = Vector3(-0.5, 0, 0),
                           .upper = Vector3(0.5, 0, 0),
                           .step = 0.1,
                           .headings = 1,
                           .count = 100};
  const PlacementResult all = find_placements(map, poses, options);
  options.blocked_by = blocked_at_mounts(model);
  const PlacementResult free = find_placements(map, poses, options);
  const auto is_clear = [](const Placement& one) {  // from the box, x 0.05 to 0.35
    return std::abs(one.world_T_mount.translation().x() - 0.2) > 0.25;
  };
  EXPECT_EQ(std::ssize(free.placements),
            std::count_if(all.placements.begin(), all.placements.end(), is_clear));
  EXPECT_TRUE(std::all_of(free.placements.begin(), free.placements.end(), is_clear));
  EXPECT_GT(free.blocked, 0);
  ASSERT_TRUE(free.blocked_reason.has(ReasonField::body));
  EXPECT_EQ(std::get<std::string>(*free.blocked_reason.find(ReasonField::body)), "base");
}

}  // namespace
}  // namespace beeline
