#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <numbers>

#include <beeline/model/catalog.h>
#include <beeline/reach/reach.h>
#include <beeline/reach/surface.h>

#include "tests/degrees.h"
#include "tests/random.h"
#include "tests/refusal.h"

namespace beeline {
namespace {

using std::numbers::pi;
using testing::cases;
using testing::deg;
using testing::Random;

constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

/// A grid of cells of 0.1 m, whatever the arm.
ReachGrid box(const Vector3& lower, const Vector3& upper) {
  return ReachGrid(
      built_in("ur5"),
      {.resolution = 0.1, .lower = lower, .upper = upper, .orientation = Rotation::Identity()});
}

template <class Value>
std::vector<float> values_at(const ReachGrid& grid, const Value& value) {
  std::vector<float> values;
  for (Eigen::Index p = 0; p < grid.positions(); ++p) {
    values.push_back(static_cast<float>(value(grid.centre(p))));
  }
  return values;
}

/// By the divergence theorem, m3: positive where the triangles are counterclockwise from outside.
double volume(const ReachSurface& surface) {
  double six = 0;
  for (const auto& triangle : surface.triangles.colwise()) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) {
      corners.col(k) = surface.vertices.col(triangle[k]).cast<double>();
    }
    six += corners.determinant();
  }
  return six / 6;
}

