#include <array>
#include <gtest/gtest.h>
#include <sstream>

#include <beeline/batch/batch.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/internal/solve.h>
#include <beeline/inverse/internal/tool_volume.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/so3.h>

#include <tests/inverse/families.h>
#include <tests/random.h>

// A status without the nearest configuration, and the search for it.

namespace beeline {
namespace {

using internal::FailureDetail;

/// The arm with the wrist of another: axes 5 and 7 do not meet, and so no three axes of it do.
Arm with_offset_wrist(const Arm& arm) {
  std::vector<Joint> joints = arm.joints();
  joints[2].offset = joints[2].offset * make_pose({0.02, 0, 0});
  joints[4].offset = joints[4].offset * make_pose({0.03, 0.01, 0});
  joints[6].offset = joints[6].offset * make_pose({0.08, 0, 0});
  return {"offset_wrist", joints, arm.tool(), arm.base()};
}

/// A pose in the ball around the arm, or a little outside; one in four has a solution.
Pose random_pose(const Arm& arm, testing::Random& random) {
  if (random.integer(0, 3) == 0) return forward_kinematics(arm, random.configuration(arm));
  const Arm::Reach& reach = arm.reach();
  Pose pose = random.pose();
  pose.translation() =
      reach.centre + 1.1 * reach.radius * std::cbrt(random.uniform(0, 1)) * random.direction();
  return pose;
}

/// The result of all searches at once.
InverseResult diagnosed(const Arm& arm, const Pose& pose, const InverseOptions& options) {
  internal::SolverState state(arm, options);
  internal::BudgetMeter budget(options.budget);
  return internal::solve(state, pose, options.seed.value_or(middle_configuration(arm)),
                         FailureDetail::nearest, budget);
}

const char* const with_closed_form[] = {"panda", "iiwa7", "gen3", "xarm7", "rm75", "fr3"};

TEST(Explain, GivesWhatAllSearchesGive) {
  testing::Random random;
  int unexplained = 0;
  for (const char* name : {"panda", "iiwa7", "gen3", "ur5", "puma560", "stanford"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < testing::cases(60); ++i) {
      InverseOptions options{.seed = random.configuration(arm)};
      options.ignore_limits = i % 5 == 1;
      if (i % 5 == 2) options.lock = arm.dof() - 1;
      const Pose pose = random_pose(arm, random);
      InverseResult result = inverse_kinematics(arm, pose, options);
      unexplained += result.unexplained.has_value();
      EXPECT_EQ(result.unexplained.has_value(), result.solutions.empty() && !result.nearest);
      const InverseStatus status = result.status;
      explain(result);
      EXPECT_EQ(result.status, status);
      EXPECT_FALSE(result.unexplained);
      if (result) continue;
      const InverseResult whole = diagnosed(arm, pose, options);
      ASSERT_TRUE(result.nearest);
      EXPECT_EQ(result.nearest->q, whole.nearest->q) << name;
      EXPECT_EQ(result.nearest->world_T_tool.matrix(), whole.nearest->world_T_tool.matrix());
      EXPECT_EQ(result.residual, whole.residual);
      EXPECT_EQ(result.method, whole.method);
      // The closed form examines poses that the searches do not decide.
      if (whole.status == InverseStatus::not_found) continue;
      EXPECT_EQ(result.status, whole.status) << name << ' ' << whole.reason;
      EXPECT_EQ(result.reason, whole.reason);
    }
  }
  EXPECT_GT(unexplained, testing::cases(60));
}

TEST(Explain, KeepsWhatTheStatusSays) {
  testing::Random random;
  const Arm arm = built_in("panda");
  for (int i = 0; i < testing::cases(90); ++i) {
    const Pose pose = random_pose(arm, random);
    InverseResult result = inverse_kinematics(arm, pose);
    if (!result.unexplained) continue;
    EXPECT_TRUE(std::isnan(result.residual));
    const ReasonCode code = result.reason.code;
    EXPECT_FALSE(std::string(sentence(result.reason)).empty());
    std::ostringstream printed, explained;
    printed << result;
    // A copy is a request of its own.
    InverseResult copy = result;
    explain(copy);
    EXPECT_TRUE(result.unexplained);
    explain(result);
    EXPECT_EQ(copy.nearest->q, result.nearest->q);
    EXPECT_EQ(copy.residual, result.residual);
    EXPECT_EQ(copy.reason, result.reason);
    EXPECT_EQ(result.reason.code, code);
    explained << result;
    EXPECT_EQ(printed.str(), explained.str());
    // Once explained, nothing changes.
    InverseResult again = result;
    explain(again);
    EXPECT_EQ(again.residual, result.residual);
  }
}

TEST(Explain, EndsWithItsBudget) {
  testing::Random random;
  for (const char* name : with_closed_form) {
    const Arm arm = built_in(name);
    for (int i = 0; i < testing::cases(30); ++i) {
      InverseResult result = inverse_kinematics(arm, random_pose(arm, random));
      if (!result.unexplained) continue;
      const InverseStatus status = result.status;
      explain(result, {.max_work = random.integer(0, 200)});
      EXPECT_EQ(result.status, status);
      ASSERT_TRUE(result.nearest);
      EXPECT_TRUE(result.nearest->q.allFinite());
      EXPECT_TRUE(std::isfinite(result.residual));
    }
  }
}

TEST(QuickStatus, IsThatOfTheBatch) {
  testing::Random random;
  std::vector<Arm> arms{with_offset_wrist(built_in("iiwa7"))};
  for (const char* name : with_closed_form) arms.push_back(built_in(name));
  for (const Arm& arm : arms) {
    const int count = testing::cases(arm.name() == "offset_wrist" ? 12 : 60);
    Eigen::MatrixXd poses(16, count), q(arm.dof(), count), alone(arm.dof(), count);
    for (int i = 0; i < count; ++i) poses.col(i) = random_pose(arm, random).matrix().reshaped();
    const Configuration seed = middle_configuration(arm);
    std::vector<InverseOutcome> outcomes;
    batch_inverse(arm, poses, seed, q, outcomes, {}, {.threads = 2});
    batch_inverse(arm, poses, seed, alone, {}, {.threads = 1});
    for (int i = 0; i < count; ++i) {
      Pose pose;
      pose.matrix() = poses.col(i).reshaped(4, 4);
      InverseResult single = inverse_kinematics(arm, pose, {.seed = seed});
      const auto outcome = outcomes[static_cast<std::size_t>(i)];
      EXPECT_EQ(single.status, outcome.status) << arm.name() << ' ' << single.reason;
      explain(single);
      EXPECT_EQ(single.residual, outcome.residual) << arm.name();
      EXPECT_EQ(static_cast<bool>(single), alone.col(i).allFinite()) << arm.name();
      if (single) {
        EXPECT_EQ(single.solutions.front(), q.col(i));
      }
    }
  }
}

TEST(QuickStatus, IsNoWrongNo) {
  testing::Random random;
  for (const char* name : with_closed_form) {
    const Arm arm = built_in(name);
    int outside = 0;
    for (int i = 0; i < testing::cases(600); ++i) {
      const Pose within = forward_kinematics(arm, random.configuration(arm));
      EXPECT_EQ(inverse_kinematics(arm, within).status, InverseStatus::solved) << name;
      Configuration q(arm.dof());
      for (double& value : q) value = random.uniform(-3.2, 3.2);
      const InverseResult result = inverse_kinematics(arm, forward_kinematics(arm, q));
      outside += result.status == InverseStatus::outside_limits;
      EXPECT_TRUE(result || result.status == InverseStatus::outside_limits)
          << name << ' ' << result.reason << ' ' << q.transpose();
    }
    EXPECT_GT(outside, 0) << name;
  }
}

/// The rest of a revolution of a locked joint may be a rounding error longer than a revolution.
TEST(QuickStatus, OfAJointThatIsLockedByItsLimits) {
  testing::Random random;
  for (const double value : {1.72, 1.721, 0.3, -2.19}) {
    const Arm arm = with_limits(built_in("panda"), {{"joint7", {.lower = value, .upper = value}}});
    for (int i = 0; i < testing::cases(30); ++i) {
      const Pose pose = random_pose(arm, random);
      const InverseResult result = inverse_kinematics(arm, pose);
      EXPECT_EQ(result.status, diagnosed(arm, pose, {}).status) << "joint7 at " << value;
    }
  }
}

/// A solution that a later search found would not be asked about.
TEST(Explain, IsDoneAtOnceWhereSolutionsMayBeBlocked) {
  testing::Random random;
  const Arm arm = built_in("panda");
  InverseOptions options;
  options.blocked_by = [](const ConfigurationRef&) { return Reason{ReasonCode::bodies_collide}; };
  for (int i = 0; i < 20; ++i) {
    const InverseResult result = inverse_kinematics(arm, random_pose(arm, random), options);
    EXPECT_FALSE(result.unexplained);
    EXPECT_NE(result.status, InverseStatus::solved);
  }
}

TEST(BallOfTool, ContainsTheToolAndTouchesItsReach) {
  testing::Random random;
  for (const BuiltInArm& about : built_in_arms()) {
    const Arm arm = built_in(about.name);
    const Arm::Reach ball = internal::ball_of_tool(arm);
    if (!std::isfinite(ball.radius)) continue;
    const auto distance = [&](const Configuration& q) {
      return (forward_kinematics(arm, q).translation() - ball.centre).norm();
    };
    double farthest = 0;
    for (int start = 0; start < 8; ++start) {
      Configuration q(arm.dof());
      for (double& value : q) value = random.uniform(-3.2, 3.2);
      for (double step = 1; step > 1e-4; step /= 2) {  // ascends along each coordinate
        for (int k = 0; k < arm.dof(); ++k) {
          for (const double moved : {q[k] - step, q[k] + step}) {
            Configuration next = q;
            next[k] = moved;
            if (distance(next) > distance(q)) q = next;
          }
        }
      }
      farthest = std::max(farthest, distance(q));
    }
    EXPECT_LE(farthest, ball.radius) << about.name;
    EXPECT_GE(farthest, 0.98 * ball.radius) << about.name;
    EXPECT_LE(ball.radius, arm.reach().radius * (1 + 1e-9)) << about.name;
  }
}

/// Returns a pose with a solution and one without, of the same position and closer than `apart`
/// radians.
std::array<Pose, 2> edge_of_orientations(const Arm& arm, testing::Random& random, double apart) {
  const InverseOptions options{.ignore_limits = true};
  Pose from, to;
  do {
    from = to = forward_kinematics(arm, random.configuration(arm));
    to.linear() = random.pose().linear();
  } while (inverse_kinematics(arm, to, options).status != InverseStatus::orientation_unreachable);
  while (so3_log(from.linear().transpose() * to.linear()).norm() > apart) {
    Pose middle = from;
    const Vector3 way = so3_log(from.linear().transpose() * to.linear());
    middle.linear() = from.linear() * so3_exp(way / 2);
    (inverse_kinematics(arm, middle, options) ? from : to) = middle;
  }
  return {from, to};
}

// The searches alone give the status orientation_unreachable if all end far away, in any unit.
TEST(Explain, NoStatusByTheSearchesNearASolution) {
  testing::Random random;
  const Arm metres = with_offset_wrist(built_in("iiwa7"));
  for (const double factor : {1.0, 1e3, 1e-3}) {
    const Arm arm = testing::scaled(metres, factor);
    for (int i = 0; i < testing::cases(3); ++i) {
      const Pose missed = edge_of_orientations(arm, random, 5e-4)[1];
      const InverseResult result = inverse_kinematics(arm, missed, {.ignore_limits = true});
      EXPECT_NE(result.status, InverseStatus::orientation_unreachable) << result.reason;
      EXPECT_NE(result.status, InverseStatus::unreachable) << result.reason;
    }
    int quick = 0, none = 0;
    for (int i = 0; i < testing::cases(30); ++i) {
      const InverseResult result =
          inverse_kinematics(arm, random_pose(arm, random), {.ignore_limits = true});
      if (result.status != InverseStatus::orientation_unreachable) continue;
      ++none;
      quick += result.unexplained ? 1 : 0;
    }
    const int few = testing::slow_build ? 2 : 0;  // of few cases, one or two may be slow
    EXPECT_GE(2 * quick + few, none);
  }
}

// Searches of few steps end anywhere.
TEST(Explain, NoStatusBySearchesOfFewSteps) {
  testing::Random random;
  const Arm arm = with_offset_wrist(built_in("iiwa7"));
  for (int i = 0; i < testing::cases(30); ++i) {
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    for (const int iterations : {0, 1, 2}) {
      const InverseResult result =
          inverse_kinematics(arm, pose, {.ignore_limits = true, .max_iterations = iterations});
      EXPECT_NE(result.status, InverseStatus::orientation_unreachable) << iterations;
      EXPECT_NE(result.status, InverseStatus::unreachable) << iterations;
    }
  }
}

}  // namespace
}  // namespace beeline
