#include <cmath>
#include <gtest/gtest.h>

#include <beeline/certificate/verify.h>

#include <tests/random.h>
#include <tests/reason.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

constexpr double resolution = 1e-9;  // of a fall, m

/// A slide from 0 to 1 m that may be as fast as it likes.
Arm rail() {
  Joint joint = composite_joint('P', "rail").front();
  joint.limits = {.lower = 0, .upper = 1, .velocity = 1e6, .acceleration = 1e9};
  return Arm("rail", {joint});
}

Configuration at(double x) { return Configuration::Constant(1, x); }

/// A cubic motion with a sample a second.
Trajectory through(const std::vector<double>& positions, const std::vector<double>& velocities) {
  Trajectory trajectory;
  trajectory.joint_names = {"rail"};
  for (std::size_t k = 0; k < positions.size(); ++k) {
    trajectory.times.push_back(static_cast<double>(k));
    trajectory.positions.push_back(at(positions[k]));
    trajectory.velocities.push_back(at(velocities[k]));
  }
  return trajectory;
}

Verification checked(const Trajectory& trajectory, double recover) {
  return verify(rail(), trajectory, VerifyOptions{.moving = {true, true}, .recover = recover});
}

/// The largest rise of the excess over the upper limit, by many samples.
double sampled_rise(const Trajectory& trajectory) {
  constexpr int samples = 4000;
  double smallest = Limits::none, rise = 0;
  for (int i = 0; i <= samples; ++i) {
    const double excess = sample(trajectory, trajectory.duration() * i / samples).position[0] - 1;
    rise = std::max(rise, excess - std::max(0.0, smallest));
    smallest = std::min(smallest, excess);
  }
  return rise;
}

TEST(Recovery, AcceptsExactlyAnExcessThatFalls) {
  testing::Random random;
  int accepted = 0, refused = 0;
  for (int i = 0; i < 1500; ++i) {
    std::vector<double> positions{1 + random.uniform(1e-3, 0.05)}, velocities{0};
    const int count = random.integer(2, 5);
    for (int k = 0; k < count; ++k) {
      positions.push_back(positions.back() - random.uniform(-1e-4, 0.03));
      velocities.push_back(random.uniform(-0.03, 0.002));
    }
    positions.push_back(random.uniform(0.5, 1));
    velocities.push_back(0);
    const Trajectory motion = through(positions, velocities);
    const Verification found = checked(motion, 0.1);
    const double rise = sampled_rise(motion);
    if (found) {
      ++accepted;
      EXPECT_LE(rise, resolution + 1e-12);
      ASSERT_TRUE(found.recovery);
      EXPECT_EQ(found.recovery->excess, positions[0] - 1);
      EXPECT_EQ(found.recovery->joint, "rail");
    } else {
      ++refused;
      EXPECT_EQ(found.fault, Fault::limits) << found.reason;
      // A rise between two of the samples of sampled_rise() is small.
      if (rise == 0) {
        EXPECT_LT(testing::field<double>(found.reason, ReasonField::change).value_or(0), 1e-5);
      }
    }
    if (rise > 2 * resolution) {
      EXPECT_FALSE(found) << rise;
    }
    EXPECT_EQ(checked(motion, 0).fault, Fault::limits);
    EXPECT_EQ(checked(motion, 0).sample, 0);
    EXPECT_FALSE(checked(motion, 0).recovery);
    EXPECT_FALSE(checked(motion, (positions[0] - 1) / 2));
  }
  EXPECT_GT(accepted, 150);
  EXPECT_GT(refused, 150);
}

TEST(Recovery, NamesWhatIsWrong) {
  const auto code = [](const Trajectory& motion) { return checked(motion, 0.1).reason.code; };
  EXPECT_EQ(code(through({1.05, 0.5}, {0, 0})), ReasonCode::none);
  EXPECT_EQ(code(through({1.05, 1.06, 0.5}, {0, 0, 0})), ReasonCode::excess_rises);
  EXPECT_EQ(code(through({1.05, 0.5}, {0.1, 0})), ReasonCode::excess_rises) << "between samples";
  EXPECT_EQ(code(through({1.05, 0.9, 1.01, 0.5}, {0, 0, 0, 0})), ReasonCode::outside_limits)
      << "it leaves again";
  EXPECT_EQ(code(through({1.05, 1.04}, {0, 0})), ReasonCode::outside_limits) << "it never returns";
  EXPECT_EQ(code(through({1.05, 1.0, 0.5}, {0, 0.5, 0})), ReasonCode::moves_outside_limits);
  EXPECT_EQ(code(through({1.05, -0.5}, {0, 0})), ReasonCode::outside_limits) << "the other limit";
  EXPECT_EQ(code(through({1.05, 0.02, 0.5}, {0, -3, 0})), ReasonCode::moves_outside_limits);
  EXPECT_EQ(code(through({1.2, 0.5}, {0, 0})), ReasonCode::outside_limits) << "too far";
}

TEST(Recovery, EndsAtTheFirstSampleWithin) {
  const auto found = recovery_of(rail(), through({1.05, 1.02, 1, 0.5}, {0, 0, 0, 0}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->sample, 2);
  EXPECT_EQ(found->time, 2);
  EXPECT_FALSE(recovery_of(rail(), through({1 + resolution / 2, 0.5}, {0, 0})));
  EXPECT_DOUBLE_EQ(slight_excess(rail()), 1e-4);
  EXPECT_EQ(nearest_within_limits(rail(), at(1.05)), at(1));
  EXPECT_EQ(nearest_within_limits(rail(), at(-7)), at(0));
  EXPECT_EQ(nearest_within_limits(rail(), at(0.3)), at(0.3));
}

TEST(Recovery, RefusesAmountsOutOfRange) {
  const Trajectory motion = through({0.5, 0.6}, {0, 0});
  for (const double wrong : {-1e-9, -1.0, 0.11, 1e300, Limits::none, -Limits::none, std::nan("")}) {
    EXPECT_REFUSED(checked(motion, wrong), "recover must be from 0 to 0.1 rad or m, not ");
    EXPECT_REFUSED(first_joint_fault(rail(), motion, {}, {}, 0, wrong), "recover must be");
  }
}

}  // namespace
}  // namespace beeline
