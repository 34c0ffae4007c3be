#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/kinematics/forward.h>
#include <beeline/trajectory/internal/tool_speed.h>

#include <tests/random_arm.h>
#include <tests/trajectory/motion_by_columns.h>

namespace beeline::internal {
namespace {

using testing::derivatives_between;
using testing::Random;

/// The largest speed of the tool's origin at many points between the samples, by differences of its
/// positions.
double dense_tool_speed(const Arm& arm, const Trajectory& motion, int points) {
  double largest = 0;
  constexpr double du = 1e-4;
  for (std::size_t k = 0; k + 1 < motion.size(); ++k) {
    const double h = motion.times[k + 1] - motion.times[k];
    for (int i = 0; i <= points; ++i) {
      const double u = std::clamp(static_cast<double>(i) / points, du, 1 - du);
      const auto origin = [&](double at) {
        return Vector3(
            forward_kinematics(arm, derivatives_between(motion, k, at, 0)).translation());
      };
      largest = std::max(largest, (origin(u + du) - origin(u - du)).norm() / (2 * du * h));
    }
  }
  return largest;
}

TEST(ToolSpeedBound, IsNeverBelowTheSpeedBetweenSamplesAndCloseToIt) {
  Random random;
  std::vector<double> ratios;
  for (int i = 0; i < testing::cases(150); ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 7), 4);
    const Trajectory motion =
        testing::random_motion(random, arm.joint_names(), random.integer(2, 6),
                               testing::interpolations[random.integer(0, 2)]);
    const double bound = tool_speed_bound(arm, motion);
    const double reached = dense_tool_speed(arm, motion, 60);
    ASSERT_GE(bound, reached * (1 - 1e-6));
    if (reached > 0) ratios.push_back(bound / reached);
  }
  std::sort(ratios.begin(), ratios.end());
  std::cout << "bound / speed: median " << ratios[ratios.size() / 2] << ", largest "
            << ratios.back() << '\n';
  EXPECT_LE(ratios[ratios.size() / 2], 1.01);
  EXPECT_LE(ratios.back(), 1.2);
}

TEST(ToolSpeedBound, IsExactForAGantry) {
  Random random;
  std::vector<Joint> axes;
  for (int i = 0; i < 3; ++i) {
    Joint axis;
    axis.name = "j" + std::to_string(i);
    axis.screw = translation_screw(Vector3::Unit(i));
    axes.push_back(axis);
  }
  const Arm arm("gantry", axes);
  for (int i = 0; i < testing::cases(50); ++i) {
    const Trajectory motion =
        testing::random_motion(random, arm.joint_names(), 5, testing::interpolations[i % 3]);
    double reached = 0;
    for (std::size_t k = 0; k + 1 < motion.size(); ++k) {
      for (int part = 0; part <= 1000; ++part) {
        reached = std::max(reached, derivatives_between(motion, k, part / 1000.0, 1).norm());
      }
    }
    const double bound = tool_speed_bound(arm, motion);
    ASSERT_GE(bound, reached * (1 - 1e-12));
    ASSERT_LE(bound, reached * (1 + 2e-3));
  }
}

TEST(ToolSpeedBound, OfOneSampleIsZero) {
  Random random;
  const Arm arm = testing::random_arm(random, 4);
  EXPECT_EQ(tool_speed_bound(arm, at_rest(arm, Configuration::Zero(4))), 0);
}

}  // namespace
}  // namespace beeline::internal
