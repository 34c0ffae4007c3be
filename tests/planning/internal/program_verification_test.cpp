#include <beeline/planning/program.h>

#include <tests/planning/pick.h>
#include <tests/reason.h>

namespace beeline {
namespace {

using namespace testing;

const Configuration bent{{0, -1.2, 1.3, -1.5, -1.4, 0.3}};  // of a ur5e

Configuration turned(double angle) {
  Configuration q = bent;
  q[0] += angle;
  return q;
}

Program joint_moves(std::initializer_list<double> angles) {
  Program program;
  for (const double angle : angles) {
    program.moves.push_back({.kind = MoveKind::joint, .q = turned(angle)});
  }
  return program;
}

/// Appends a motion of the first joint by `angle` along 10 s^3 - 15 s^4 + 6 s^5 in n intervals of h
/// seconds.
void append_move(double angle, int n, double h, Trajectory& trajectory) {
  const Configuration begin = trajectory.positions.back();
  const double start = trajectory.times.back(), duration = n * h;
  for (int k = 1; k <= n; ++k) {
    const double s = double(k) / n;
    trajectory.times.push_back(start + k * h);
    Configuration q = begin, v = 0 * begin;
    q[0] += angle * s * s * s * (10 - 15 * s + 6 * s * s);
    v[0] = angle * 30 * s * s * (1 - s) * (1 - s) / duration;
    trajectory.positions.push_back(q);
    trajectory.velocities.push_back(v);
  }
}

Trajectory bent_at_rest(const Arm& arm) {
  return {arm.joint_names(), {0}, {bent}, {Configuration(0 * bent)}, {}};
}

TEST(VerifyProgram, ArmRestsAtTheWaypointsOfJointMoves) {
  const Arm arm = built_in("ur5e");
  Trajectory passing = bent_at_rest(arm);
  append_move(1, 400, 0.01, passing);
  const Verification refused = verify(arm, passing, joint_moves({0.5, 1}));
  EXPECT_EQ(refused.fault, Fault::moving) << refused.reason;
  EXPECT_EQ(refused.sample, 200u);
  EXPECT_EQ(refused.reason.code, ReasonCode::passes_without_rest);
  EXPECT_EQ(testing::field<std::size_t>(refused.reason, ReasonField::move), 1U);
  EXPECT_TRUE(verify(arm, passing, joint_moves({1})));
  passing.velocities.clear();
  EXPECT_EQ(verify(arm, passing, joint_moves({0.5, 1})).fault, Fault::moving);

  Trajectory stopping = bent_at_rest(arm);
  append_move(0.5, 200, 0.01, stopping);
  append_move(0.5, 200, 0.01, stopping);
  const Verification proved = verify(arm, stopping, joint_moves({0.5, 1}));
  EXPECT_TRUE(proved) << proved.reason;
  EXPECT_EQ(proved.arrivals, (std::vector<std::size_t>{200, 400}));
  stopping.velocities.clear();
  EXPECT_TRUE(verify(arm, stopping, joint_moves({0.5, 1})));
}

TEST(VerifyProgram, SlowMotionIsNotRest) {
  const Arm arm = built_in("ur5e");
  Trajectory resting = bent_at_rest(arm);
  append_move(0.5, 2000, 0.001, resting);
  Program program = joint_moves({0.5}), dwells = program;
  dwells.moves[0].dwell = 0.5;
  for (const double velocity : {2e-4, 8e-4}) {  // radians per second
    Trajectory creeping = resting;
    append_move(velocity, 1000, 0.001, creeping);
    EXPECT_EQ(verify(arm, creeping, program).fault, Fault::not_through) << velocity;
    EXPECT_EQ(verify(arm, creeping, dwells).fault, Fault::dwell) << velocity;
  }
  append_move(0, 1000, 0.001, resting);
  EXPECT_TRUE(verify(arm, resting, program));
  EXPECT_TRUE(verify(arm, resting, dwells));
}

TEST(VerifyProgram, JointMoveMayChangeTheConfigurationAtOnePose) {
  const Arm arm = built_in("ur5e");
  Configuration start = bent;
  start[5] = 6.1;
  const Pose here = forward_kinematics(arm, start);
  const Pose there = here * make_pose({0, 0, 0.02}, so3_exp({0, 0, 1.2}));
  for (const double dwell : {0.0, 0.2}) {
    Program program;
    program.moves = {{.kind = MoveKind::joint, .target = here, .dwell = dwell}, {.target = there}};
    const ProgramMotion motion = move_program(arm, start, program);
    ASSERT_TRUE(motion) << motion.reason;
    ASSERT_GT(motion.moves[0].end, 0u);
    const Verification proved = verify(arm, motion.trajectory, program);
    EXPECT_TRUE(proved) << proved.reason;
    ASSERT_EQ(proved.arrivals.size(), 2u);
    EXPECT_GE(proved.arrivals[0], motion.moves[0].end);
    EXPECT_EQ(proved.arrivals[1], motion.moves[1].end);

    program.moves.push_back({.target = here});  // and back: the waypoint of the joint move again
    program.moves.push_back({.kind = MoveKind::joint, .target = here});
    const ProgramMotion both = move_program(arm, start, program);
    ASSERT_TRUE(both) << both.reason;
    const Verification returned = verify(arm, both.trajectory, program);
    EXPECT_TRUE(returned) << returned.reason;
  }
}

TEST(VerifyProgram, DwellsAtOnePoseAddUp) {
  const Arm arm = built_in("ur5e");
  Trajectory trajectory = bent_at_rest(arm);
  append_move(0.5, 200, 0.01, trajectory);
  append_move(0, 3, 0.1, trajectory);
  append_move(0.5, 200, 0.01, trajectory);
  Program program = joint_moves({0.5, 0.5, 1});
  program.moves[0].dwell = program.moves[1].dwell = 0.15;  // ends within an interval
  const Verification proved = verify(arm, trajectory, program);
  EXPECT_TRUE(proved) << proved.reason;
  program.moves[1].dwell = 0.2;
  const Verification refused = verify(arm, trajectory, program);
  EXPECT_EQ(refused.fault, Fault::dwell);
  EXPECT_EQ(refused.reason.code, ReasonCode::dwell_too_short);
  EXPECT_EQ(testing::field<double>(refused.reason, ReasonField::dwell), 0.2);
}

TEST(VerifyProgram, TimesMayBeginAnywhere) {
  const Arm arm = built_in("ur5e");
  Trajectory trajectory = bent_at_rest(arm);
  append_move(0.5, 200, 0.01, trajectory);
  append_move(0, 3, 0.1, trajectory);
  append_move(0.5, 200, 0.01, trajectory);
  Program program = joint_moves({0.5, 1});
  program.moves[0].dwell = 0.3;
  for (const double shift : {-100.0, 100.0}) {
    Trajectory shifted = trajectory;
    for (double& t : shifted.times) t += shift;
    const Verification proved = verify(arm, shifted, program);
    EXPECT_TRUE(proved) << proved.reason;
  }
}

// The change of configuration is one interval: both of its samples are at rest, at one pose.
TEST(VerifyProgram, JointsMayMoveBetweenNeighbouringRests) {
  const Arm arm = built_in("ur5e");
  const Configuration start = bent;
  const Pose here = forward_kinematics(arm, start);
  const auto solutions = inverse_kinematics(arm, here, {.all = true}).solutions;
  const auto other = std::find_if(solutions.begin(), solutions.end(), [&](const auto& q) {
    const double most = (q - start).template lpNorm<Eigen::Infinity>();
    return most > 0.5 && most < 3;
  });
  ASSERT_NE(other, solutions.end());
  const Configuration end = *other;
  Pose there = here;
  there.translation().z() += 0.02;
  const PathMotion line = move_in_lines(arm, end, {there}, {});
  ASSERT_TRUE(line) << line.reason;
  Trajectory trajectory = line.trajectory;
  for (double& t : trajectory.times) t += 20;
  const Configuration still = 0 * bent;
  trajectory.times.insert(trajectory.times.begin(), 0);
  trajectory.positions.insert(trajectory.positions.begin(), start);
  trajectory.velocities.insert(trajectory.velocities.begin(), still);
  trajectory.accelerations.insert(trajectory.accelerations.begin(), still);
  Program program;
  program.moves = {{.kind = MoveKind::joint, .target = here}, {.target = there}};
  const Verification proved = verify(arm, trajectory, program);
  EXPECT_TRUE(proved) << proved.reason;
}

TEST(VerifyProgram, JointMoveMayChangeTheConfigurationBeforeALoop) {
  const Arm arm = built_in("ur5e");
  Configuration start = bent;
  start[5] = 6.1;
  const Pose here = forward_kinematics(arm, start);
  const Pose there = here * make_pose({0, 0, 0.02}, so3_exp({0, 0, 1.2}));
  for (const MoveKind kind : {MoveKind::line, MoveKind::spline}) {
    Program program;
    program.moves = {{.kind = MoveKind::joint, .target = here},
                     {.kind = kind, .target = there},
                     {.kind = kind, .target = here}};
    const ProgramMotion motion = move_program(arm, start, program);
    ASSERT_TRUE(motion) << motion.reason;
    ASSERT_GT(motion.moves[0].end, 0u);  // the spline has to begin in another configuration
    const Verification proved = verify(arm, motion.trajectory, program);
    EXPECT_TRUE(proved) << proved.reason;
  }
}

TEST(VerifyProgram, PassesMovesShorterThanTheTolerance) {
  const Arm arm = built_in("ur5e");
  const Pose here = forward_kinematics(arm, bent);
  Random random;
  const auto length = [&] { return std::pow(10, random.uniform(-6, -3)); };
  for (int i = 0; i < cases(40); ++i) {
    Program program;
    Pose at = here;
    for (int m = 0; m < 5; ++m) {
      at = at * make_pose(length() * random.direction(), so3_exp(length() * random.direction()));
      program.moves.push_back({.target = at});
    }
    program.moves.push_back({.target = here});
    const ProgramMotion motion = move_program(arm, bent, program);
    ASSERT_TRUE(motion) << motion.reason;
    const Verification proved = verify(arm, motion.trajectory, program);
    EXPECT_TRUE(proved) << proved.reason;
  }
}

TEST(VerifyProgram, RefusesPlantedFaults) {
  const Arm arm = built_in("panda");
  const Program program = pick();
  const ProgramMotion motion = move_program(arm, home, program);
  ASSERT_TRUE(motion) << motion.reason;
  ASSERT_TRUE(verify(arm, motion.trajectory, program));
  const auto fault = [&](auto change) {
    Trajectory trajectory = motion.trajectory;
    Program asked = program;
    change(trajectory, asked.moves);
    return verify(arm, trajectory, asked);
  };
  using Moves = std::vector<Move>;
  const std::size_t at = motion.moves[1].end;
  const Verification shorter = fault([&](Trajectory& moved, Moves&) {
    for (std::size_t k = at + 1; k < moved.size(); ++k) moved.times[k] -= 0.01;
  });
  EXPECT_EQ(shorter.fault, Fault::dwell) << shorter.reason;
  EXPECT_EQ(shorter.sample, at);
  EXPECT_EQ(testing::field<double>(shorter.reason, ReasonField::dwell), 0.3);
  EXPECT_NEAR(testing::field<double>(shorter.reason, ReasonField::duration).value_or(0), 0.29,
              1e-6);
  EXPECT_EQ(fault([](Trajectory&, Moves& moves) { moves[1].speed = 0.099; }).fault,
            Fault::tool_speed);
  EXPECT_EQ(fault([](Trajectory&, Moves& moves) { moves[0].speed = 0.1; }).fault,
            Fault::tool_speed);
  EXPECT_EQ(
      fault([](Trajectory&, Moves& moves) { moves[1].target.translation().y() += 3e-4; }).fault,
      Fault::not_through);
  EXPECT_NE(fault([](Trajectory&, Moves& moves) { std::swap(moves[0], moves[1]); }).fault,
            Fault::none);
  const std::size_t middle = (motion.moves[1].begin + at) / 2;
  const Verification off =
      fault([&](Trajectory& moved, Moves&) { moved.positions[middle][5] += 1e-3; });
  EXPECT_NE(off.fault, Fault::none);
  EXPECT_NE(
      fault([&](Trajectory& moved, Moves&) { moved.positions[moved.size() - 1] = home; }).fault,
      Fault::none);
  const Verification cut = fault([&](Trajectory& moved, Moves&) {
    moved.times.resize(at + 1);
    moved.positions.resize(at + 1);
    moved.velocities.resize(at + 1);
    moved.accelerations.resize(at + 1);
  });
  EXPECT_NE(cut.fault, Fault::none);
  const Verification extra = fault(
      [&](Trajectory&, Moves& moves) { moves.push_back({.kind = MoveKind::joint, .q = home}); });
  EXPECT_EQ(extra.fault, Fault::not_through) << extra.reason;
}

/// A gantry's motion along x by `distance` in `duration` seconds from rest to rest, and its program
/// of splines to these places.
Trajectory along_x(const Arm& arm, double distance, double duration, int n) {
  Trajectory along{arm.joint_names(), {}, {}, {}, {}};
  for (int k = 0; k <= n; ++k) {
    const double s = double(k) / n, rate = 30 * s * s * (1 - s) * (1 - s);
    along.times.push_back(duration * s);
    along.positions.push_back(Configuration{{distance * s * s * s * (10 - 15 * s + 6 * s * s), 0}});
    along.velocities.push_back(Configuration{{distance / duration * rate, 0}});
  }
  return along;
}

Program splines_to(const std::vector<double>& places) {
  Program program;
  for (const double x : places) {
    program.moves.push_back({.kind = MoveKind::spline, .target = make_pose({x, 0, 0})});
  }
  return program;
}

VerifyOptions positions_to(double tolerance) {
  VerifyOptions options;
  options.task = Task::position();
  options.tolerance = tolerance;
  return options;
}

// The larger limit of two moves holds within tolerance of their waypoint alone, also between
// samples.
TEST(VerifyProgram, SpeedOfAMoveHoldsUpToAWaypointThatIsPassed) {
  const Arm arm = built_in("gantry");
  constexpr double slow = 0.05, enough = 0.7;
  for (const double place : {1.0, 0.7, 1.13}) {
    Program program = splines_to({place, 2});
    Move &first = program.moves[0], &second = program.moves[1];
    for (const int n : {3, 4, 5, 33, 1000}) {
      const Trajectory along = along_x(arm, 2, 6, n);
      for (const std::optional<double> other : {std::optional<double>(), std::optional(0.9)}) {
        first.speed = slow;
        second.speed = other;
        const Verification early = verify(arm, along, program, positions_to(1e-3));
        EXPECT_EQ(early.fault, Fault::tool_speed) << n << early.reason;
        EXPECT_EQ(testing::field<std::size_t>(early.reason, ReasonField::move), 1U);
        first.speed = other;
        second.speed = slow;
        const Verification late = verify(arm, along, program, positions_to(1e-3));
        EXPECT_EQ(late.fault, Fault::tool_speed) << n << late.reason;
        EXPECT_EQ(testing::field<std::size_t>(late.reason, ReasonField::move), 2U);
      }
      first.speed = second.speed = enough;
      const Verification passed = verify(arm, along, program, positions_to(1e-3));
      EXPECT_TRUE(passed) << n << passed.reason;
    }
  }
}

// Two waypoints in one interval: the middle move has a part of it.
TEST(VerifyProgram, SpeedOfEachMoveHoldsBetweenWaypointsOfOneInterval) {
  const Arm arm = built_in("gantry");
  const Program places = splines_to({0.9, 1.1, 2});
  const auto found = [&](double before, double between, double after, int n) {
    Program program = places;
    program.moves[0].speed = before;
    program.moves[1].speed = between;
    program.moves[2].speed = after;
    return verify(arm, along_x(arm, 2, 6, n), program, positions_to(1e-3));
  };
  constexpr double enough = 0.7, slow = 0.3;
  for (const int n : {3, 5, 100}) {
    EXPECT_TRUE(found(enough, enough, enough, n)) << n << found(enough, enough, enough, n).reason;
    EXPECT_EQ(testing::field<std::size_t>(found(slow, enough, enough, n).reason, ReasonField::move),
              1U);
    EXPECT_EQ(testing::field<std::size_t>(found(enough, slow, enough, n).reason, ReasonField::move),
              2U);
    EXPECT_EQ(testing::field<std::size_t>(found(enough, enough, slow, n).reason, ReasonField::move),
              3U);
  }
}

}  // namespace
}  // namespace beeline
