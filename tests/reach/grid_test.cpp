
#include <gtest/gtest.h>

#include <beeline/model/catalog.h>
#include <beeline/reach/grid.h>

#include "tests/degrees.h"
#include "tests/random.h"
#include "tests/refusal.h"

namespace beeline {
namespace {

using testing::cases;
using testing::deg;
using testing::Random;

/// Grids with each kind of orientations.
std::vector<ReachGrid> grids() {
  return {
      ReachGrid(built_in("ur5"), {.resolution = 0.11}),
      ReachGrid(built_in("ur5"), {.resolution = 0.13,
                                  .lower = Vector3(-0.2, 0.1, -0.4),
                                  .upper = Vector3(0.7, 0.9, 1),
                                  .directions = 45 * deg,
                                  .rolls = 50 * deg}),
      ReachGrid(built_in("puma560"), {.orientation = Rotation::Identity()}),
      ReachGrid(built_in("rrr"), {.directions = 40 * deg}),
      ReachGrid(built_in("rrr"), {.azimuths = 25 * deg}),
      ReachGrid(
          with_mount(built_in("puma560"), Pose(Eigen::Translation3d(0.4, -0.3, 0.2))),
          {.resolution = 0.09, .azimuths = 40 * deg, .directions = 45 * deg, .rolls = 70 * deg})};
}

TEST(ReachGrid, TheCellOfACentreIsThatCell) {
  Random random;
  for (const ReachGrid& grid : grids()) {
    for (int i = 0; i < cases(500); ++i) {
      const auto cell =
          static_cast<Eigen::Index>(random.uniform(0, 1) * static_cast<double>(grid.cells() - 1));
      EXPECT_EQ(grid.cell_of(grid.pose(cell)), cell);
    }
  }
}

TEST(ReachGrid, APoseIsWithinHalfACellOfItsCellsCentre) {
  Random random;
  for (const ReachGrid& grid : grids()) {
    if (grid.cylindrical()) continue;
    const ReachAxis& x = grid.axes()[0];
    for (int i = 0; i < cases(500); ++i) {
      Pose pose = random.pose(1.2 * x.upper());
      if (grid.axes()[2].cells == 1) pose.translation().z() = grid.axes()[2].centre(0);
      const std::optional<Eigen::Index> cell = grid.cell_of(pose);
      bool inside = true;
      for (int k = 0; k < 3; ++k) {
        const double value = pose.translation()[k];
        inside = inside && value >= grid.axes()[k].lower && value <= grid.axes()[k].upper();
      }
      ASSERT_EQ(cell.has_value(), inside);
      if (!cell) continue;
      const Vector3 offset = grid.pose(*cell).translation() - pose.translation();
      EXPECT_LE(offset.cwiseAbs().maxCoeff(), x.step / 2 * (1 + 1e-9));
    }
  }
}

TEST(ReachGrid, TheDefaultBoxContainsTheReach) {
  const Arm arm = built_in("panda");
  const ReachGrid grid(arm);
  EXPECT_EQ(grid.positions(), 40 * 40 * 40);
  EXPECT_EQ(grid.directions(), 54);
  for (int k = 0; k < 3; ++k) {
    EXPECT_LE(grid.axes()[k].lower, arm.reach().centre[k] - arm.reach().radius + 1e-12);
    EXPECT_GE(grid.axes()[k].upper(), arm.reach().centre[k] + arm.reach().radius - 1e-12);
  }
}

TEST(ReachGrid, TheZAxisOfARotationIsItsDirection) {
  const ReachGrid grid = grids()[1];
  for (Eigen::Index d = 0; d < grid.directions(); ++d) {
    for (Eigen::Index r = 0; r < grid.rolls(); ++r) {
      const Rotation rotation = grid.rotation(d, r);
      EXPECT_LT((rotation.col(2) - grid.direction_grid().direction(d)).norm(), 1e-14);
      EXPECT_NEAR(rotation.determinant(), 1, 1e-14);
    }
  }
}

TEST(ReachGrid, FractionsOfDirectionsSumToOne) {
  for (const ReachGrid& grid : grids()) {
    double sum = 0;
    for (Eigen::Index d = 0; d < grid.directions(); ++d) sum += grid.fraction(d);
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

TEST(ReachGrid, TheOptionsOfAGridGiveTheSameGrid) {
  for (const char* name : {"ur5", "rrr"}) {
    for (const std::optional<double> azimuths : {std::optional<double>{}, {33 * deg}}) {
      const Arm arm = built_in(name);
      const ReachGrid grid(arm, {.resolution = 0.13, .azimuths = azimuths, .directions = 1.0});
      const ReachGrid again(arm, grid.options());
      EXPECT_EQ(grid.cells(), again.cells());
      for (Eigen::Index cell = 0; cell < grid.cells(); cell += 1 + grid.cells() / 97) {
        EXPECT_TRUE(grid.pose(cell).isApprox(again.pose(cell), 1e-14));
      }
    }
  }
}

TEST(ReachGrid, TheCellsOfACylinderFillIt) {
  const ReachGrid grid(built_in("ur5"), {.resolution = 0.1, .azimuths = 10 * deg});
  double volume = 0;
  for (Eigen::Index p = 0; p < grid.positions(); ++p) volume += grid.volume(p);
  const double radius = grid.axes()[0].upper(),
               height = grid.axes()[1].upper() - grid.axes()[1].lower;
  EXPECT_NEAR(volume, 180 * deg * radius * radius * height, 1e-9);
  const std::array<ReachAxis, 3> box = grid.cartesian_axes();
  EXPECT_LE(box[0].lower, -radius);
  EXPECT_GE(box[1].upper(), radius);
}

TEST(ReachGrid, HasItsEdgesInsideWhateverTheirLastDigit) {
  const ReachGrid grid(built_in("puma560"), {.resolution = 0.12});
  const auto axis = grid.axes()[0];
  EXPECT_EQ(axis.cell_of(axis.lower - 1e-12), 0);
  EXPECT_EQ(axis.cell_of(axis.upper() + 1e-12), axis.cells - 1);
  EXPECT_EQ(axis.cell_of(axis.lower - 1e-6), std::nullopt);
  EXPECT_EQ(axis.cell_of(axis.upper() + 1e-6), std::nullopt);
}

TEST(ReachGrid, RefusesWhatIsNoGrid) {
  const Arm arm = built_in("ur5");
  EXPECT_REFUSED(ReachGrid(arm, {.resolution = 0.0}), "the resolution is 0 m");
  EXPECT_REFUSED(ReachGrid(arm, {.resolution = 1e-9}), "coarser resolution");
  EXPECT_REFUSED(ReachGrid(arm, {.lower = Vector3(0, 2, 0), .upper = Vector3(1, 1, 1)}), "lower y");
  EXPECT_REFUSED(ReachGrid(arm, {.directions = 5.0}), "0.6 to 90 degrees");
  EXPECT_REFUSED(ReachGrid(arm, {.rolls = 0.0}), "0.6 to 360 degrees");
  EXPECT_REFUSED(ReachGrid(arm, {.orientation = Rotation::Identity(), .rolls = 1.0}),
                 "not several");
  EXPECT_REFUSED(ReachGrid(arm, {.orientation = Rotation::Zero()}), "the orientation of the map");
  EXPECT_REFUSED(ReachGrid(built_in("rrr"), {.rolls = 1.0}), "no rolls");
  EXPECT_REFUSED(ReachGrid(arm, {.azimuths = 0.001}), "the angle between azimuths");
  EXPECT_REFUSED(ReachGrid(built_in("gantry"), {.azimuths = 1.0}), "does not turn it about");
  EXPECT_REFUSED(ReachGrid(arm, {.azimuths = 1.0, .orientation = Rotation::Identity()}),
                 "turn with the azimuth");
  EXPECT_REFUSED(ReachGrid(arm, {.any_orientation = true, .directions = 1.0}), "not several");
  Pose tilted = Pose::Identity();
  tilted.linear() = Eigen::AngleAxisd(0.1, Vector3::UnitX()).toRotationMatrix();
  EXPECT_REFUSED(ReachGrid(with_mount(arm, tilted), {.azimuths = 1.0}),
                 "parallel to the world's z");
  tilted.linear() = Eigen::AngleAxisd(3.7e-6, Vector3::UnitX()).toRotationMatrix();
  EXPECT_REFUSED(ReachGrid(with_mount(arm, tilted), {.azimuths = 1.0}), "tilted by 3.7");
}

}  // namespace
}  // namespace beeline
