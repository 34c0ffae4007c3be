#include <beeline/certificate/verify.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/branch.h>
#include <beeline/planning/move_along.h>

#include <tests/planning/dense_search.h>
#include <tests/planning/motion_promises.h>
#include <tests/random_arm.h>
#include <tests/reason.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using namespace testing;

// These lines are feasible only with a joint that moves along its limit, or next to it.
TEST(PlanPath, MovesAlongLimits) {
  const Arm arm = built_in("panda");
  Random random(20);
  for (int i = 0; i < 500; ++i) {
    const Line line = random_certified_line(random, arm);
    if (i != 29 && i != 224 && i != 426 && i != 439 && i != 495) continue;
    const std::vector<Pose> poses{line.from, line.to};
    const PathMotion motion = move_in_lines(arm, poses, {.profile = Profile::quintic});
    ASSERT_EQ(motion.status, MotionStatus::reached) << i << ": " << motion.reason;
    EXPECT_FALSE(verify(arm, motion.trajectory, poses).reason);
  }
}

// Along the path the redundant joint is close to its limits: of 256 values of it few are feasible.
TEST(PlanPath, FindsANarrowPassage) {
  const Arm arm = built_in("iiwa14");
  Random random(20240229);
  Line line;
  for (int i = 0; i <= 562; ++i) line = random_certified_line(random, arm);
  const ToolPath path = lines_through(std::vector{line.from, line.to});
  const BranchOptions options{.task = Task::spatial()};
  EXPECT_EQ(plan_path(arm, {}, path, options).status, MotionStatus::reached);
}

TEST(PlanPath, AlwaysSaysWhyAndWhere) {
  const Arm arm = built_in("panda");
  Random random;
  for (int i = 0; i < cases(40); ++i) {
    const Line line = random_certified_line(random, arm);
    const Branch plan = plan_path(arm, {}, lines_through(std::vector{line.from, line.to}),
                                  {.task = Task::spatial()});
    if (plan.status == MotionStatus::reached) {
      EXPECT_FALSE(plan.reason);
      EXPECT_EQ(plan.path_parameter, 1);
      continue;
    }
    EXPECT_EQ(testing::field<std::size_t>(plan.reason, ReasonField::segment), 1U) << plan.reason;
    EXPECT_LT(plan.path_parameter, 1);
  }
}

TEST(PlanPath, TellsABeginningThatCannotBe) {
  for (const char* name : {"puma560", "ur5", "panda", "rrr", "scara", "gantry"}) {
    const Arm arm = built_in(name);
    Pose far = forward_kinematics(arm, Configuration::Zero(arm.dof()));
    Pose near = far;
    far.translation().x() += 50;
    const PathMotion motion = move_in_lines(arm, std::vector<Pose>{far, near});
    if (motion.status == MotionStatus::reached) continue;  // a prismatic joint without limits
    expect_nothing_made(motion, MotionStatus::unreachable);
    EXPECT_TRUE(motion.reason.has(ReasonField::beginning)) << motion.reason;
  }
}

// The elbow at the stretched configuration, before it and beyond it.
TEST(PlanPath, ComesToTheElbowsLimitAndNotBeyond) {
  const Arm arm = built_in("panda");
  constexpr double stretched = -0.46671;  // of joint 4: both parts of the arm in one line
  for (const double off : {0.0, 1e-6, 1e-3, 0.1}) {
    Configuration q(7);
    q << 0.1, 0.6, 0.1, stretched - off, 0.1, 1.4, 0.785;
    const Pose far = forward_kinematics(arm, q);
    const Vector3 out = (far.translation() - Vector3(0, 0, 0.333)).normalized();
    Pose near = far, beyond = far;
    near.translation() -= 0.3 * out;
    beyond.translation() += 0.3 * out;
    for (const auto& poses : {std::vector<Pose>{near, far}, {far, near}}) {
      const PathMotion motion = move_in_lines(arm, poses, {.profile = Profile::quintic});
      ASSERT_EQ(motion.status, MotionStatus::reached) << off << ' ' << motion.reason;
      EXPECT_FALSE(verify(arm, motion.trajectory, poses).reason);
      EXPECT_LT(motion.trajectory.times.back(), 20);
    }
    const PathMotion refused = move_in_lines(arm, std::vector<Pose>{near, beyond});
    expect_nothing_made(refused, MotionStatus::unreachable);
  }
}

