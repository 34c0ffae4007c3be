#include <cmath>
#include <gtest/gtest.h>

#include <beeline/draw/internal/trail.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include <tests/random.h>

namespace beeline {
using namespace internal;
namespace {

const Polyline& line_of(const Scene& scene) { return std::get<Polyline>(scene.items[0].shape); }
const Dots& dots_of(const Scene& scene) { return std::get<Dots>(scene.items[1].shape); }

TEST(Trail, KeepsEveryPointOfAShortMotion) {
  testing::Random random;
  for (std::size_t count = 1; count < 300; ++count) {
    std::vector<Vector3> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back(random.vector());
    Scene scene;
    add_trail(scene, points, count);
    EXPECT_EQ(dots_of(scene).points, points);
    EXPECT_EQ(line_of(scene).points, points);
  }
}

TEST(Trail, ThinsOutDotsButKeepsEndsAndCorners) {
  std::vector<Vector3> points;  // a square with a spike that is one sample wide
  constexpr int side = 25'000;
  for (int k = 0; k < 4 * side; ++k) {
    const double s = (k % side) / double(side);
    const Vector3 corners[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}};
    points.push_back(corners[k / side] + s * (corners[k / side + 1] - corners[k / side]));
  }
  points[12'345].y() = -0.5;
  points.emplace_back(0, 0, 0);
  Scene scene;
  add_trail(scene, points);
  const std::vector<Vector3>& dots = dots_of(scene).points;
  const std::vector<Vector3>& line = line_of(scene).points;
  EXPECT_LE(dots.size(), 2000u);
  EXPECT_GE(dots.size(), 1000u);
  EXPECT_LE(line.size(), 4000u);
  EXPECT_EQ(dots.front(), points.front());
  EXPECT_EQ(dots.back(), points.back());
  double lowest = 0;
  for (const Vector3& p : line) lowest = std::min(lowest, p.y());
  EXPECT_EQ(lowest, -0.5);
  for (const Vector3& corner : {Vector3(1, 0, 0), Vector3(1, 1, 0), Vector3(0, 1, 0)}) {
    double nearest = 9;
    for (const Vector3& p : line) nearest = std::min(nearest, (p - corner).norm());
    EXPECT_LT(nearest, 1e-3);
  }
}

TEST(Trail, FollowsTheTool) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  std::vector<Configuration> motion;
  for (int k = 0; k < 50; ++k) motion.push_back(random.configuration(arm));
  const std::vector<Vector3> tool = tool_positions(arm, motion);
  ASSERT_EQ(tool.size(), motion.size());
  for (std::size_t k = 0; k < tool.size(); ++k) {
    EXPECT_EQ(tool[k], forward_kinematics(arm, motion[k]).translation());
  }
}

}  // namespace
}  // namespace beeline
