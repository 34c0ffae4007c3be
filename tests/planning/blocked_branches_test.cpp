#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <utility>

#include <beeline/certificate/clearance.h>
#include <beeline/io/text/arm.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>
#include <beeline/planning/program.h>

#include <tests/ended_budget.h>
#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::Random;

/// An arm with spheres on its links and one sphere in the world.
CollisionModel model_with_ball(const Arm& arm, const Vector3& position, double radius) {
  std::vector<LinkShapes> links;
  for (std::size_t i = 1; i <= arm.joints().size(); ++i) {
    links.push_back(
        {.name = "link" + std::to_string(i), .link = i, .shapes = {{.body = Sphere{0.02}}}});
  }
  Pose pose = Pose::Identity();
  pose.translation() = position;
  const Scene scene{
      .obstacles = {{.name = "ball", .shapes = {{.body = Sphere{radius}, .pose = pose}}}}};
  return {arm, links, scene, {.self_collision = false}};
}

std::vector<Pose> random_line(Random& random, const Arm& arm) {
  const Configuration q = random.configuration(arm);
  return {forward_kinematics(arm, q),
          forward_kinematics(arm, q + Configuration::Constant(arm.dof(), 0.15))};
}

/// The middle of a link's frames half-way along a motion.
Vector3 elbow_of(const Arm& arm, const Trajectory& motion) {
  return link_poses(arm, motion.positions[motion.size() / 2])[3].translation();
}

/// A random line from a start that is not blocked, and a ball where the elbow of the best motion is
/// half-way.
struct LineBesideBall {
  std::vector<Pose> waypoints;  // without the first pose
  Configuration start;
  CollisionModel model;
};

/// Nothing if the line cannot be followed without the ball, or the ball is at the start too.
std::optional<LineBesideBall> line_beside_ball(Random& random, const Arm& arm,
                                               const PathMotionOptions& options = {}) {
  const std::vector<Pose> line = random_line(random, arm);
  const PathMotion free = move_in_lines(arm, line, options);
  if (!free) return {};
  const Configuration& start = free.trajectory.positions.front();
  CollisionModel model = model_with_ball(arm, elbow_of(arm, free.trajectory), 0.01);
  if (blocked_by(model, start)) return {};
  return LineBesideBall{{line.begin() + 1, line.end()}, start, std::move(model)};
}

// The ball is at the elbow of the best branch, which is then refused; the given one is clear by a
// proof of its own, and so are the reasons of the others.
TEST(BlockedBranches, GiveWayToTheBestClearOne) {
  Random random;
  int replaced = 0;
  for (int i = 0; i < testing::cases(60); ++i) {
    const Arm arm = built_in(i % 2 == 0 ? "puma560" : "ur5");
    const std::vector<Pose> line = random_line(random, arm);
    const PathMotion free = move_in_lines(arm, line);
    if (!free) continue;
    const CollisionModel model = model_with_ball(arm, elbow_of(arm, free.trajectory), 0.05);
    const auto blocked = [&](const Trajectory& motion, const ClearanceOptions& options) {
      return prove_clearance(model, motion, options).reason;
    };
    ASSERT_TRUE(blocked(free.trajectory, {}));
    const PathMotion motion = move_in_lines(arm, line, {.blocked_by = {.reason = blocked}});
    ASSERT_FALSE(motion.blocked.empty());
    EXPECT_EQ(motion.blocked.front().start, free.trajectory.positions.front());
    for (const BlockedBranch& branch : motion.blocked) {
      EXPECT_TRUE(branch.reason);
      EXPECT_NE(branch.status, MotionStatus::reached);
      if (branch.status != MotionStatus::collides) continue;
      const PathMotion again = move_in_lines(arm, branch.start, std::span(line).subspan(1),
                                             {.blocked_by = {.reason = blocked}});
      EXPECT_FALSE(again) << branch.reason;
      EXPECT_TRUE(again.blocked.empty());
    }
    if (!motion) {
      EXPECT_EQ(motion.status, MotionStatus::collides) << motion.reason;
      EXPECT_EQ(motion.reason, motion.blocked.front().reason);
      EXPECT_EQ(motion.trajectory.size(), 0U);
      continue;
    }
    ++replaced;
    EXPECT_TRUE(prove_clearance(model, motion.trajectory));
    EXPECT_TRUE(std::isfinite(motion.deviation.bound.position));
  }
  EXPECT_GT(replaced, 0);
}

