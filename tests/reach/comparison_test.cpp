#include <cmath>
#include <gtest/gtest.h>

#include <beeline/model/catalog.h>
#include <beeline/reach/surface.h>

#include "tests/degrees.h"
#include "tests/random.h"
#include "tests/refusal.h"

namespace beeline {
namespace {

using testing::deg;

ReachMap map_of(const Arm& arm, const ReachGridOptions& options) {
  const ReachGrid grid(arm, options);
  return {{arm, grid}, reach_cells(arm, grid, 0, grid.positions())};
}

void expect_same(const ReachSide& a, const ReachSide& b) {
  EXPECT_DOUBLE_EQ(a.volume, b.volume);
  EXPECT_DOUBLE_EQ(a.volume_only_here, b.volume_only_here);
  EXPECT_DOUBLE_EQ(a.volume_more_directions, b.volume_more_directions);
  EXPECT_DOUBLE_EQ(a.directions, b.directions);
  EXPECT_DOUBLE_EQ(a.manipulability, b.manipulability);
  EXPECT_DOUBLE_EQ(a.margin, b.margin);
}

TEST(ReachComparison, OfAMapWithItselfHasNoDifference) {
  for (const char* name : {"puma560", "rrr"}) {
    const Arm arm = built_in(name);
    ReachGridOptions options{.directions = 60 * deg};
    if (testing::slow_build)
      options = {.resolution = arm.reach().radius / 5, .directions = 90 * deg};
    const ReachMap map = map_of(arm, options);
    const ReachComparison same = compare_reach(map, map);
    expect_same(same.sides[0], same.sides[1]);
    EXPECT_EQ(same.sides[0].volume_only_here, 0);
    EXPECT_EQ(same.sides[0].volume_more_directions, 0);
    EXPECT_NEAR(same.sides[0].volume, map.totals().volume, 1e-9);
    EXPECT_NEAR(same.both, map.totals().volume, 1e-9);
    EXPECT_GT(same.sides[0].directions, 0.1);
  }
}

TEST(ReachComparison, TheOtherWayRoundExchangesTheSides) {
  const ReachMap ur5 = map_of(built_in("ur5"), {.resolution = 0.21, .directions = 60 * deg});
  const ReachMap puma = map_of(built_in("puma560"), {.resolution = 0.17, .directions = 45 * deg});
  const ReachComparison a = compare_reach(ur5, puma), b = compare_reach(puma, ur5);
  EXPECT_EQ(a.step, 0.17);
  expect_same(a.sides[0], b.sides[1]);
  expect_same(a.sides[1], b.sides[0]);
  for (const ReachSide& side : a.sides)
    EXPECT_NEAR(side.volume_only_here + a.both, side.volume, 1e-9);
}

// An arm on a pedestal reaches the same, higher.
TEST(ReachComparison, OfTwoMountsFindsWhatMoved) {
  const double step = 0.15;
  const Arm arm = built_in("puma560");
  const ReachMap low = map_of(arm, {.resolution = step, .directions = 60 * deg});
  const Arm raised = with_mount(arm, Pose(Eigen::Translation3d(0, 0, 4 * step)));
  const ReachMap high = map_of(raised, {.resolution = step, .directions = 60 * deg});
  const ReachComparison moved = compare_reach(low, high);
  EXPECT_NEAR(moved.sides[0].volume, moved.sides[1].volume, 1e-9);
  EXPECT_NEAR(moved.sides[0].volume_only_here, moved.sides[1].volume_only_here, 1e-9);
  EXPECT_GT(moved.sides[0].volume_only_here, 0);
  EXPECT_GT(moved.both, 0);
  const auto slices = slices_of(low, high, 2, 0.6);
  EXPECT_EQ(slices[0].values.size(), slices[1].values.size());
  EXPECT_FALSE(slices[0].values.cwiseEqual(slices[1].values).all());
}

// A box and a cylinder of the same arm agree except for the size of their cells.
TEST(ReachComparison, OfABoxAndACylinderOfAnArmFindsLittle) {
  Arm arm = built_in("puma560");
  arm = with_limits(arm, {{arm.joints()[0].name, {.lower = -0.5, .upper = 1.5}}});
  const ReachGridOptions cells{.resolution = 0.07, .directions = 60 * deg};
  ReachGridOptions turned = cells;
  turned.azimuths = 5 * deg;
  const ReachMap box = map_of(arm, cells);
  const ReachComparison compared = compare_reach(box, map_of(arm, turned));
  for (const ReachSide& side : compared.sides) EXPECT_LT(side.volume_only_here, 0.15 * side.volume);
  // Turned by 20 degrees, more differs.
  const Arm other = with_mount(arm, Pose(Eigen::AngleAxisd(20 * deg, Vector3::UnitZ())));
  EXPECT_GT(compare_reach(box, map_of(other, turned)).sides[0].volume_only_here,
            2 * compared.sides[0].volume_only_here);
}

TEST(ReachComparison, RefusesMapsThatCannotBeCompared) {
  const ReachMap directions = map_of(built_in("ur5"), {.resolution = 0.4});
  const ReachMap fixed =
      map_of(built_in("ur5"), {.resolution = 0.4, .orientation = Rotation::Identity()});
  EXPECT_REFUSED(compare_reach(directions, fixed), "directions and fixed");
  const Arm arm = built_in("ur5");
  const ReachGrid grid(arm, {.resolution = 0.4});
  const ReachCells cells = reach_cells(arm, grid, 0, grid.positions(), {.samples = 1000});
  const ReachMap sampled({.arm = arm, .grid = grid, .samples = 1000}, cells);
  EXPECT_REFUSED(compare_reach(directions, sampled), "one map is by sampling");
}

}  // namespace
}  // namespace beeline
