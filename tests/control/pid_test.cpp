#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include <beeline/control/joint.h>
#include <beeline/model/catalog.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

TEST(Pid, IsTheSumOfItsThreeParts) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const PidGains gains{0.3, 0.02, 0.1};
  const Configuration goal = random.configuration(arm);
  Pid pid(gains, goal);
  Configuration before = goal - random.configuration(arm), sum = Configuration::Zero(7);
  pid.start(goal - before);
  for (int i = 0; i < 20; ++i) {
    const Configuration q = random.configuration(arm), e = goal - q;
    sum += e;
    const Configuration expected = gains.kp * e + gains.ki * sum + gains.kd * (e - before);
    EXPECT_LT((pid.step(q) - expected).norm(), 1e-12);
    before = e;
  }
}

TEST(Pid, TakesANewGoalWithoutAJump) {
  const Eigen::Vector2d first(1, 2), second(-1, 1), q(0.5, 0.5);
  Pid pid({.kp = 0.5, .kd = 10}, first);
  pid.start(q);
  pid.set_goal(second);
  EXPECT_LT((pid.step(q) - 0.5 * (second - q)).norm(), 1e-12);
}

TEST(Pid, RefusesInvalidArguments) {
  const Eigen::Vector2d goal(1, 2);
  EXPECT_REFUSED((Pid({.kp = 0}, goal)), "kp");
  EXPECT_REFUSED((Pid({.ki = -1}, goal)), "ki");
  Pid pid({}, goal);
  EXPECT_REFUSED((pid.step(Configuration::Zero(3))), "has 2 joint values, the configuration 3");
  EXPECT_REFUSED((pid.set_goal(Configuration::Zero(3))), "has 2 joint values, the configuration 3");
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Vector2d unknown(0, nan), far(-Limits::none, 0);
  EXPECT_REFUSED((Pid({}, unknown)), "the value of joint 2 is nan; it must be a finite number");
  EXPECT_REFUSED(pid.step(unknown), "the value of joint 2 is nan; it must be a finite number");
  EXPECT_REFUSED(pid.start(unknown), "must be a finite number");
  EXPECT_REFUSED(pid.set_goal(far), "the value of joint 1 is -inf; it must be a finite number");
  EXPECT_EQ(pid.step(goal), Configuration::Zero(2));  // nothing of them is in the state
}

}  // namespace
}  // namespace beeline
