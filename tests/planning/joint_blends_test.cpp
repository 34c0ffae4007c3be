#include <thread>

#include <beeline/planning/program.h>

#include <tests/planning/gantry.h>
#include <tests/planning/motion_promises.h>
#include <tests/planning/pick.h>
#include <tests/reason.h>

namespace beeline {
namespace {

using namespace testing;

/// Joint moves and lines in random order, each of which blends into the next, from a configuration
/// near the middle of the limits.
Program random_chain(Random& random, const Arm& arm, Configuration& start) {
  const Configuration middle = middle_configuration(arm);
  const auto near_middle = [&] {
    return Configuration(middle + 0.4 * (random.configuration(arm) - middle));
  };
  const double size = 0.08 * arm.reach().radius;
  start = near_middle();
  Pose from = forward_kinematics(arm, start);
  Program program;
  for (int i = random.integer(2, 5); i > 0; --i) {
    Move move{.kind = random.integer(0, 1) == 0 ? MoveKind::joint : MoveKind::line};
    if (move.kind == MoveKind::joint) {
      const Configuration q = near_middle();
      if (random.integer(0, 1) == 0) move.q = q;
      move.target = forward_kinematics(arm, q);
    } else {
      const Vector3 turn = arm.planar() ? Vector3(0, 0, random.uniform(-0.2, 0.2))
                                        : Vector3(random.uniform(0, 0.3) * random.direction());
      Vector3 step = size * random.uniform(0.5, 1) * random.direction();
      if (arm.planar()) step.z() = 0;
      move.target = make_pose(from.translation() + step, so3_exp(turn) * from.linear());
    }
    if (random.integer(0, 3) == 0) move.speed = random.uniform(0.1, 0.6) * arm.reach().radius;
    move.blend = random.integer(0, 4) == 0 ? 0 : size * random.uniform(0.05, 0.6);
    from = move.target;
    program.moves.push_back(move);
  }
  program.moves.back().blend = 0;
  return program;
}

bool is_joint_blend(const Program& program, std::size_t i) {
  const auto& moves = program.moves;
  return moves[i].blend > 0 &&
         (moves[i].kind == MoveKind::joint || moves[i + 1].kind == MoveKind::joint);
}

/// Derivatives of a joint between two samples, of the quintic polynomial with their values.
struct Derivatives {
  double velocity = 0, acceleration = 0, jerk = 0;
};
Derivatives derivatives(const Trajectory& motion, std::size_t k, int joint, double u) {
  const double h = motion.times[k + 1] - motion.times[k];
  const auto at = [&](const std::vector<Configuration>& column, std::size_t i) {
    return column[i][joint];
  };
  const double d = at(motion.positions, k + 1) - at(motion.positions, k);
  const double v = h * at(motion.velocities, k), w = h * at(motion.velocities, k + 1);
  const double a = h * h * at(motion.accelerations, k), b = h * h * at(motion.accelerations, k + 1);
  const double c3 = 10 * d - 6 * v - 4 * w - 1.5 * a + 0.5 * b;
  const double c4 = -15 * d + 8 * v + 7 * w + 1.5 * a - b;
  const double c5 = 6 * d - 3 * v - 3 * w - 0.5 * a + 0.5 * b;
  return {(v + u * (a + u * (3 * c3 + u * (4 * c4 + u * 5 * c5)))) / h,
          (a + u * (6 * c3 + u * (12 * c4 + u * 20 * c5))) / (h * h),
          (6 * c3 + u * (24 * c4 + u * 60 * c5)) / (h * h * h)};
}

/// Checks velocities, accelerations and jerks at a thousand times of each section, and the
/// positions and velocities on both sides of each sample.
void expect_all_limits(const Arm& arm, const Trajectory& motion) {
  const std::size_t intervals = motion.size() - 1;
  const int times = std::max<int>(4, static_cast<int>(1000 / std::max<std::size_t>(intervals, 1)));
  for (std::size_t k = 0; k < intervals; ++k) {
    for (int joint = 0; joint < arm.dof(); ++joint) {
      const Limits most = motion_limits(arm.limits(joint));
      for (int i = 0; i <= times; ++i) {
        const Derivatives at = derivatives(motion, k, joint, double(i) / times);
        ASSERT_LE(std::abs(at.velocity), most.velocity * (1 + 1e-6)) << k;
        ASSERT_LE(std::abs(at.acceleration), most.acceleration * (1 + 1e-6)) << k;
        ASSERT_LE(std::abs(at.jerk), most.jerk * (1 + 1e-5)) << k;
      }
      ASSERT_NEAR(derivatives(motion, k, joint, 1).velocity, motion.velocities[k + 1][joint],
                  1e-6 * most.velocity);
    }
  }
}

/// Checks that a blend passes near its waypoint, without a rest, and is near the lines beside it.
void expect_blend(const Arm& arm, const Program& program, const ProgramMotion& motion,
                  std::size_t i, const Pose& from) {
  const PlannedBlend& blend = motion.moves[i].joint_blend;
  const Move &move = program.moves[i], &next = program.moves[i + 1];
  if (blend.radius == 0) {
    EXPECT_TRUE(blend.reason) << "a stop without a reason";
    return;
  }
  const Pose waypoint = move.q ? forward_kinematics(arm, *move.q) : move.target;
  ASSERT_LT(blend.begin, blend.end);
  double slowest = Limits::none, nearest = Limits::none, off = 0;
  for (std::size_t k = blend.begin; k < blend.end; ++k) {
    for (const double u : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const Pose tool = forward_kinematics(arm, motion_between(motion.trajectory, k, u));
      nearest = std::min(nearest, (tool.translation() - waypoint.translation()).norm());
      const bool after = k >= motion.moves[i].end;
      if (move.kind == MoveKind::line && !after) {
        off = std::max(off, off_segment({from, waypoint}, tool).position);
      }
      double fastest = 0;
      for (int joint = 0; joint < arm.dof(); ++joint) {
        const double speed = derivatives(motion.trajectory, k, joint, u).velocity;
        fastest = std::max(fastest, std::abs(speed));
      }
      slowest = std::min(slowest, fastest);
    }
  }
  EXPECT_GT(slowest, 0);
  EXPECT_LE(nearest, move.blend);
  EXPECT_LE(off, blend.bound.position + 1e-4);
  EXPECT_LE(blend.bound.position, move.blend);
  EXPECT_LE(blend.bound.orientation, 5 * move.blend + 1e-12);
  const bool joints = move.kind == MoveKind::joint && next.kind == MoveKind::joint;
  if (joints) {
    EXPECT_EQ(blend.bound.position, 0);
  }
}

/// Checks that a line is straight except in the blends at its ends.
void expect_line(const Arm& arm, const Program& program, const ProgramMotion& motion, std::size_t i,
                 const Pose& from) {
  const PlannedMove& planned = motion.moves[i];
  const auto blends = [&](std::size_t k) { return motion.moves[k].joint_blend.radius > 0; };
  const std::size_t begin =
      i > 0 && blends(i - 1) ? motion.moves[i - 1].joint_blend.end : planned.begin;
  const std::size_t end = blends(i) ? planned.joint_blend.begin : planned.end;
  const Line line{from, program.moves[i].target};
  ASSERT_LT(begin, end) << "no part of the line is left";
  for (std::size_t k = begin; k < end; ++k) {
    for (const double u : {0.0, 0.3, 0.5, 0.8, 1.0}) {
      const Pose tool = forward_kinematics(arm, motion_between(motion.trajectory, k, u));
      const Deviation off = off_segment(line, tool);
      ASSERT_LE(off.position, 1e-4) << "sample " << k << " of " << begin << " to " << end;
      ASSERT_LE(off.orientation, 1e-4);
    }
  }
}

/// The program with stops in place of blends with joint moves.
Program with_stops(const Program& program) {
  Program stopping = program;
  for (std::size_t i = 0; i < program.moves.size(); ++i) {
    if (is_joint_blend(program, i)) stopping.moves[i].blend = 0;
  }
  return stopping;
}

TEST(JointBlends, KeepWhatTheyPromiseOnRandomPrograms) {
  Random random;
  int blended = 0, asked = 0, reached = 0;
  double blended_duration = 0, stopped_duration = 0;
  for (const char* name : {"panda", "ur5", "puma560", "rrr"}) {
    const Arm arm = built_in(name);
    for (int n = 0; n < cases(12); ++n) {
      Configuration start;
      const Program program = random_chain(random, arm, start);
      const PathMotionOptions options{.rate = random.integer(0, 2) == 0 ? 250.0 : 0.0};
      SCOPED_TRACE(std::string(name) + ", program " + std::to_string(n) + " at " +
                   number(options.rate));
      const ProgramMotion stopping = move_program(arm, start, with_stops(program), options);
      const ProgramMotion motion = move_program(arm, start, program, options);
      if (!stopping) continue;
      ASSERT_TRUE(motion) << motion.reason;
      ++reached;
      ASSERT_NO_THROW(check_trajectory(motion.trajectory));
      expect_within_limits(arm, motion.trajectory);
      expect_all_limits(arm, motion.trajectory);
      const Verification check = verify(arm, motion.trajectory, program);
      EXPECT_TRUE(check) << check.reason;
      EXPECT_TRUE(verify(arm, stopping.trajectory, program)) << "a stop in place of a blend";
      Pose from = forward_kinematics(arm, start);
      bool all_stop = true;
      for (std::size_t i = 0; i < program.moves.size(); ++i) {
        SCOPED_TRACE(move_name(program, i));
        const bool blends = program.moves[i].kind == MoveKind::line && program.moves[i].blend > 0 &&
                            program.moves[i + 1].kind == MoveKind::line;
        const bool after_blend = i > 0 && program.moves[i].kind == MoveKind::line &&
                                 program.moves[i - 1].kind == MoveKind::line &&
                                 program.moves[i - 1].blend > 0;
        if (is_joint_blend(program, i)) {
          ++asked;
          expect_blend(arm, program, motion, i, from);
          if (motion.moves[i].joint_blend.radius > 0) ++blended, all_stop = false;
        } else {
          EXPECT_EQ(motion.moves[i].joint_blend.radius, 0);
          EXPECT_FALSE(motion.moves[i].joint_blend.reason);
        }
        if (program.moves[i].kind == MoveKind::line && !blends && !after_blend) {
          expect_line(arm, program, motion, i, from);
        }
        from = program.moves[i].q ? forward_kinematics(arm, *program.moves[i].q)
                                  : program.moves[i].target;
      }
      if (::testing::Test::HasFailure()) return;
      if (all_stop) continue;
      blended_duration += motion.duration();
      stopped_duration += stopping.duration();
    }
  }
  EXPECT_GT(reached, 0);
  EXPECT_GT(blended, asked / 2);
  EXPECT_LT(blended_duration, stopped_duration);
  std::cout << blended << " of " << asked << " blends, " << blended_duration << " s in place of "
            << stopped_duration << " s\n";
}

TEST(JointBlends, ProgramsWithoutThemAreAsWithStops) {
  Random random;
  const Arm arm = built_in("panda");
  for (int n = 0; n < cases(6); ++n) {
    Configuration start;
    Program program = random_chain(random, arm, start);
    for (Move& move : program.moves) {
      if (move.blend > 0) move.blend = 1e-5;
    }
    for (std::size_t i = 0; i + 1 < program.moves.size(); ++i) {  // lines need larger ones
      if (!is_joint_blend(program, i)) program.moves[i].blend = 0;
    }
    const ProgramMotion motion = move_program(arm, start, program);
    const ProgramMotion stopping = move_program(arm, start, with_stops(program));
    ASSERT_EQ(motion.trajectory.times, stopping.trajectory.times);
    ASSERT_EQ(motion.trajectory.positions, stopping.trajectory.positions);
    for (std::size_t i = 0; i < motion.moves.size(); ++i) {
      EXPECT_EQ(motion.moves[i].end, stopping.moves[i].end);
      EXPECT_EQ(bool(motion.moves[i].joint_blend.reason), is_joint_blend(program, i));
    }
  }
}

TEST(JointBlends, AreTheSameInAnyThread) {
  Random random;
  const Arm arm = built_in("ur5");
  std::vector<Program> programs;
  std::vector<Configuration> starts;
  for (int n = 0; n < 4; ++n) {
    starts.emplace_back();
    programs.push_back(random_chain(random, arm, starts.back()));
  }
  std::vector<ProgramMotion> one(4), other(4);
  for (std::size_t n = 0; n < 4; ++n) one[n] = move_program(arm, starts[n], programs[n]);
  std::vector<std::thread> threads;
  for (std::size_t n = 0; n < 4; ++n) {
    threads.emplace_back([&, n] { other[n] = move_program(arm, starts[n], programs[n]); });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_EQ(one[n].trajectory.times, other[n].trajectory.times);
    EXPECT_EQ(one[n].trajectory.positions, other[n].trajectory.positions);
  }
}

/// Up, to the side above the wall, and down to the part's height behind it.
Program over_the_corner(double blend) {
  Program program;
  program.moves = {joint_move(Configuration{{0, 0, 0.8}}), joint_move(Configuration{{1, 0, 0.8}}),
                   joint_move(Configuration{{1, 0, 0.3}})};
  program.moves[0].blend = program.moves[1].blend = blend;
  return program;
}

TEST(JointBlends, AreSmallerWhereTheyWouldCollide) {
  Gantry gantry;
  const Configuration start{{0, 0, 0.3}};
  const Program program = over_the_corner(0.4);
  const ProgramMotion free = move_program(gantry.arm, start, program);
  ASSERT_TRUE(free) << free.reason;
  for (std::size_t i : {0, 1}) {
    EXPECT_GT(free.moves[i].joint_blend.radius, 0.2) << i;
    EXPECT_FALSE(free.moves[i].joint_blend.reason) << free.moves[i].joint_blend.reason;
  }
  // In the corner below the first waypoint, beside the gripper's way up.
  gantry.scene.obstacles.push_back(box("block", {0.16, 0, 0.69}, {0.2, 0.2, 0.2}));
  const CollisionModel model = gantry.model();
  const ProgramMotion motion = move_program(gantry.arm, start, program, {}, &model);
  ASSERT_TRUE(motion) << motion.reason;
  std::vector<std::size_t> arrivals;
  for (const PlannedMove& move : motion.moves) arrivals.push_back(move.end);
  EXPECT_TRUE(prove_clearance(model, motion.trajectory, program, arrivals));
  EXPECT_FALSE(prove_clearance(model, free.trajectory, program, arrivals));
  EXPECT_LT(motion.moves[0].joint_blend.radius, free.moves[0].joint_blend.radius);
  EXPECT_EQ(motion.moves[0].joint_blend.reason.code, ReasonCode::blend_smaller);
  ASSERT_EQ(motion.moves[0].joint_blend.reason.details.size(), 1U);
  EXPECT_TRUE(motion.moves[0].joint_blend.reason.details[0].has(ReasonField::body))
      << motion.moves[0].joint_blend.reason;
  EXPECT_EQ(motion.moves[1].joint_blend.radius, free.moves[1].joint_blend.radius);
}

TEST(JointBlends, StopWhereThePathTurnsBack) {
  const Gantry gantry;
  Program program;
  program.moves = {joint_move(Configuration{{0.5, 0, 1}}), joint_move(Configuration{{0, 0, 1}})};
  program.moves[0].blend = 0.1;
  const ProgramMotion motion = move_program(gantry.arm, gantry.above, program);
  ASSERT_TRUE(motion) << motion.reason;
  EXPECT_EQ(motion.moves[0].joint_blend.radius, 0);
  EXPECT_EQ(motion.moves[0].joint_blend.reason.code, ReasonCode::blend_turns_back);
}

TEST(JointBlends, AreRefusedByVerifyWhereTheToolIsElsewhere) {
  const Arm arm = built_in("panda");
  Program program = pick();
  program.moves[0].blend = 0.04;
  const ProgramMotion motion = move_program(arm, home, program);
  ASSERT_TRUE(motion) << motion.reason;
  ASSERT_GT(motion.moves[0].joint_blend.radius, 0);
  EXPECT_TRUE(verify(arm, motion.trajectory, program));
  const Verification passed = verify(arm, motion.trajectory, program);
  ASSERT_EQ(passed.passed.size(), 1U);
  EXPECT_EQ(passed.passed[0].move, 0U);
  EXPECT_LE(passed.passed[0].bound.position, 0.04);
  Program tighter = program;
  tighter.moves[0].blend = 0.5 * passed.passed[0].bound.position;
  EXPECT_FALSE(verify(arm, motion.trajectory, tighter)) << "too far from the line";
  EXPECT_FALSE(verify(arm, motion.trajectory, with_stops(program))) << "no stop";
  Program aside = program;
  aside.moves[0].target.translation().x() += 0.2;
  EXPECT_FALSE(verify(arm, motion.trajectory, aside)) << "another waypoint";
}

}  // namespace
}  // namespace beeline
