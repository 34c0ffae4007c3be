#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/model/catalog.h>
#include <beeline/trajectory/limit_usage.h>

#include <tests/inverse/answer.h>
#include <tests/typical_arms.h>

// Poses of configurations at and next to singularities and limits: the pose has a solution within
// limits by construction, so an answer without one is a fault.

namespace beeline {
namespace {

using std::numbers::pi;
using testing::Random;

/// Returns 0, or 1e-15 to 1e-5 with random sign.
double small_deviation(Random& random) {
  const int power = random.integer(-16, -5);
  return power == -16 ? 0 : std::pow(10.0, power) * (random.integer(0, 1) ? 1 : -1);
}

/// Returns a configuration within limits in which each value is, with this probability, next to a
/// multiple of a right angle; if `at_limits`, half of the others are at a limit.
Configuration special(const Arm& arm, double probability, bool at_limits, Random& random) {
  Configuration q = random.configuration(arm);
  for (int k = 0; k < arm.dof(); ++k) {
    const Limits& limits = arm.limits(k);
    if (random.uniform(0, 1) < probability) {
      const bool slides = kind(arm.joint_of(k)) == JointKind::prismatic;
      const double value = slides ? 0 : pi / 2 * random.integer(-2, 2);
      if (value < limits.lower || value > limits.upper) continue;
      q[k] = std::clamp(value + small_deviation(random), limits.lower, limits.upper);
    } else if (at_limits && random.integer(0, 1) && std::isfinite(limits.lower)) {
      q[k] = random.integer(0, 1) ? limits.lower : limits.upper;
    }
  }
  return q;
}

void expect_answer(const Arm& arm, const Configuration& q, int& unanswered) {
  const Pose pose = forward_kinematics(arm, q);
  const Configuration seed = middle_configuration(arm);
  const InverseResult result = inverse_kinematics(arm, pose, {.seed = seed});
  Eigen::MatrixXd column(arm.dof(), 1);
  const int count = inverse_kinematics(arm, pose, seed, column);
  ASSERT_EQ(count == 1, static_cast<bool>(result)) << arm.name() << ' ' << q.transpose();
  if (!result) {
    ++unanswered;
    EXPECT_NE(result.status, InverseStatus::unreachable) << result.reason;
    EXPECT_NE(result.status, InverseStatus::orientation_unreachable) << result.reason;
    EXPECT_NE(result.reason.code, ReasonCode::all_solutions_outside_limits) << q.transpose();
    return;
  }
  EXPECT_EQ(column.col(0), result.solutions[0]) << arm.name();
  EXPECT_TRUE(within(internal::bounds_of(arm), result.solutions[0])) << arm.name();
  const Deviation error =
      task_deviation(default_task(arm), pose, forward_kinematics(arm, result.solutions[0]));
  EXPECT_LE(testing::largest(error), 1e-10) << arm.name();
}

TEST(SingularPoses, AreAnswered) {
  Random random;
  int unanswered = 0, asked = 0;
  for (const std::string& name : testing::typical_arms) {
    const Arm arm = built_in(name);
    for (int i = 0; i < testing::cases(400); ++i, ++asked) {
      const double probability = random.uniform(0, 1);
      expect_answer(arm, special(arm, probability, i % 2 == 1, random), unanswered);
    }
  }
  EXPECT_LE(unanswered, 1 + asked / 10000);
}

// Seven joints with the upper arm stretched: next to this singularity the error has valleys, in
// which searches stagnate.
TEST(SingularPoses, AreAnsweredWithAStretchedArm) {
  Random random;
  int unanswered = 0, asked = 0;
  for (const char* name : {"gen3", "iiwa14", "iiwa7"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < testing::cases(testing::example_size(300)); ++i, ++asked) {
      Configuration q = random.configuration(arm);
      q.segment<3>(2).setZero();
      expect_answer(arm, q, unanswered);
    }
  }
  EXPECT_LE(unanswered, 1 + asked / 1000);
}

/// Locks the elbow of an arm whose shoulder and wrist are spherical: the other six joints move with
/// the tool at rest from every configuration.
TEST(SingularPoses, AreAnsweredWithALockedElbow) {
  Random random;
  const Arm arm = built_in("iiwa14");
  for (int i = 0; i < testing::cases(300); ++i) {
    const Configuration q = special(arm, 0.3, i % 2 == 1, random);
    Configuration seed = middle_configuration(arm);
    seed[3] = q[3];
    const Pose pose = forward_kinematics(arm, q);
    const InverseResult result = inverse_kinematics(arm, pose, {.seed = seed, .lock = 3});
    testing::expect_solved(arm, pose, Task::spatial(), result);
    ASSERT_TRUE(result);
    EXPECT_EQ(result.solutions[0][3], q[3]);
  }
}

/// `nearest` and `centred` are optima, so `any` is no better.
TEST(SingularPoses, TheBestRedundantSolutionIsNoWorseThanAny) {
  Random random;
  for (const char* name : {"panda", "iiwa14"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < testing::cases(60); ++i) {
      const Pose pose = forward_kinematics(arm, special(arm, 0.3, i % 2 == 1, random));
      const Configuration seed = random.configuration(arm);
      const auto solved = [&](Redundancy redundancy) {
        return inverse_kinematics(arm, pose, {.seed = seed, .redundancy = redundancy});
      };
      const InverseResult any = solved(Redundancy::any);
      const InverseResult nearest = solved(Redundancy::nearest);
      const InverseResult centred = solved(Redundancy::centred);
      if (!any) continue;
      ASSERT_TRUE(nearest && centred) << name << nearest.reason << centred.reason;
      const auto margin = [&arm](const Configuration& q) {
        double least = 1;
        for (int k = 0; k < arm.dof(); ++k) {
          const Limits& limits = arm.limits(k);
          least = std::min({least, (q[k] - limits.lower) / (limits.upper - limits.lower),
                            (limits.upper - q[k]) / (limits.upper - limits.lower)});
        }
        return least;
      };
      EXPECT_LE((nearest.solutions[0] - seed).norm(), (any.solutions[0] - seed).norm() + 1e-9);
      EXPECT_GE(margin(centred.solutions[0]), margin(any.solutions[0]) - 1e-9);
    }
  }
}

// The tool's axis, beside the last joint's, is parallel to the first joint's: any value of either
// joint closes the directions, but few close the positions.
TEST(SingularPoses, WithAToolThatPointsDownOfFiveJoints) {
  Random random;
  const Arm arm = built_in("so101");
  const Task task = task_named("111110:tool");
  for (int i = 0; i < testing::cases(500); ++i) {
    Configuration q = random.configuration(arm);
    q[3] = pi / 2 - q[1] - q[2];
    if (!within(internal::bounds_of(arm), q)) continue;
    Pose pose = forward_kinematics(arm, q);
    pose.rotate(Eigen::AngleAxisd(random.uniform(-pi, pi), Vector3::UnitZ()));
    const InverseOptions options{.task = task, .all = i % 5 == 0};
    testing::expect_solved(arm, pose, task, inverse_kinematics(arm, pose, options));
  }
}

/// A 6R arm with an offset at the shoulder whose upper arm and forearm are equal: folded, its wrist
/// is on the axis of the elbow.
Arm folding_arm() {
  const double right = pi / 2;
  const std::vector<DhRow> rows{{.a = 0.05, .alpha = -right, .d = 0.478},
                                {.a = 0.425, .theta = -right},
                                {.alpha = right, .d = 0.05, .theta = right},
                                {.alpha = -right, .d = 0.425},
                                {.alpha = right},
                                {.d = 0.1}};
  return arm_from_dh("folding", rows, DhConvention::standard);
}

// The solution next to the seed is lost to rounding in the closed form, the others are not.
TEST(SingularPoses, ASeedNextToASolutionLeadsToIt) {
  Random random;
  std::vector<std::pair<Arm, int>> arms{{folding_arm(), 2}};
  for (const char* name : {"ur5", "ur10e", "nova5", "tm5_900", "puma560", "irb120", "m1013"}) {
    arms.emplace_back(built_in(name), 4);
  }
  int far = 0, count = 0;
  for (const auto& [arm, joint] : arms) {
    for (int i = 0; i < testing::cases(400); ++i) {
      Configuration q = 0.6 * random.configuration(arm);
      const double straight = joint == 2 ? pi : 0;
      q[joint] = straight + (random.integer(0, 1) ? 1 : -1) * std::pow(10, random.uniform(-10, -2));
      if (!within(internal::bounds_of(arm), q)) continue;
      Configuration seed =
          q + 1e-3 * Configuration::NullaryExpr(6, [&] { return random.uniform(-1, 1); });
      if (i % 4 == 0) seed = q;
      seed = nearest_within_limits(arm, seed);
      const Pose pose = forward_kinematics(arm, q);
      const InverseResult result = inverse_kinematics(arm, pose, {.seed = seed});
      Eigen::MatrixXd column(6, 1);
      ASSERT_TRUE(result) << arm.name() << ' ' << q.transpose();
      ASSERT_EQ(inverse_kinematics(arm, pose, seed, column), 1);
      // Next to the singularity the pose determines the joints to the root of rounding.
      const double near = 5 * (q - seed).norm() + 1e-6;
      ++count;
      far += (result.solutions[0] - seed).norm() > near || (column.col(0) - seed).norm() > near;
    }
  }
  EXPECT_LE(far, 1 + count / 100) << "of " << count;
}

}  // namespace
}  // namespace beeline
