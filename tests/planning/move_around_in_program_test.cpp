#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/internal/pose_configurations.h>
#include <beeline/planning/program.h>

#include <tests/collision/random_model.h>
#include <tests/planning/gantry.h>
#include <tests/reason.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using namespace testing;

std::vector<std::size_t> arrivals_of(const ProgramMotion& motion) {
  std::vector<std::size_t> arrivals;
  for (const PlannedMove& move : motion.moves) arrivals.push_back(move.end);
  return arrivals;
}

/// The move goes from waypoint to waypoint, from the sample where it begins to that where it ends.
void expect_waypoints(const ProgramMotion& motion, std::size_t move) {
  const PlannedMove& planned = motion.moves[move];
  ASSERT_GE(planned.waypoints.size(), 2U);
  const std::vector<Configuration>& positions = motion.trajectory.positions;
  EXPECT_LT((planned.waypoints.front() - positions[planned.begin]).norm(), 1e-9);
  EXPECT_LT((planned.waypoints.back() - positions[planned.end]).norm(), 1e-9);
}

/// The gantry takes the part over the wall: move 2 is of the kind, with the part attached.
Program over_the_wall(MoveKind kind) {
  Program program;
  program.moves = {joint_move(Configuration{{0, 0, 0.21}}), joint_move(Configuration{{1, 0, 0.21}}),
                   joint_move(Configuration{{1, 0, 1}})};
  program.moves[1].kind = kind;
  program.attachments = {{.part = "part", .after = 1, .until = 2, .touch = {"table"}}};
  return program;
}

TEST(MoveAroundInProgram, CarriesAPartOverAWall) {
  const Gantry gantry;
  const CollisionModel model = gantry.model();
  const Program straight = over_the_wall(MoveKind::joint), around = over_the_wall(MoveKind::around);
  const ProgramMotion through = move_program(gantry.arm, gantry.above, straight, {}, &model);
  ASSERT_TRUE(through) << through.reason;
  EXPECT_FALSE(prove_clearance(model, through.trajectory, straight, arrivals_of(through)));

  const ProgramMotion motion = move_program(gantry.arm, gantry.above, around, {}, &model);
  ASSERT_TRUE(motion) << motion.reason;
  EXPECT_TRUE(prove_clearance(model, motion.trajectory, around, arrivals_of(motion)));
  EXPECT_TRUE(verify(gantry.arm, motion.trajectory, around));
  expect_waypoints(motion, 1);
  EXPECT_GT(motion.moves[1].waypoints.size(), 2U);
  EXPECT_TRUE(motion.moves[0].waypoints.empty());
  double highest = 0;  // the part below the tool is 0.2 m high, and the wall 0.4 m
  for (const Configuration& q : motion.trajectory.positions) highest = std::max(highest, q[2]);
  EXPECT_GT(highest, 0.61);

  const ProgramMotion sampled =
      move_program(gantry.arm, gantry.above, around, {.rate = 100}, &model);
  ASSERT_TRUE(sampled) << sampled.reason;
  EXPECT_TRUE(prove_clearance(model, sampled.trajectory, around, arrivals_of(sampled)));
}

// Of a redundant arm a few solutions are tried first; where all of them are blocked, others are
// free.
TEST(MoveAroundInProgram, FindsAFreeGoalBetweenBlockedOnes) {
  const Arm arm = built_in("panda");
  const Configuration start{{0, -0.785, 0, -2.356, 0, 1.571, 0.785}};
  // The shapes are capsules along the last links.
  const std::vector<LinkShapes> shapes{
      {"elbow", 4, {{Capsule{0.06, 0.3}, make_pose({0, 0, 0.1}, Rotation::Identity())}}},
      {"hand", 7, {{Sphere{0.05}}}}};
  testing::Random random;
  int all_blocked = 0, reached = 0;
  const int count = testing::cases(300);
  for (int i = 0; i < count; ++i) {
    Program program;
    program.moves = {
        {.kind = MoveKind::around,
         .target = make_pose(Vector3(0.45, 0.2, 0.4), so3_exp(Vector3(std::numbers::pi, 0, 0)))}};
    const Vector3 near_elbow = Vector3(0.15, 0.15, 0.6) + 0.15 * random.direction();
    const Scene scene{
        .obstacles = {{.name = "ball",
                       .shapes = {{Sphere{0.05}, make_pose(near_elbow, Rotation::Identity())}}}}};
    const CollisionModel model(arm, shapes, scene, {.self_collision = false});
    const auto blocked = [&](const ConfigurationRef& q) { return blocked_by(model, q); };
    if (blocked(start)) continue;
    const std::vector<Configuration> few =
        internal::configurations_for(arm, Task::spatial(), program.moves[0].target, start, {});
    if (!std::all_of(few.begin(), few.end(), [&](const auto& q) { return bool(blocked(q)); })) {
      continue;
    }
    const InverseResult free = inverse_kinematics(
        arm, program.moves[0].target, {.seed = start, .all = true, .blocked_by = blocked});
    if (free.solutions.empty()) continue;
    ++all_blocked;
    const ProgramMotion motion = move_program(arm, start, program, {}, &model);
    reached += bool(motion);
    EXPECT_TRUE(motion) << "case " << i << ": " << motion.reason;
  }
  EXPECT_TRUE(reached > 0 || count < 300) << all_blocked;
}

