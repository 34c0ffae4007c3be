#include <tests/planning/joint_blend_promises.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using namespace testing;

/// A planar arm whose wrist cannot come nearer to its base than 2 m, nor farther away than 4 m.
Arm arm_with_hole() {
  std::vector<Joint> joints;
  for (const double x : {0.0, 3.0, 1.0}) {
    Joint joint;
    joint.name = "j" + std::to_string(joints.size() + 1);
    joint.offset = to_space(Pose2{x, 0, 0}, 0);
    joint.screw = rotation_screw(Vector3::UnitZ());
    joints.push_back(joint);
  }
  return {"hole", joints, to_space(Pose2{0.5, 0, 0}, 0)};
}

Pose wrist_at(double x, double y) {
  return make_pose(Vector3(x + 0.5, y, 0), Rotation::Identity());
}

/// Lines around the hole, over a waypoint at a height above its edge.
Program around_hole(double height, double side, double blend) {
  Program program;
  program.moves = {{.target = wrist_at(-3.2, side)},
                   {.target = wrist_at(0, height), .blend = blend},
                   {.target = wrist_at(3.2, side)}};
  return program;
}

TEST(LineBlends, AreSmallerWhereTheArmHasNoMotion) {
  Random random;
  const Arm arm = arm_with_hole();
  int smaller = 0, full = 0;
  for (int i = 0; i < cases(20); ++i) {
    SCOPED_TRACE(i);
    const Program program =
        around_hole(random.uniform(2.2, 2.5), random.uniform(1, 1.2), random.uniform(0.1, 1));
    PathMotionOptions options;
    if (random.integer(0, 2) == 0) options.rate = 250;
    const ProgramMotion motion = move_program(arm, std::nullopt, program, options);
    ASSERT_TRUE(motion) << motion;
    expect_proved(arm, program, motion);
    EXPECT_EQ(motion.moves[1].blend_radius > 0, motion.moves[1].blend != BlendOutcome::stop);
    smaller += motion.moves[1].blend == BlendOutcome::smaller;
    full += motion.moves[1].blend == BlendOutcome::full;
    if (motion.moves[1].blend != BlendOutcome::smaller) continue;
    Program other = program;
    other.moves[1].target.translation().y() += 1e-3;
    EXPECT_FALSE(verify(arm, motion.trajectory, other));
  }
  EXPECT_GE(8 * smaller, cases(20));
  EXPECT_GE(8 * full, cases(20));
}

TEST(LineBlends, AreStopsWhereNoneIsPossible) {
  const Arm arm = arm_with_hole();
  Program program = around_hole(2.002, 1.875, 1);
  const ProgramMotion motion = move_program(arm, std::nullopt, program);
  ASSERT_TRUE(motion) << motion;
  EXPECT_EQ(motion.moves[1].blend, BlendOutcome::stop);
  EXPECT_EQ(motion.moves[1].blend_radius, 0);
  EXPECT_LE(motion.trajectory.velocities[motion.moves[1].end].norm(), 1e-9);
  expect_proved(arm, program, motion);
  program.moves[1].target = wrist_at(0, 1.9);  // no blend is to blame
  const ProgramMotion refused = move_program(arm, std::nullopt, program);
  EXPECT_FALSE(refused);
  EXPECT_EQ(refused.failed, 1u);
}

TEST(LineBlends, OnlyTheImpossibleOneChanges) {
  const Arm arm = arm_with_hole();
  Program program = around_hole(2.35, 1, 0.9);
  const Configuration start = move_program(arm, std::nullopt, program).trajectory.positions[0];
  Configuration before = start;
  before[0] += 0.3;
  program.moves.insert(program.moves.begin(), {.kind = MoveKind::joint, .q = before, .blend = 0.1});
  program.moves[1] = {.kind = MoveKind::joint, .q = start, .blend = 0.1};
  program.moves.back().blend = 0.1;
  program.moves.push_back({.target = wrist_at(3.2, 0.2), .blend = 0.1});
  program.moves.push_back({.target = wrist_at(2.8, 0.2)});
  for (const double rate : {0.0, 250.0}) {
    const ProgramMotion motion = move_program(arm, before, program, {.rate = rate});
    ASSERT_TRUE(motion) << motion;
    expect_proved(arm, program, motion);
    EXPECT_EQ(motion.moves[2].blend, BlendOutcome::smaller);
    EXPECT_EQ(motion.moves[3].blend, BlendOutcome::full);
    EXPECT_EQ(motion.moves[4].blend, BlendOutcome::full);
    EXPECT_EQ(motion.moves[1].blend, BlendOutcome::full);
  }
}

TEST(LineBlends, PassLinesOfAlmostNoLengthWithoutALoss) {
  const Arm arm = built_in("panda");
  const Configuration home = Configuration{{0, -45, 0, -135, 0, 90, 45}} * deg;
  const auto away = [&](double x, double y) { return moved_tool(arm, home, x, y); };
  const auto program_of = [&](std::optional<double> tiny) {
    Program program;
    program.moves.push_back({.target = away(0.1, 0), .blend = 0.01});
    if (tiny) program.moves.push_back({.target = away(0.1, *tiny), .blend = 0.01});
    program.moves.push_back({.target = away(0.1, 0.1), .blend = 0.01});
    program.moves.push_back({.target = away(0, 0.1), .blend = 0.01});
    if (tiny) program.moves.push_back({.target = away(-*tiny, 0.1), .blend = 0.01});
    program.moves.push_back({.target = away(0, 0.2), .blend = 0.01});
    program.moves.push_back({.kind = MoveKind::joint, .q = home});
    return program;
  };
  const ProgramMotion without = move_program(arm, home, program_of({}));
  ASSERT_TRUE(without) << without;
  for (const double tiny : {0.0, 1e-13, 1e-9, 1e-6}) {
    SCOPED_TRACE(tiny);
    const Program program = program_of(tiny);
    const ProgramMotion motion = move_program(arm, home, program);
    ASSERT_TRUE(motion) << motion;
    expect_proved(arm, program, motion);
    EXPECT_NEAR(motion.duration(), without.duration(), 1e-3 * without.duration());
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_EQ(motion.moves[k].blend, BlendOutcome::full) << k;
      EXPECT_GT(motion.trajectory.velocities[motion.moves[k].end].norm(), 1e-3) << k;
    }
  }
}

TEST(LineBlends, BelowTheSmallestNameTheirOwnRow) {
  const Arm arm = arm_with_hole();
  Program program = around_hole(2.6, 1, 5e-5);
  EXPECT_REFUSED(move_program(arm, std::nullopt, program),
                 "move 2 (line): the tolerances of a blend");
  program.moves[1].blend = 0.1;
  program.moves[2].blend = 5e-5;
  program.moves.push_back({.target = wrist_at(3, 0.5)});
  EXPECT_REFUSED(move_program(arm, std::nullopt, program),
                 "move 3 (line): the tolerances of a blend");
}

}  // namespace
}  // namespace beeline
