#include <gtest/gtest.h>
#include <numbers>

#include <beeline/inverse/analytic/pieper_solver.h>
#include <beeline/model/catalog.h>

#include <tests/inverse/answer.h>
#include <tests/inverse/families.h>

// Arms of five joints and the tasks that leave one rotation free.

namespace beeline::internal {
namespace {

using testing::arm_through;
using testing::Axis;
using testing::Counts;
using testing::holds;
using testing::Random;

using std::numbers::pi;

constexpr const char* five_conditions[] = {"direction",   "direction:x", "direction:y",
                                           "approach:xy", "approach:xz", "approach:yz"};

/// A desk arm: yaw about the world's z, three parallel pitches normal to it, roll. Its tool may
/// stand beside the axis of the roll, with its z axis along it.
Arm desk_arm(Random& random, bool on_axis) {
  const double yaw = random.uniform(-pi, pi);
  const Rotation turned(Eigen::AngleAxisd(yaw, Vector3::UnitZ()));
  const auto point = [&](double x, double z) -> Vector3 {
    return turned * Vector3(x, random.uniform(-0.05, 0.05), z);
  };
  const Vector3 along = turned * Vector3::UnitX(), pitch = turned * Vector3::UnitY();
  std::vector<Axis> axes{{Vector3::UnitZ(), point(0, 0)}};
  axes.push_back({pitch, point(random.uniform(0, 0.1), 0.1)});
  axes.push_back({pitch, point(random.uniform(0, 0.2), 0.25)});
  axes.push_back({pitch, point(random.uniform(0.2, 0.3), 0.25)});
  axes.push_back({along, point(0.3, random.uniform(0.2, 0.3))});
  const Arm arm = arm_through(axes, random);
  const Vector3 beside = on_axis ? Vector3(Vector3::Zero()) : random.vector(0.02);
  Pose world_T_tool = Pose::Identity();
  world_T_tool.linear() << pitch.cross(along), pitch, along;
  world_T_tool.translation() = axes[4].point + random.uniform(0.05, 0.15) * along + beside;
  const Pose last = link_poses(arm, Configuration::Zero(5)).back();
  std::vector<Joint> joints = arm.joints();
  for (Joint& joint : joints) joint.limits = {.lower = -2.8, .upper = 2.8};
  return {"desk", joints, last.inverse(Eigen::Isometry) * world_T_tool, arm.base()};
}

/// The solutions within the arm's limits, of which `all` may have multiples of 2 pi.
bool has_within(const Arm& arm, const std::vector<Configuration>& all, const Configuration& q) {
  return holds(arm, all, q) && within(bounds_of(arm), q);
}

/// expect_every_solution() of a random configuration's pose, moved where the task leaves it free.
void expect_complete_for(const Arm& arm, const Task& task, Random& random, Counts* counts) {
  const Configuration from = random.configuration(arm);
  const Pose pose = testing::moved_where_free(forward_kinematics(arm, from), task, random);
  testing::expect_every_solution(arm, task, from, pose, random, counts);
}

TEST(FiveJoints, HaveAllSolutionsOfEachTaskThatLeavesARotationFree) {
  Random random;
  Counts counts;
  const int searched = testing::cases(15);
  for (int i = 0; i < testing::cases(150); ++i) {
    const Arm arm = desk_arm(random, false);
    for (const char* task : five_conditions) {
      expect_complete_for(arm, task_named(task), random, i < searched ? &counts : nullptr);
    }
  }
  EXPECT_GE(counts.equal, 0.95 * counts.poses - 2) << "of " << counts.poses;
}

TEST(FiveJoints, NeedNotBeADeskArm) {
  Random random;
  Counts counts;
  using Family = PieperLoop::Family;
  for (int i = 0; i < testing::cases(60); ++i) {
    const Family family = i % 2 == 0 ? Family::intersecting : Family::parallel;
    const auto axes = testing::axes_with(family, static_cast<std::size_t>(i % 3), "RRRRR", random);
    const Arm arm = arm_through(axes, random);
    for (const char* task : five_conditions) {
      expect_complete_for(arm, task_named(task), random, i < testing::cases(6) ? &counts : nullptr);
    }
  }
  EXPECT_GE(counts.equal, 0.95 * counts.poses - 2) << "of " << counts.poses;
}

TEST(FiveJoints, GiveEverySolutionWithinLimitsAndNoOther) {
  Random random;
  for (int i = 0; i < testing::cases(300); ++i) {
    const Arm arm = i % 3 == 0 ? built_in("px150") : desk_arm(random, false);
    const Task task = task_named(five_conditions[random.integer(i % 3 == 0 ? 2 : 0, 5)]);
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    const InverseResult limited = testing::closed_form_solutions(arm, pose, task, false);
    testing::expect_solved(arm, pose, task, limited);
    for (const Configuration& q : testing::closed_form_solutions(arm, pose, task).solutions) {
      const Configuration there =
          nearest_representative(arm, q, middle_configuration(arm), bounds_of(arm));
      if (!within(bounds_of(arm), there)) continue;
      EXPECT_TRUE(has_within(arm, limited.solutions, there)) << name(task) << there.transpose();
    }
  }
}

TEST(FiveJoints, WhoseLastTurnsTheToolAboutItsAxisKeepTheSeedsRoll) {
  Random random;
  const int poses = testing::cases(300);
  int complete = 0;  // at the boundary of the workspace a search adds solutions with other rolls
  for (int i = 0; i < poses; ++i) {
    const bool built = i % 2 == 0;
    const Arm arm = built ? built_in("px150") : desk_arm(random, true);
    const Task task = task_named(built ? "direction:x" : "direction");
    const Configuration from = random.configuration(arm), seed = random.configuration(arm);
    const Pose pose = testing::moved_where_free(forward_kinematics(arm, from), task, random);
    InverseOptions options{.seed = seed, .task = task, .all = true};
    const InverseResult all = inverse_kinematics(arm, pose, options);
    testing::expect_solved(arm, pose, task, all);
    EXPECT_TRUE(all.singular);
    EXPECT_FALSE(all.complete);
    EXPECT_EQ(all.self_motion_dimension, 1);
    Configuration rolled = from;
    rolled[4] = seed[4];
    EXPECT_TRUE(holds(arm, all.solutions, rolled)) << rolled.transpose();
    options.all = false;
    const InverseResult one = inverse_kinematics(arm, pose, options);
    testing::expect_solved(arm, pose, task, one);
    EXPECT_LT((one.solutions.front() - all.solutions.front()).norm(), 1e-9);
    options.all = true;
    options.lock = 4;
    const InverseResult locked = inverse_kinematics(arm, pose, options);
    EXPECT_TRUE(holds(arm, locked.solutions, rolled)) << rolled.transpose();
    if (!all.branches_complete) continue;
    ++complete;
    for (const Configuration& q : all.solutions) EXPECT_EQ(q[4], seed[4]);
    EXPECT_EQ(locked.solutions.size(), all.solutions.size());
  }
  EXPECT_GE(complete, 0.9 * poses - 2);
}

TEST(FiveJoints, PointDownAtEveryPositionThatTheWristAllows) {
  Random random;
  const Arm arm = built_in("px150");
  for (int i = 0; i < testing::cases(300); ++i) {
    Configuration from = random.configuration(arm);
    from[3] = pi / 2 - from[1] - from[2];  // the tool's x axis is the world's -z
    if (!within(bounds_of(arm), from)) continue;
    const Pose down = forward_kinematics(arm, from);
    for (const char* task : {"spatial", "direction:x", "direction", "approach:xy"}) {
      const Pose pose = testing::moved_where_free(down, task_named(task), random);
      const Configuration seed = random.configuration(arm);
      const InverseResult result =
          inverse_kinematics(arm, pose, {.seed = seed, .task = task_named(task)});
      testing::expect_solved(arm, pose, task_named(task), result);
      if (task_named(task) == task_named("direction:x")) {
        EXPECT_NEAR(result.solutions.front()[4], seed[4], 1e-9);
      }
    }
  }
}

TEST(FiveJoints, SayThatAPoseHasMoreConditions) {
  Random random;
  const Arm arm = built_in("px150");
  const int poses = testing::cases(30);
  int missed = 0;  // a few rotations are nearly the roll
  for (int i = 0; i < poses; ++i) {
    Pose pose = forward_kinematics(arm, random.configuration(arm));
    pose.rotate(Eigen::AngleAxisd(random.uniform(0.1, 1), random.direction()));
    const InverseResult result = testing::explained_inverse(arm, pose);
    if (result.residual < 1e-2) continue;
    ++missed;
    testing::expect_no(result, InverseStatus::orientation_unreachable);
    ASSERT_NE(result.reason.find(ReasonField::conditions), nullptr) << result.reason;
    EXPECT_EQ(std::get<std::size_t>(*result.reason.find(ReasonField::joints)), 5U);
    ASSERT_TRUE(result.nearest);
    EXPECT_LE(result.nearest->error.position, 1e-9);
    EXPECT_GT(result.nearest->error.orientation, 1e-3);
  }
  EXPECT_GE(missed, 0.8 * poses - 1);
  const Arm ur5 = built_in("ur5");  // has five joints that a lock leaves
  const InverseResult locked =
      testing::explained_inverse(ur5, forward_kinematics(ur5, random.configuration(ur5)),
                                 {.seed = Configuration::Zero(6), .lock = 5});
  EXPECT_EQ(locked.reason.find(ReasonField::conditions), nullptr) << locked.reason;
  const Pose away(Eigen::Translation3d(0.3, 0.1, 0.2) * Eigen::AngleAxisd(1, Vector3::UnitZ()));
  const InverseResult sideways =
      testing::explained_inverse(arm, away, {.task = task_named("direction:x")});
  testing::expect_no(sideways, InverseStatus::orientation_unreachable);
  EXPECT_EQ(sideways.reason.find(ReasonField::conditions), nullptr);
}

}  // namespace
}  // namespace beeline::internal