TEST(MoveAroundInProgram, NamesTheMoveThatIsNotPossible) {
  Gantry gantry;
  const Program program = over_the_wall(MoveKind::around);
  EXPECT_REFUSED(move_program(gantry.arm, gantry.above, program),
                 "move 2 (around): a motion around obstacles needs their scene");
  gantry.scene.obstacles.push_back(box("block", {1, 0, 0.3}, {0.1, 0.1, 0.1}));
  const CollisionModel blocked = gantry.model();
  const ProgramMotion motion = move_program(gantry.arm, gantry.above, program, {}, &blocked);
  EXPECT_EQ(motion.status, MotionStatus::collides);
  EXPECT_EQ(motion.failed, 1U);
  EXPECT_EQ(field<std::size_t>(motion.reason, ReasonField::move), 2U);
  const CollisionModel other(built_in("panda"), {}, {});
  EXPECT_REFUSED(move_program(gantry.arm, gantry.above, program, {}, &other),
                 "model has an arm with other links or limits, panda");
  const Arm slower = with_limits(gantry.arm, {{"x", {.velocity = 0.5}}});
  EXPECT_REFUSED(move_program(slower, gantry.above, program, {}, &blocked), "model has an arm");
  Program unknown = program;
  unknown.attachments[0].part = "box";
  EXPECT_REFUSED(move_program(gantry.arm, gantry.above, unknown, {}, &blocked), "box");
}

TEST(MoveAroundInProgram, BeginsAtAFreeConfiguration) {
  const Arm arm = built_in("ur5");
  Random random;
  int reached = 0;
  for (int i = 0; i < testing::cases(30); ++i) {
    const CollisionModel model(arm, random_link_shapes(random, arm, 0.05),
                               random_scene(random, arm, 6, 0.15, 0.8));
    Program program;
    program.moves = {{.kind = MoveKind::around},
                     {.kind = MoveKind::line},
                     {.kind = MoveKind::around, .q = middle_configuration(arm)}};
    const Pose at = forward_kinematics(arm, random.configuration(arm));
    program.moves[0].target = program.moves[1].target = at;
    program.moves[1].target.translation() += 0.05 * random.direction();
    const ProgramMotion motion = move_program(arm, std::nullopt, program, {}, &model);
    if (!motion) continue;
    ++reached;
    EXPECT_TRUE(prove_clearance(model, motion.trajectory, program, arrivals_of(motion)));
  }
  EXPECT_GT(reached, 0);
}

// Each move around obstacles ends at a configuration from which the line after it is free, so that
// every motion of a program that has only these is.
TEST(MoveAroundInProgram, EndsWhereTheNextLineIsFree) {
  Random random;
  int reached = 0, blocked = 0;
  const int programs = testing::cases(48), few = 10;
  for (int i = 0; i < programs; ++i) {
    const Arm arm = built_in(i % 2 == 0 ? "ur5" : "panda");
    const CollisionModel model(arm, random_link_shapes(random, arm, 0.05),
                               random_scene(random, arm, 6, 0.15, 0.8));
    const Configuration start = random.configuration(arm);
    const Configuration goal = 0.5 * (random.configuration(arm) + middle_configuration(arm));
    Program program;
    program.moves = {{.kind = MoveKind::around, .target = forward_kinematics(arm, goal)},
                     {.kind = MoveKind::line, .target = forward_kinematics(arm, goal)}};
    program.moves[1].target.translation() += 0.1 * random.direction();
    const ProgramMotion motion =
        move_program(arm, start, program, {.budget = {.max_work = 200'000}}, &model);
    if (!motion) {
      EXPECT_TRUE(motion.reason) << "a refusal without a reason";
      continue;
    }
    ++reached;
    EXPECT_FALSE(motion.reason) << motion.reason;
    EXPECT_EQ(motion.failed, program.moves.size());
    expect_waypoints(motion, 0);
    EXPECT_TRUE(verify(arm, motion.trajectory, program));
    const ClearanceProof proof =
        prove_clearance(model, motion.trajectory, program, arrivals_of(motion));
    EXPECT_TRUE(proof) << arm.name() << ": " << proof.reason;
    program.moves[0].kind = MoveKind::joint;
    const ProgramMotion straight = move_program(arm, start, program);
    if (straight) {
      blocked += !prove_clearance(model, straight.trajectory, program, arrivals_of(straight));
    }
  }
  EXPECT_GT(reached, 0);
  EXPECT_TRUE(blocked > 0 || programs < few) << "no straight joint motion is blocked";
}

}  // namespace
}  // namespace beeline
