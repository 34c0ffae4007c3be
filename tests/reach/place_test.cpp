#include <filesystem>
#include <gtest/gtest.h>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>
#include <beeline/reach/place.h>

#include "tests/degrees.h"
#include "tests/random.h"
#include "tests/refusal.h"

namespace beeline {
namespace {

using testing::cases;
using testing::deg;
using testing::Random;

/// A coarse map of a built-in arm.
ReachMap map_of(const char* name, const ReachGridOptions& options = {.directions = 90 * deg}) {
  const Arm arm = built_in(name);
  ReachGridOptions coarse = options;
  coarse.resolution = arm.reach().radius / 4;
  const ReachGrid grid(arm, coarse);
  constexpr int values = 4;
  return {{arm, grid, values},
          reach_cells(arm, grid, 0, grid.positions(), {.redundant_values = values})};
}

/// Poses that the arm reaches from a mount.
std::vector<Pose> poses_from(Random& random, const Arm& arm, const Pose& world_T_mount, int count) {
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    poses.push_back(world_T_mount * forward_kinematics(arm, random.configuration(arm)));
  }
  return poses;
}

TEST(Placement, FindsAMountFromWhichThePosesAreReached) {
  Random random;
  for (const char* name : {"puma560", "ur5", "panda"}) {
    const ReachMap map = map_of(name);
    for (int i = 0; i < cases(4); ++i) {
      Pose there = Pose::Identity();
      there.translation() = Vector3(2, -1, 0.5);
      there.linear() = Eigen::AngleAxisd(90 * deg, Vector3::UnitZ()).toRotationMatrix();
      const std::vector<Pose> poses = poses_from(random, map.arm(), there, 3);
      // A grid of one mount: that one.
      const PlacementOptions one{
          .lower = there.translation(), .upper = there.translation(), .headings = 4};
      const PlacementResult result = find_placements(map, poses, one);
      ASSERT_TRUE(result) << name;
      EXPECT_EQ(result.mounts, 4);
      for (const Placement& placement : result.placements) {
        const Arm arm = with_mount(map.arm(), placement.world_T_mount);
        double least = 1;
        for (std::size_t k = 0; k < poses.size(); ++k) {
          const Configuration& q = placement.solutions[k];
          EXPECT_LT((forward_kinematics(arm, q).matrix() - poses[k].matrix()).norm(), 1e-6);
          for (int j = 0; j < arm.dof(); ++j) {
            const Limits& limits = arm.limits(j);
            least = std::min(least, limit_margin(q[j], limits.lower, limits.upper));
          }
        }
        EXPECT_NEAR(placement.margin, least, 1e-9);
      }
    }
  }
}

// All mounts are checked: what is left out has no solution for some pose.
TEST(Placement, MissesNoMountOfItsGrid) {
  Random random;
  const ReachMap map = map_of("puma560");
  const std::vector<Pose> poses = poses_from(random, map.arm(), Pose::Identity(), 2);
  const PlacementResult result = find_placements(
      map, poses,
      {.lower = Vector3(-2, -2, 0), .upper = Vector3(2, 2, 0), .headings = 1, .count = 1000});
  ASSERT_EQ(result.checked, result.mounts);
  EXPECT_EQ(result.reaching, std::ssize(result.placements));
  double margin = 1;
  for (const Placement& placement : result.placements) {
    EXPECT_LE(placement.margin, margin);
    margin = placement.margin;
  }
  int reaching = 0;
  const double step = map.grid().axes()[0].step;
  for (int x = 0; - 2 + x * step <= 2; ++x) {
    for (int y = 0; - 2 + y * step <= 2; ++y) {
      Pose mount = Pose::Identity();
      mount.translation() = Vector3(-2 + x * step, -2 + y * step, 0);
      bool all = true;
      for (const Pose& pose : poses)
        all = all && inverse_kinematics(map.arm(), mount.inverse() * pose);
      reaching += all;
    }
  }
  EXPECT_EQ(result.reaching, reaching);
}

TEST(Placement, LinesAreProvedFromEachMount) {
  const ReachMap map = map_of("ur5");
  Random random;
  Pose down = Pose::Identity();
  down.linear() = Eigen::AngleAxisd(180 * deg, Vector3::UnitX()).toRotationMatrix();
  std::vector<Pose> poses(4, down);
  for (Pose& pose : poses) pose.translation() = Vector3(0.6, 0, 0.2) + random.vector(0.3);
  const PlacementResult any = find_placements(map, poses, {.count = 1000});
  const PlacementResult lines = find_placements(map, poses, {.count = 5, .lines = true});
  ASSERT_TRUE(lines);
  EXPECT_EQ(any.reaching, lines.reaching);
  for (const Placement& placement : lines.placements) {
    const PathMotion motion = move_in_lines(with_mount(map.arm(), placement.world_T_mount), poses);
    ASSERT_TRUE(motion) << motion.reason;
    EXPECT_EQ(motion.trajectory.times.back(), placement.duration);
  }
}

TEST(Placement, DoesNotDependOnThreads) {
  const ReachMap map = map_of("puma560");
  Random random;
  const std::vector<Pose> poses = poses_from(random, map.arm(), Pose::Identity(), 2);
  const PlacementResult one = find_placements(map, poses, {.threads = 1});
  const PlacementResult four = find_placements(map, poses, {.threads = 4});
  ASSERT_EQ(one.placements.size(), four.placements.size());
  for (std::size_t i = 0; i < one.placements.size(); ++i) {
    EXPECT_TRUE(one.placements[i].world_T_mount.isApprox(four.placements[i].world_T_mount, 0));
  }
}

TEST(Placement, SaysWhyThereIsNone) {
  const ReachMap map = map_of("puma560");
  std::vector<Pose> apart(2, Pose::Identity());
  apart[1].translation().x() = 10;
  EXPECT_EQ(find_placements(map, apart).mounts, 0);
  EXPECT_REFUSED(find_placements(map, {}), "no poses");
  EXPECT_REFUSED(find_placements(map, apart, {.headings = 0}), "headings is 0");
  const ReachMap fixed = map_of("ur5", {.orientation = Rotation::Identity()});
  EXPECT_REFUSED(find_placements(fixed, apart), "one orientation");
}

}  // namespace
}  // namespace beeline