TEST(BlockedBranches, OfARedundantArmGiveWayToo) {
  Random random;
  const Arm arm = built_in("panda");
  int replaced = 0;
  for (int i = 0; i < testing::cases(9); ++i) {
    const std::vector<Pose> line = random_line(random, arm);
    const PathMotion free = move_in_lines(arm, line);
    if (!free) continue;
    const Vector3 elbow = link_poses(arm, free.trajectory.positions.front())[4].translation();
    const CollisionModel model = model_with_ball(arm, elbow, 0.03);
    const PathMotion motion = move_in_lines(arm, line, {.blocked_by = blocked_motions(model)});
    ASSERT_FALSE(motion.blocked.empty());
    if (!motion) continue;
    ++replaced;
    EXPECT_TRUE(prove_clearance(model, motion.trajectory));
  }
  EXPECT_GT(replaced, 0);
}

// From a given start there is no other branch: the elbow passes the ball by self-motion.
TEST(BlockedBranches, GiveWayToAMotionAsideFromTheSameStart) {
  Random random;
  const Arm arm = built_in("panda");
  int aside = 0;
  for (int i = 0; i < 30; ++i) {
    const std::optional<LineBesideBall> beside = line_beside_ball(random, arm);
    if (!beside) continue;
    const auto& [waypoints, start, model] = *beside;
    const PathMotion motion =
        move_in_lines(arm, start, waypoints, {.blocked_by = blocked_motions(model)});
    if (!motion) continue;
    EXPECT_TRUE(prove_clearance(model, motion.trajectory));
    EXPECT_EQ(motion.trajectory.positions.front(), start);
    if (motion.blocked.empty()) continue;
    ++aside;
    EXPECT_EQ(motion.blocked.size(), 1U);
    EXPECT_EQ(motion.blocked.front().start, start);
    EXPECT_EQ(motion.blocked.front().status, MotionStatus::collides);
    const BlockedMotions proofs_alone{.reason = blocked_motions(model).reason};
    EXPECT_FALSE(move_in_lines(arm, start, waypoints, {.blocked_by = proofs_alone}));
  }
  EXPECT_GT(aside, 0);
}

// Two redundant joints: the graph of configurations has no blocked ones.
TEST(BlockedBranches, OfAnArmWithTwoRedundantJointsGiveWay) {
  Random random;
  const Arm arm = arm_from_joint_string("RRRR:0.3,0.3,0.3,0.3");
  int aside = 0;
  for (int i = 0; i < 24; ++i) {
    PathMotionOptions options{.task = Task{{true, true, false, false, false, false}}};
    const std::optional<LineBesideBall> beside = line_beside_ball(random, arm, options);
    if (!beside) continue;
    const auto& [waypoints, start, model] = *beside;
    options.blocked_by = blocked_motions(model);
    const PathMotion motion = move_in_lines(arm, start, waypoints, options);
    if (!motion) continue;
    EXPECT_TRUE(prove_clearance(model, motion.trajectory));
    aside += motion.blocked.empty() ? 0 : 1;
  }
  EXPECT_GT(aside, 0);
}

// A motion that keeps all rows of the pose also keeps the rows of a looser task.
TEST(BlockedBranches, GiveWayToAMotionOfAStricterTask) {
  Random random;
  const Arm arm = built_in("panda");
  int followed = 0, missed = 0;  // a motion may be blocked between its samples
  for (int i = 0; i < testing::cases(100); ++i) {
    PathMotionOptions loose{.task = Task::position()};
    const std::optional<LineBesideBall> beside = line_beside_ball(random, arm, loose);
    if (!beside) continue;
    const auto& [waypoints, start, model] = *beside;
    loose.blocked_by = blocked_motions(model);
    const PathMotion strict =
        move_in_lines(arm, start, waypoints, {.blocked_by = loose.blocked_by});
    if (!strict) continue;
    ++followed;
    const PathMotion motion = move_in_lines(arm, start, waypoints, loose);
    missed += motion ? 0 : 1;
    EXPECT_TRUE(!motion || prove_clearance(model, motion.trajectory));
  }
  EXPECT_GT(followed, 0);
  EXPECT_LE(4 * missed, followed);
}