// Rows that the task ignores: the finished motion is proved on the line that was planned.
TEST(PlanPath, LeavesRowsFree) {
  Random random;
  int reached = 0;
  for (const char* task : {"111000", "111110:tool", "000111", "001000", "111000:tool"}) {
    for (const char* name : {"ur5", "panda"}) {
      const Arm arm = built_in(name);
      const Pose from = forward_kinematics(arm, inner_configuration(random, arm));
      Pose to = from;
      to.translation() += 0.05 * random.direction();
      to.linear() = so3_exp(0.05 * random.direction()) * from.linear();
      const PathMotionOptions options{.task = task_named(task), .profile = Profile::quintic};
      const std::vector<Pose> poses{from, to};
      const PathMotion motion = move_in_lines(arm, poses, options);
      ASSERT_NE(motion.status, MotionStatus::not_proved) << name << task << motion.reason;
      ASSERT_NE(motion.status, MotionStatus::too_many_samples) << name << task << motion.reason;
      if (motion.status != MotionStatus::reached) continue;
      ++reached;
      EXPECT_LT(motion.trajectory.size(), 5'000) << name << task;
      EXPECT_FALSE(verify(arm, motion.trajectory, poses, {.task = options.task}).reason);
    }
  }
  EXPECT_GE(reached, 5);
}

// Every arm of 1 to 10 joints of any kind, with mimic joints, gets an answer with a reason.
TEST(PlanPath, AnswersForAnyArm) {
  Random random;
  for (int i = 0; i < cases(60); ++i) {
    const Arm arm = random_arm(random, 1 + i % 10, i % 3 == 0 ? 3 : 0);
    const Configuration a = random.configuration(arm), b = random.configuration(arm);
    const Pose from = forward_kinematics(arm, a);
    const Pose to =
        i % 2 == 0 ? forward_kinematics(arm, a + 0.02 * (b - a)) : nearby_pose(random, arm, from);
    const PathMotion motion = i % 4 < 2 ? move_in_lines(arm, a, std::vector<Pose>{to})
                                        : move_in_lines(arm, std::vector<Pose>{from, to});
    EXPECT_EQ(!motion.reason, motion.status == MotionStatus::reached);
    EXPECT_EQ(motion.trajectory.size() > 0, motion.status == MotionStatus::reached);
  }
}

TEST(PlanPath, RefusesPathsThatAreNone) {
  for (const char* name : {"panda", "ur5"}) {
    const Arm arm = built_in(name);
    const Configuration q = middle_configuration(arm);
    Pose moved = forward_kinematics(arm, q);
    moved.translation().z() += 0.01;
    const ToolPath path = lines_through(std::vector{forward_kinematics(arm, q), moved});
    const BranchOptions options{.task = Task::spatial()};
    EXPECT_REFUSED(plan_path(arm, q, {}, options), "a path needs segments");
    EXPECT_REFUSED(plan_path(arm, {}, {}, options), "a path needs segments");
    EXPECT_REFUSED(branch_map(arm, {}, options), "a path needs segments");
    EXPECT_REFUSED(nearby_path(arm, q, {}, options, false), "a path needs segments");
    EXPECT_REFUSED(plan_path(arm, q, {path.segments, {}}, options), "0 spans");
    BranchOptions exact = options;
    exact.tolerance = {0, 1};
    EXPECT_REFUSED(plan_path(arm, q, path, exact), "above zero");
  }
}

}  // namespace
}  // namespace beeline
