#include <thread>

#include <tests/planning/gantry.h>
#include <tests/planning/joint_blend_promises.h>

namespace beeline {
namespace {

using namespace testing;

Configuration degrees(const ConfigurationRef& values) { return values * deg; }

/// A program of the panda with each kind of blend.
Program mixed_program(double blend) {
  Program program;
  const auto joint = [&](Configuration q) {
    program.moves.push_back({.kind = MoveKind::joint, .q = std::move(q), .blend = blend});
  };
  const auto line = [&](double x, double y, double z) {
    Pose target = program.moves.back().q
                      ? forward_kinematics(built_in("panda"), *program.moves.back().q)
                      : program.moves.back().target;
    target.translation() += Vector3(x, y, z);
    program.moves.push_back({.target = target, .blend = blend});
  };
  joint(degrees({20, -30, 0, -120, 0, 90, 45}));
  joint(degrees({0, -10, 10, -110, 0, 100, 45}));
  line(0, 0.1, 0);
  joint(degrees({-20, -40, 0, -130, 10, 80, 45}));
  joint(degrees({0, -45, 0, -135, 0, 90, 45}));
  program.moves.back().blend = 0;
  return program;
}

TEST(JointBlends, AreRefusedWhenTheyAreAltered) {
  const Arm arm = built_in("panda");
  const Configuration home = degrees({0, -45, 0, -135, 0, 90, 45});
  const Program program = mixed_program(0.02);
  for (const double rate : {0.0, 500.0}) {
    const ProgramMotion motion = move_program(arm, home, program, {.rate = rate});
    ASSERT_TRUE(motion) << motion;
    EXPECT_EQ(blend_count(motion), 4);
    const auto refusal = [&](const auto& change) {
      Program other = program;
      change(other.moves);
      return verify(arm, motion.trajectory, other).fault;
    };
    using Moves = std::vector<Move>;
    EXPECT_EQ(refusal([](Moves&) {}), Fault::none);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NE(refusal([&](Moves& moves) { moves[i].blend = 0; }), Fault::none) << i;
      EXPECT_NE(refusal([&](Moves& moves) { moves[i].blend = 0.002; }), Fault::none) << i;
    }
    EXPECT_NE(refusal([](Moves& moves) { std::swap(moves[0], moves[1]); }), Fault::none);
    for (std::size_t i = 0; i < 5; ++i) {
      const double speed = motion.moves[i].tool_speed;
      EXPECT_EQ(refusal([&](Moves& moves) { moves[i].speed = 0.8 * speed; }), Fault::tool_speed);
      EXPECT_EQ(refusal([&](Moves& moves) { moves[i].speed = 1.01 * speed; }), Fault::none);
    }
    // A sample in the middle of the line, moved by a millimetre across it.
    Trajectory moved = motion.trajectory;
    const std::size_t middle = (motion.moves[2].begin + motion.moves[2].end) / 2;
    moved.positions[middle][1] += 2e-3;
    EXPECT_NE(verify(arm, moved, program).fault, Fault::none);
    Trajectory faster = motion.trajectory;
    for (double& t : faster.times) t *= 0.99;
    EXPECT_NE(verify(arm, faster, program).fault, Fault::none);
  }
}

TEST(JointBlends, KeepTheSpeedOfTheirRowInAnIntervalWithoutSamples) {
  const Arm arm = built_in("panda");
  const Configuration home = degrees({0, -45, 0, -135, 0, 90, 45});
  Program program;
  program.moves = {{.kind = MoveKind::joint,
                    .q = degrees({20, -30, 0, -120, 0, 90, 45}),
                    .speed = 0.01,
                    .blend = 0.02},
                   {.kind = MoveKind::joint, .q = degrees({40, -15, 0, -105, 0, 90, 45})}};
  const Configuration rest = Configuration::Zero(7);
  const auto fault = [&](double duration) {
    const Trajectory sparse{
        arm.joint_names(), {0, duration}, {home, *program.moves[1].q}, {rest, rest}, {rest, rest}};
    return verify(arm, sparse, program).fault;
  };
  EXPECT_EQ(fault(1.5), Fault::tool_speed);
  EXPECT_EQ(fault(500), Fault::none);
  program.moves[0].speed.reset();
  EXPECT_EQ(fault(1.5), Fault::none);
  program.moves[1].speed = 0.01;  // after the passage
  EXPECT_EQ(fault(1.5), Fault::tool_speed);
}

/// Down in a line, a pause, up, and to two configurations.
Program retreat(double down, double up, double blend) {
  const Arm arm = built_in("panda");
  const Pose at = make_pose({0.5, 0.2, 0.15}, rotation(RollPitchYaw{180 * deg, 0, 20 * deg}));
  const auto above = [&](double z) {
    Pose pose = at;
    pose.translation() += Vector3(0, 0, z);
    return pose;
  };
  Program program;
  program.moves = {
      {.kind = MoveKind::joint, .target = above(down), .blend = blend},
      {.target = at, .dwell = 0.3},
      {.target = above(up), .blend = blend},
      {.kind = MoveKind::joint, .q = degrees({10, -20, 0, -120, 0, 100, 45}), .blend = blend},
      {.kind = MoveKind::joint, .q = degrees({-30, -30, 0, -130, 0, 100, 45})}};
  return program;
}

TEST(JointBlends, MayBeLongerThanTheirLinesOrShorterThanTheWayBetweenSamples) {
  const Arm arm = built_in("panda");
  const Configuration home = degrees({0, -45, 0, -135, 0, 90, 45});
  for (const double blend : {1e-9, 1e-4, 1e-3, 0.149, 0.151, 1e9}) {
    for (const double rate : {0.0, 20.0, 50.0}) {
      SCOPED_TRACE(std::to_string(blend) + " at rate " + std::to_string(rate));
      const Program program = retreat(0.15, 0.15, blend);
      const ProgramMotion motion = move_program(arm, home, program, {.rate = rate});
      ASSERT_TRUE(motion) << motion;
      EXPECT_TRUE(verify(arm, motion.trajectory, program));
    }
  }
}

TEST(JointBlends, ProveAllOfALineAtWhoseEndTheArmStops) {
  const Arm arm = built_in("panda");
  const Configuration home = degrees({0, -45, 0, -135, 0, 90, 45});
  Program program;
  Pose below = forward_kinematics(arm, home);
  below.translation().z() -= 0.2;
  program.moves = {{.kind = MoveKind::joint, .q = home},
                   {.target = below},
                   {.kind = MoveKind::joint, .q = home}};
  const ProgramMotion motion = move_program(arm, home, program);
  ASSERT_TRUE(motion) << motion;
  program.moves[1].blend = 0.09;
  const Verification proof = verify(arm, motion.trajectory, program);
  ASSERT_TRUE(proof);
  for (std::size_t k = motion.moves[1].begin; k < motion.moves[1].end; ++k) {
    EXPECT_GT(proof.deviation.interval_bounds[k].position, 0) << k;
  }
}

TEST(JointBlends, KeepTheSpeedOfBothRows) {
  const Arm arm = built_in("panda");
  const Configuration home = degrees({0, -45, 0, -135, 0, 90, 45});
  for (std::size_t slow = 0; slow < 5; ++slow) {
    Program program = mixed_program(0.02);
    program.moves[slow].speed = 0.05;
    const ProgramMotion motion = move_program(arm, home, program);
    ASSERT_TRUE(motion) << motion;
    EXPECT_GE(blend_count(motion), 2);
    EXPECT_LE(motion.moves[slow].tool_speed, 0.05 * (1 + 1e-6));
    EXPECT_TRUE(verify(arm, motion.trajectory, program));
  }
}

TEST(JointBlends, MeetRepeatedPosesAtRest) {
  const Arm arm = built_in("panda");
  const Configuration home = degrees({0, -45, 0, -135, 0, 90, 45});
  for (std::size_t repeated = 0; repeated < 5; ++repeated) {
    SCOPED_TRACE(repeated);
    Program program = mixed_program(0.02);
    Move again = program.moves[repeated];
    if (repeated == 4) program.moves[4].blend = 0.02;
    program.moves.insert(program.moves.begin() + static_cast<std::ptrdiff_t>(repeated) + 1, again);
    const ProgramMotion motion = move_program(arm, home, program);
    ASSERT_TRUE(motion) << motion;
    EXPECT_GE(blend_count(motion), 2);
    EXPECT_EQ(motion.moves[repeated].blend, BlendOutcome::stop);
    expect_proved(arm, program, motion);
  }
  Program line = mixed_program(0.02);  // a line without length between joint moves
  line.moves[2].target = forward_kinematics(arm, *line.moves[1].q);
  const ProgramMotion motion = move_program(arm, home, line);
  ASSERT_TRUE(motion) << motion;
  EXPECT_EQ(motion.moves[1].blend, BlendOutcome::stop);
  EXPECT_EQ(motion.moves[2].blend, BlendOutcome::stop);
  expect_proved(arm, line, motion);
}

TEST(JointBlends, StopWhereTheMotionTurnsBack) {
  const Arm arm = built_in("panda");
  const Configuration a = degrees({0, -45, 0, -135, 0, 90, 45}),
                      b = degrees({30, -20, 0, -110, 0, 90, 45});
  Program program;
  for (const Configuration& q : {b, a, b}) {
    program.moves.push_back({.kind = MoveKind::joint, .q = q, .blend = 0.05});
  }
  program.moves.back().blend = 0;
  const ProgramMotion motion = move_program(arm, a, program);
  ASSERT_TRUE(motion) << motion;
  EXPECT_EQ(motion.moves[0].blend, BlendOutcome::stop);
  const ProgramMotion stops = move_program(arm, a, with_stops(program));
  EXPECT_EQ(motion.trajectory.times, stops.trajectory.times);
  EXPECT_EQ(motion.trajectory.positions, stops.trajectory.positions);
  EXPECT_TRUE(verify(arm, motion.trajectory, program));
}

TEST(JointBlends, WorkWithEveryInterpolation) {
  const Arm arm = built_in("panda");
  const Configuration home = degrees({0, -45, 0, -135, 0, 90, 45});
  const Program program = mixed_program(0.02);
  for (const Interpolation way : {Interpolation::linear, Interpolation::cubic}) {
    for (const double rate : {0.0, 1000.0}) {
      const ProgramMotion motion =
          move_program(arm, home, program, {.interpolation = way, .rate = rate});
      ASSERT_TRUE(motion) << motion;
      // Linear joints need many samples, and stops may be quicker.
      const bool linear = way == Interpolation::linear && rate == 0;
      EXPECT_TRUE(linear || blend_count(motion) > 0);
      expect_proved(arm, program, motion);
    }
  }
}

TEST(JointBlends, EndByTheBudget) {
  const Arm arm = built_in("panda");
  const Configuration home = degrees({0, -45, 0, -135, 0, 90, 45});
  const Program program = mixed_program(0.02);
  for (const double work : {1e2, 1e3, 3e3, 1e4}) {
    PathMotionOptions options;
    options.budget.max_work = static_cast<std::int64_t>(work);
    const ProgramMotion motion = move_program(arm, home, program, options);
    EXPECT_TRUE(motion || motion.status == MotionStatus::work_limit) << motion;
  }
}

TEST(JointBlends, AreTheSameInEveryThread) {
  const Arm arm = built_in("panda");
  const Configuration home = degrees({0, -45, 0, -135, 0, 90, 45});
  const Program program = mixed_program(0.02);
  const ProgramMotion alone = move_program(arm, home, program);
  std::vector<Trajectory> others(4);
  std::vector<std::thread> threads;
  for (Trajectory& other : others) {
    threads.emplace_back([&] { other = move_program(arm, home, program).trajectory; });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Trajectory& other : others) {
    EXPECT_EQ(other.times, alone.trajectory.times);
    EXPECT_EQ(other.positions, alone.trajectory.positions);
  }
}

TEST(JointBlends, KeepTheClearance) {
  Gantry gantry;
  const Configuration start{{0.38, 0, 0.01}};
  Program program;  // up beside the wall, and closely over it
  program.moves = {joint_move(Configuration{{0.38, 0, 0.41}}),
                   joint_move(Configuration{{1.2, 0, 0.41}})};
  program.moves[0].blend = 0.1;
  gantry.scene.obstacles.erase(gantry.scene.obstacles.begin());  // the part
  const CollisionModel model = gantry.model();
  for (const bool line : {false, true}) {
    if (line) {
      program.moves[0].kind = MoveKind::line;
      program.moves[0].target = forward_kinematics(gantry.arm, *program.moves[0].q);
      program.moves[0].q.reset();
    }
    const auto proof = [&](const ProgramMotion& motion) {
      const Verification found = verify(gantry.arm, motion.trajectory, program);
      EXPECT_TRUE(found) << found;
      return bool(prove_clearance(model, motion.trajectory, program, found.arrivals));
    };
    const ProgramMotion free = move_program(gantry.arm, start, program);
    ASSERT_TRUE(free) << free;
    EXPECT_EQ(free.moves[0].blend, BlendOutcome::full);
    EXPECT_FALSE(proof(free));
    const ProgramMotion clear = move_program(gantry.arm, start, program, {}, &model);
    ASSERT_TRUE(clear) << clear;
    EXPECT_EQ(clear.moves[0].blend, BlendOutcome::smaller);
    EXPECT_TRUE(proof(clear));
  }
}

TEST(JointBlends, ManyAreOneMotion) {
  const Arm arm = built_in("panda");
  Random random;
  const Configuration start = near_middle(random, arm, 0.5);
  Program program;
  for (int i = 0; i < 80; ++i) {
    program.moves.push_back(
        {.kind = MoveKind::joint, .q = near_middle(random, arm, 0.5), .blend = 0.05});
  }
  program.moves.back().blend = 0;
  const ProgramMotion motion = move_program(arm, start, program);
  ASSERT_TRUE(motion) << motion;
  EXPECT_GT(blend_count(motion), 70);
  expect_blended(arm, forward_kinematics(arm, start), program, motion);
  expect_proved(arm, program, motion);
}

}  // namespace
}  // namespace beeline
