#include <functional>

#include <beeline/certificate/joint_faults.h>

#include <tests/planning/motion_promises.h>

namespace beeline {
namespace {

using namespace testing;

/// A slide and a turning joint, with limits of everything.
Arm two_joints() {
  Joint slide = composite_joint('P', "slide").front();
  Joint turning = composite_joint('R', "turning").front();
  slide.limits = {.lower = -1, .upper = 1, .velocity = 1, .acceleration = 2, .jerk = 6};
  turning.limits = {.lower = -20, .upper = 20, .velocity = 10, .acceleration = 2, .jerk = 6};
  return {"two", {slide, turning}};
}

/// Both coordinates as functions of time, at uneven times up to the end.
Trajectory along(const std::function<double(double)>& slide,
                 const std::function<double(double)>& turning, double end, int count = 40) {
  Trajectory trajectory;
  trajectory.joint_names = {"slide", "turning"};
  for (int k = 0; k <= count; ++k) {
    const double u = static_cast<double>(k) / count, t = end * u * (0.7 + 0.3 * u);
    trajectory.times.push_back(t);
    trajectory.positions.push_back((Configuration(2) << slide(t), turning(t)).finished());
  }
  return trajectory;
}

double nothing(double) { return 0; }

TEST(ToldByPositions, IsExactForPolynomials) {
  Random random;
  for (int i = 0; i < 100; ++i) {
    const double a = random.uniform(-3, 3), b = random.uniform(-3, 3), c = random.uniform(-3, 3);
    const auto cubic = [&](double t) { return a + b * t + c * t * t * t; };
    const Trajectory motion = along(
        cubic, [&](double t) { return b + c * t * t; }, 2);
    for (std::size_t k = 0; k + 4 < motion.size(); ++k) {
      EXPECT_NEAR(mean_derivative(motion, k, 0, 3), std::abs(6 * c), 1e-7);
      EXPECT_NEAR(mean_derivative(motion, k, 1, 2), std::abs(2 * c), 1e-8);
      EXPECT_NEAR(mean_derivative(motion, k, 1, 3), 0, 1e-7);
    }
  }
}

// The mean value theorem: whatever the rate, a divided difference is no more than the derivative.
TEST(ToldByPositions, IsNeverMoreThanASmoothMotionNeeds) {
  for (const int count : {4, 10, 100, 1000, 30'000}) {
    const Trajectory motion = along([](double t) { return std::sin(t); },
                                    [](double t) { return std::sin(2 * t); }, 6, count);
    for (std::size_t k = 0; k < motion.size(); ++k) {
      for (int order = 1; order <= 3; ++order) {
        ASSERT_LE(mean_derivative(motion, k, 0, order), 1 + 1e-9) << count;
        ASSERT_LE(mean_derivative(motion, k, 1, order), std::pow(2, order) * (1 + 1e-9));
      }
    }
  }
}

TEST(ToldByPositions, IsNothingWhereThereAreTooFewSamples) {
  const Trajectory motion = along([](double t) { return t * t * t; }, nothing, 1, 3);
  EXPECT_GT(mean_derivative(motion, 0, 0, 3), 5);
  EXPECT_EQ(mean_derivative(motion, 1, 0, 3), 0);
  EXPECT_EQ(mean_derivative(motion, 3, 0, 1), 0);
}

TEST(SlowerByPositions, IsTheFactorThatMakesAMotionKeepItsLimits) {
  const Arm arm = two_joints();
  for (const double speed : {0.5, 1.5, 2.0, 3.0}) {
    Trajectory motion =
        along([&](double t) { return 0.8 * std::sin(speed * t); }, nothing, 6 / speed, 400);
    for (const bool jerk : {true, false}) {
      const double factor = slowdown_for_limits(arm, motion, jerk);
      Trajectory slow = motion;
      for (double& t : slow.times) t *= factor;
      EXPECT_NEAR(slowdown_for_limits(arm, slow, jerk), 1, 1e-9);
      const double most = std::max(
          {0.8 * speed, std::sqrt(0.4) * speed, jerk ? std::cbrt(0.8 / 6) * speed : 0.0, 1.0});
      EXPECT_NEAR(factor, most, 1e-3);
    }
  }
}

void expect_first(const Trajectory& motion, Fault kind, std::size_t sample) {
  const auto found = first_joint_fault(two_joints(), motion);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, kind) << found->reason;
  EXPECT_EQ(found->sample, sample) << found->reason;
}

TEST(FirstJointFault, TellsEachKind) {
  const auto still = [] { return along(nothing, nothing, 10); };
  EXPECT_FALSE(first_joint_fault(two_joints(), still()));
  Trajectory motion = still();
  motion.positions[7][0] = 1.1;
  expect_first(motion, Fault::limits, 7);  // though the velocity before it shows it too
  motion = still();
  for (std::size_t k = 9; k < motion.size(); ++k) motion.positions[k][1] = 2 * pi;
  expect_first(motion, Fault::flip, 8);
  motion = along([](double t) { return 1.1 * t - 1; }, nothing, 1.5);
  expect_first(motion, Fault::velocity, 0);
  motion = along([](double t) { return 1.05 * t * t - 1; }, nothing, 0.4);
  expect_first(motion, Fault::acceleration, 0);
  motion = along([](double t) { return 1.05 * t * t * t - 1; }, nothing, 0.3);
  expect_first(motion, Fault::jerk, 0);
}

TEST(FirstJointFault, LooksAtTheCubicBetweenSamplesWithVelocities) {
  Trajectory motion = along(nothing, nothing, 10);
  motion.velocities.assign(motion.size(), Configuration::Zero(2));
  EXPECT_FALSE(first_joint_fault(two_joints(), motion));
  const double h = motion.times[6] - motion.times[5];
  // Of a cubic from rest at 0 to 0 the peak is 4/27 of the slope at its end times h.
  motion.velocities[6][0] = -6.5 / h;
  EXPECT_FALSE(first_joint_fault(two_joints(), motion));
  motion.velocities[6][0] = -6.8 / h;
  expect_first(motion, Fault::limits, 5);
}

}  // namespace
}  // namespace beeline
