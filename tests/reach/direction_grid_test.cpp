#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/reach/grid.h>

#include "tests/degrees.h"
#include "tests/random.h"
#include "tests/refusal.h"

namespace beeline {
namespace {

using testing::cases;
using testing::deg;
using testing::Random;

TEST(Directions, FractionsSumToTheSphere) {
  for (const double spacing : {90.0, 45.0, 30.0, 17.0, 5.0, 1.0}) {
    const DirectionGrid grid(spacing * deg);
    double sum = 0;
    Vector3 mean = Vector3::Zero();
    for (Eigen::Index k = 0; k < grid.size(); ++k) {
      sum += grid.fraction(k);
      mean += grid.fraction(k) * grid.direction(k);
      EXPECT_NEAR(grid.direction(k).norm(), 1, 1e-14);
    }
    EXPECT_NEAR(sum, 1, 1e-12) << spacing;
    EXPECT_LT(mean.norm(), 1e-12) << spacing;
  }
}

TEST(Directions, EachIsNearestToItself) {
  for (const double spacing : {90.0, 30.0, 7.0}) {
    const DirectionGrid grid(spacing * deg);
    for (Eigen::Index k = 0; k < grid.size(); ++k) EXPECT_EQ(grid.nearest(grid.direction(k)), k);
  }
}

// Even: no point of the sphere is far from a direction, and no two directions are close.
TEST(Directions, CoverTheSphereEvenly) {
  Random random;
  for (const double spacing : {45.0, 30.0, 10.0, 3.0}) {
    const DirectionGrid grid(spacing * deg);
    double farthest = 0;
    for (int i = 0; i < cases(20000); ++i) {
      const Vector3 direction = random.direction();
      const Vector3 nearest = grid.direction(grid.nearest(direction));
      farthest = std::max(farthest, std::acos(std::min(1.0, nearest.dot(direction))));
    }
    EXPECT_LT(farthest, 0.85 * grid.spacing());
    double closest = 10;
    const Eigen::Index count = std::min<Eigen::Index>(grid.size(), 600);
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index k = 0; k < i; ++k) {
        closest = std::min(closest, std::acos(grid.direction(i).dot(grid.direction(k))));
      }
    }
    EXPECT_GT(closest, 0.69 * grid.spacing());
  }
}

TEST(Directions, HaveTheAxesAndAreTheSameAfterAQuarterRevolution) {
  const DirectionGrid grid(30 * deg);
  EXPECT_EQ(grid.size(), 54);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Vector3 direction = sign * Vector3::Unit(axis);
      EXPECT_NEAR(grid.direction(grid.nearest(direction)).dot(direction), 1, 1e-14);
    }
  }
  for (Eigen::Index k = 0; k < grid.size(); ++k) {
    const Vector3 d = grid.direction(k), turned(-d.y(), d.x(), d.z());
    EXPECT_NEAR(grid.direction(grid.nearest(turned)).dot(turned), 1, 1e-14);
  }
}

TEST(Directions, RefuseASpacingThatIsNone) {
  for (const double spacing : {0.0, -1.0, 0.001, 2.0, std::nan("")}) {
    EXPECT_REFUSED(DirectionGrid{spacing}, "0.01 to 1.5708");
  }
  EXPECT_REFUSED(DirectionGrid(1).nearest(Vector3::Zero()), "zero");
}

}  // namespace
}  // namespace beeline