TEST(BlockedBranches, AreNotOfSuggestedPaths) {
  Random random;
  int suggested = 0;
  for (int i = 0; i < 12; ++i) {
    const Arm arm = built_in(i % 2 == 0 ? "ur5" : "panda");
    const std::vector<Pose> line = random_line(random, arm);
    const PathMotion free = move_in_lines(arm, line);
    if (!free) continue;
    // The ball is where the flange has to be in the end.
    const CollisionModel model = model_with_ball(
        arm, link_poses(arm, free.trajectory.positions.back()).back().translation(), 0.02);
    const Configuration& start = free.trajectory.positions.front();
    if (blocked_by(model, start)) continue;
    const PathMotionOptions options{.blocked_by = blocked_motions(model), .suggest = true};
    const PathMotion motion = move_in_lines(arm, start, std::span(line).subspan(1), options);
    EXPECT_EQ(motion.status, MotionStatus::collides);
    for (const NearbyPath& nearby : motion.nearby) {
      ++suggested;
      const PathMotion again = move_along(arm, nearby.start.value_or(start),
                                          route_of(nearby.path, PathKind::line), options);
      EXPECT_TRUE(again) << again.reason;
      EXPECT_TRUE(prove_clearance(model, again.trajectory));
    }
  }
  EXPECT_GT(suggested, 0);
}

TEST(BlockedBranches, AreNoneWhereTheBestOneIsClear) {
  const Arm arm = built_in("puma560");
  const Configuration q = Configuration::Constant(6, 0.3);
  const std::vector<Pose> line{forward_kinematics(arm, q),
                               forward_kinematics(arm, q + Configuration::Constant(6, 0.1))};
  int asked = 0;
  const PathMotion motion = move_in_lines(
      arm, line, {.blocked_by = {.reason = [&](const Trajectory&, const ClearanceOptions&) {
                    ++asked;
                    return Reason();
                  }}});
  EXPECT_TRUE(motion);
  EXPECT_TRUE(motion.blocked.empty());
  EXPECT_EQ(asked, 1);
}

TEST(BlockedBranches, EndWithTheBudget) {
  const Arm arm = built_in("puma560");
  const Configuration q = Configuration::Constant(6, 0.3);
  const std::vector<Pose> line{forward_kinematics(arm, q),
                               forward_kinematics(arm, q + Configuration::Constant(6, 0.1))};
  const Reason never{ReasonCode::bodies_too_close};
  testing::for_each_cancellation(testing::cases(30), [&](int n) {
    testing::CancelAt cancel(n);
    const PathMotion motion =
        move_in_lines(arm, line,
                      {.blocked_by = {.reason = [&](const Trajectory&,
                                                    const ClearanceOptions&) { return never; }},
                       .budget = cancel.budget()});
    EXPECT_FALSE(motion);
    if (!cancel.cancelled()) {
      EXPECT_EQ(motion.status, MotionStatus::collides);
      EXPECT_EQ(motion.blocked.size(), 8U);
    }
    return cancel.cancelled();
  });
}

TEST(BlockedBranches, AreNotOfPrograms) {
  const Arm arm = built_in("puma560");
  const Program program{.moves = {{.kind = MoveKind::joint, .q = Configuration::Constant(6, 0.2)}}};
  EXPECT_REFUSED(
      move_program(arm, Configuration::Zero(6), program,
                   {.blocked_by = {.reason = [](const Trajectory&,
                                                const ClearanceOptions&) { return Reason(); }}}),
      "blocked_by is for paths");
}

}  // namespace
}  // namespace beeline