/// Expects each edge to belong to two triangles, in opposite directions.
void expect_closed(const ReachSurface& surface) {
  std::map<std::pair<int, int>, int> uses;
  for (const auto& triangle : surface.triangles.colwise()) {
    for (int k = 0; k < 3; ++k) ++uses[{triangle[k], triangle[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : uses) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ((uses.count({edge.second, edge.first})), 1);
  }
}

double ball(const Vector3& point) { return 0.8 - point.norm(); }

TEST(ReachSurface, IsClosedForAnyValues) {
  Random random;
  const ReachGrid grid = box(Vector3::Zero(), Vector3(0.9, 0.7, 0.5));
  for (int i = 0; i < cases(50); ++i) {
    const auto values = values_at(grid, [&](const Vector3&) -> double {
      const double value = random.uniform(-1, 1);
      return value < -0.8 ? std::nan("") : value;
    });
    const ReachSurface surface = reach_surface(grid, values, random.uniform(-1, 1));
    expect_closed(surface);
    EXPECT_GE(volume(surface), 0);
  }
}

TEST(ReachSurface, EnclosesTheVolumeOfABall) {
  const double truth = 4 * pi / 3 * 0.512;
  const ReachGrid grid = box(Vector3::Constant(-1.04), Vector3::Constant(1.1));
  const ReachSurface surface = reach_surface(grid, values_at(grid, ball), 0);
  expect_closed(surface);
  EXPECT_NEAR(volume(surface), truth, 0.02 * truth);
  for (const auto& vertex : surface.vertices.colwise()) EXPECT_NEAR(vertex.norm(), 0.8, 0.01);
  // Where it is only known which centres are inside.
  const auto inside = values_at(grid, [](const Vector3& at) { return ball(at) < 0 ? nothing : 1; });
  EXPECT_NEAR(volume(reach_surface(grid, inside, 0.5)), truth, 0.05 * truth);
}

TEST(ReachSurface, GoesAroundACylinder) {
  const ReachGrid grid(built_in("ur5"), {.resolution = 0.05, .azimuths = 10 * deg});
  const auto around = [](double x) {
    return [x](const Vector3& at) { return 0.3 - (at - Vector3(x, 0, 0.1)).norm(); };
  };
  const double truth = 4 * pi / 3 * 0.027;
  for (const double x : {0.0, 0.4, -0.4}) {  // around the axis, across the seam of the azimuth
    const ReachSurface surface = reach_surface(grid, values_at(grid, around(x)), 0);
    expect_closed(surface);
    EXPECT_NEAR(volume(surface), truth, 0.04 * truth) << x;
  }
  const ReachGrid two(built_in("ur5"), {.azimuths = 180 * deg});
  EXPECT_REFUSED(reach_surface(two, values_at(two, ball), 0), "3 azimuths or more; there are 2");
}

TEST(ReachSurface, EndsAtTheFacesOfTheGrid) {
  const ReachGrid grid = box(Vector3(-0.5, 0, 1), Vector3(0.5, 0.3, 1.1));
  const ReachSurface surface =
      reach_surface(grid, std::vector<float>(static_cast<std::size_t>(grid.positions()), 1), 0);
  expect_closed(surface);
  EXPECT_TRUE(surface.vertices.rowwise().minCoeff().isApprox(Eigen::Vector3f(-0.5F, 0, 1)));
  EXPECT_TRUE(surface.vertices.rowwise().maxCoeff().isApprox(Eigen::Vector3f(0.5F, 0.3F, 1.1F)));
}

TEST(ReachSurface, MovesWithTheGrid) {
  Random random;
  const Vector3 half = Vector3::Constant(1), offset(3, -2, 0.5);
  const ReachGrid grid = box(-half, half), moved = box(offset - half, offset + half);
  const auto values = values_at(grid, [&](const Vector3&) { return random.uniform(0, 1); });
  const ReachSurface surface = reach_surface(grid, values, 0.7);
  const ReachSurface same = reach_surface(moved, values, 0.7);
  EXPECT_EQ(surface.triangles, same.triangles);
  EXPECT_TRUE((surface.vertices.colwise() + offset.cast<float>()).isApprox(same.vertices, 1e-5F));
}

TEST(ReachSurface, DependsOnTheOrderOfTheValuesAlone) {
  const ReachGrid grid = box(Vector3::Constant(-1), Vector3::Constant(1));
  auto values = values_at(grid, ball);
  const ReachSurface surface = reach_surface(grid, values, 0.1);
  for (float& value : values) value = 3 * value - 5;
  const ReachSurface same = reach_surface(grid, values, 3 * 0.1 - 5);
  EXPECT_EQ(surface.triangles, same.triangles);
  EXPECT_TRUE(surface.vertices.isApprox(same.vertices, 1e-5F));
}

TEST(ReachSurface, ShrinksAsItsLevelRises) {
  const Arm arm = built_in("puma560");
  const ReachGrid grid(arm, {.resolution = 0.25, .directions = 90 * deg});
  const ReachCells cells = reach_cells(arm, grid, 0, grid.positions());
  const std::vector<float> directions = reach_positions(grid, cells).directions;
  double last = std::numeric_limits<double>::infinity();
  for (const double level : {0.01, 0.3, 0.6, 0.9}) {
    const ReachSurface surface = reach_surface(grid, directions, level);
    expect_closed(surface);
    EXPECT_LT(volume(surface), last);
    last = volume(surface);
  }
  EXPECT_GT(last, 0);
}

TEST(ReachSurface, IsEmptyWhereNothingIsReached) {
  const ReachGrid grid = box(Vector3::Zero(), Vector3::Constant(0.5));
  const auto count = static_cast<std::size_t>(grid.positions());
  for (const float value : {nothing, 0.4F}) {
    const ReachSurface surface = reach_surface(grid, std::vector<float>(count, value), 0.5);
    EXPECT_EQ(surface.vertices.cols(), 0);
    EXPECT_EQ(surface.triangles.cols(), 0);
  }
}

TEST(ReachSurface, RefusesOtherSizesAndNaN) {
  const ReachGrid grid = box(Vector3::Zero(), Vector3::Constant(0.5));
  EXPECT_REFUSED(reach_surface(grid, std::vector<float>(12), 0.5),
                 "for each of the 125 positions; there are 12");
  EXPECT_REFUSED(reach_surface(grid, std::vector<float>(125), std::nan("")), "level");
}

}  // namespace
}  // namespace beeline
