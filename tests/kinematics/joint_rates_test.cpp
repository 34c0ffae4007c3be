#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/mask.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/math/damped_least_squares.h>
#include <beeline/math/minimum_norm.h>
#include <beeline/model/catalog.h>

#include <tests/random_arm.h>
#include <tests/reason.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

Configuration random_rates(testing::Random& random, const Arm& arm) {
  Configuration rates(arm.dof());
  for (double& rate : rates) rate = random.uniform(-1, 1);
  return rates;
}

TEST(JointRates, GiveTheVelocityWithTheLeastNorm) {
  testing::Random random;
  for (int i = 0; i < testing::cases(600); ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 9), i % 2);
    const Configuration q = random.configuration(arm), some = random_rates(random, arm);
    for (const Frame frame : {Frame::base, Frame::tool, Frame::space}) {
      for (const char* task : {"spatial", "position", "111110", "000111"}) {
        const Eigen::MatrixXd j = selected_rows(task_named(task), jacobian(arm, q, frame));
        const Eigen::VectorXd velocity = j * some;
        const JointRates found =
            joint_rates(arm, q, velocity, {.task = task_named(task), .frame = frame});
        const double size = 1 + velocity.norm();
        if (!found.singular) {
          ASSERT_TRUE(found) << found.reason;
          ASSERT_EQ(found.status, RatesStatus::solved);
        }
        ASSERT_LT(found.residual, 1e-7 * size);
        ASSERT_NEAR((j * found.rates - velocity).norm(), found.residual, 1e-12 * size);
        ASSERT_LT((j * found.rates - found.tool_velocity).norm(), 1e-12 * size);
        const Eigen::VectorXd least = internal::minimum_norm_solution(j, velocity, 1e-8).x;
        ASSERT_LT((found.rates - least).norm(), 1e-6 * (1 + least.norm()));
        ASSERT_LE(found.rates.norm(), some.norm() * (1 + 1e-6));
      }
    }
  }
}

TEST(JointRates, MoveTheToolAsForwardKinematicsSays) {
  testing::Random random;
  constexpr double dt = 1e-6;
  for (const char* name : {"panda", "ur5e", "iiwa14", "puma560"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < 50; ++i) {
      const Configuration q = random.configuration(arm);
      Twist velocity;
      velocity << random.vector(), random.vector();
      const JointRates found = joint_rates(arm, q, velocity, {.frame = Frame::tool});
      if (found.rates.norm() > 20) continue;  // near a singularity the motion is too large
      const Twist moved = se3_log(forward_kinematics(arm, q - dt * found.rates).inverse() *
                                  forward_kinematics(arm, q + dt * found.rates)) /
                          (2 * dt);
      ASSERT_LT((moved - velocity).norm(), 1e-6) << name;
    }
  }
}

TEST(JointRates, NameTheDirectionThatIsLost) {
  testing::Random random;
  const Arm rrr = built_in("rrr");
  for (int i = 0; i < 100; ++i) {
    const double heading = random.uniform(-3, 3);
    const Configuration q = Vector3(heading, 0, 0);  // stretched
    const Vector3 along(std::cos(heading), std::sin(heading), 0);
    const JointRates none = joint_rates(rrr, q, 0.3 * along);
    EXPECT_EQ(none.status, RatesStatus::singular);
    EXPECT_FALSE(none);
    EXPECT_TRUE(none.singular);
    ASSERT_EQ(none.lost_directions.cols(), 1);
    EXPECT_NEAR(std::abs(none.lost_directions.col(0).dot(along)), 1, 1e-12);
    EXPECT_NEAR(none.residual, 0.3, 1e-12);
    EXPECT_LT(none.rates.norm(), 1e-12);
    EXPECT_EQ(none.reason.code, ReasonCode::singular_velocity) << none.reason;
    // Across, the arm moves as before.
    const Vector3 across(-along.y(), along.x(), 0.1);
    const JointRates some = joint_rates(rrr, q, across);
    EXPECT_EQ(some.status, RatesStatus::solved) << some.reason;
    EXPECT_TRUE(some.singular);
    EXPECT_LT(some.residual, 1e-12);
    EXPECT_TRUE(joint_rates(rrr, q, 0.3 * along, {.damping = 0.1}));
  }
  const JointRates wrist =
      joint_rates(built_in("puma560"), Configuration::Zero(6).eval(), Twist::Ones().eval());
  EXPECT_EQ(wrist.status, RatesStatus::singular);
}

TEST(JointRates, OfTooFewJointsAreNoSingularity) {
  const Arm scara = built_in("scara");
  const Configuration q = Eigen::Vector4d(0.3, 0.8, 0.1, 0.2);
  Twist velocity = Twist::Zero();
  velocity << 0.1, -0.2, 0.05, 0, 0, 0.3;
  EXPECT_EQ(joint_rates(scara, q, velocity).status, RatesStatus::solved);
  velocity[3] = 0.5;
  const JointRates tilted = joint_rates(scara, q, velocity);
  EXPECT_EQ(tilted.status, RatesStatus::too_few_joints);
  EXPECT_FALSE(tilted.singular);
  EXPECT_EQ(tilted.lost_directions.cols(), 2);
  EXPECT_EQ(testing::field<std::string>(tilted.reason, ReasonField::direction), "wx 1");
  EXPECT_EQ(testing::field<std::string>(tilted.reason, ReasonField::frame), "base");
}

TEST(JointRates, WithDampingAreThoseOfDampedLeastSquares) {
  testing::Random random;
  for (int i = 0; i < testing::cases(600); ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 8), 0);
    const Configuration q =
        i % 4 == 0 ? Configuration::Zero(arm.dof()).eval() : random.configuration(arm);
    Twist velocity;
    velocity << random.vector(), random.vector();
    const double damping = std::pow(10, random.uniform(-2, 1));
    const JointRates found =
        joint_rates(arm, q, velocity, {.task = Task::spatial(), .damping = damping});
    const Eigen::VectorXd expected =
        internal::damped_least_squares(jacobian(arm, q), velocity, damping * damping);
    ASSERT_EQ(found.status, RatesStatus::damped);
    ASSERT_LT((found.rates - expected).norm(), 1e-9 * (1 + expected.norm()));
    ASSERT_NEAR(found.residual, (jacobian(arm, q) * expected - velocity).norm(), 1e-9);
  }
}

TEST(JointRates, AboveTheLimitsAreNamedWithTheScaleThatKeepsThem) {
  testing::Random random;
  const Arm panda = built_in("panda");
  int excesses = 0;
  for (int i = 0; i < 200; ++i) {
    Twist velocity;
    velocity << random.vector(), random.vector();
    const Configuration q = random.configuration(panda);
    const JointRates found = joint_rates(panda, q, velocity);
    if (!found) continue;
    double scale = 1;
    std::size_t next = 0;
    for (int k = 0; k < panda.dof(); ++k) {
      const double limit = panda.limits(k).velocity;
      scale = std::min(scale, limit / std::max(std::abs(found.rates[k]), 1e-300));
      if (std::abs(found.rates[k]) <= limit) continue;
      ASSERT_LT(next, found.excesses.size());
      EXPECT_EQ(found.excesses[next].coordinate, k);
      EXPECT_EQ(found.excesses[next].rate, found.rates[k]);
      EXPECT_EQ(found.excesses[next++].limit, limit);
    }
    ASSERT_EQ(next, found.excesses.size());
    EXPECT_EQ(found.scale, scale);
    EXPECT_TRUE(joint_rates(panda, q, velocity * (scale * (1 - 1e-9))).excesses.empty());
    excesses += static_cast<int>(next);
  }
  EXPECT_GT(excesses, 10);
}

/// Rates are compared with the limits that are known; the coordinates of the others are named.
TEST(JointRates, WithoutAKnownLimitAreNamed) {
  testing::Random random;
  for (int i = 0; i < 200; ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 9), 3);
    std::vector<Joint> joints = arm.joints();
    std::vector<int> unknown;
    for (std::size_t k = 0; k < joints.size(); ++k) {
      const bool known = random.integer(0, 1) == 0;
      joints[k].limits.velocity = known ? 1e-3 : Limits::none;
    }
    const Arm some("some", joints, arm.tool(), arm.base());
    for (int k = 0; k < some.dof(); ++k) {
      if (std::isinf(some.limits(k).velocity)) unknown.push_back(k);
    }
    Twist velocity;
    velocity << random.vector(), random.vector();
    const JointRates found = joint_rates(some, random.configuration(some), velocity,
                                         {.task = Task::spatial(), .damping = 0.01});
    EXPECT_EQ(found.without_limit, unknown);
    for (const RateExcess& excess : found.excesses) {
      EXPECT_EQ(std::count(unknown.begin(), unknown.end(), excess.coordinate), 0);
    }
  }
  EXPECT_TRUE(joint_rates(built_in("panda"), Configuration::Ones(7).eval(), Twist::Ones().eval())
                  .without_limit.empty());
}

/// Without a frame the velocity is in the frame of its task.
TEST(JointRates, AreInTheFrameOfTheTask) {
  testing::Random random;
  const Arm panda = built_in("panda");
  for (int i = 0; i < 100; ++i) {
    const Configuration q = random.configuration(panda);
    const Vector3 velocity = random.vector();
    const JointRates own = joint_rates(panda, q, velocity, {.task = task_named("position:tool")});
    const JointRates stated = joint_rates(
        panda, q, velocity, {.task = task_named("position:tool"), .frame = Frame::tool});
    EXPECT_EQ(own.rates, stated.rates);
    const Rotation world_R_tool = forward_kinematics(panda, q).linear();
    const JointRates in_world =
        joint_rates(panda, q, (world_R_tool * velocity).eval(), {.task = Task::position()});
    EXPECT_TRUE(own.rates.isApprox(in_world.rates, 1e-9));
  }
}

TEST(JointRates, RefuseWhatDoesNotFit) {
  const Arm rrr = built_in("rrr"), panda = built_in("panda");
  const Configuration q = Vector3(0, 1, 0), seven = Configuration::Ones(7);
  EXPECT_REFUSED(joint_rates(rrr, q, Eigen::VectorXd::Ones(6)),
                 "the velocity has 6 numbers; it needs 3: x, y, theta");
  EXPECT_REFUSED(joint_rates(panda, seven, Eigen::VectorXd::Ones(3)),
                 "the velocity has 3 numbers; it needs 6: vx, vy, vz, wx, wy, wz");
  EXPECT_REFUSED(joint_rates(panda, q, Eigen::VectorXd::Ones(6)), "panda");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REFUSED(joint_rates(rrr, q, Vector3(0, nan, 0)), "finite");
  EXPECT_REFUSED(joint_rates(rrr, q, Vector3(0, 0, 0), {.damping = -1}), "damping is -1");
  EXPECT_REFUSED(joint_rates(panda, seven, Vector3(0, 0, 0),
                             {.task = task_named("position:tool"), .frame = Frame::base}),
                 "the frame must be tool, not base");
  EXPECT_TRUE(joint_rates(rrr, q, Vector3::Zero()));
}

}  // namespace
}  // namespace beeline
