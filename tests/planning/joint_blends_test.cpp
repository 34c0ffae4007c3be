#include <tests/planning/joint_blend_promises.h>

namespace beeline {
namespace {

using namespace testing;

/// Joint moves through random configurations, as joint values or as poses.
Program random_joint_moves(Random& random, const Arm& arm, int count) {
  Program program;
  for (int i = 0; i < count; ++i) {
    Move move{.kind = MoveKind::joint};
    const Configuration q = near_middle(random, arm, 0.5);
    move.target = forward_kinematics(arm, q);
    if (random.integer(0, 3) > 0) move.q = q;
    if (i + 1 < count && random.integer(0, 5) > 0) {
      move.blend = random.uniform(0.005, 0.1) * arm.reach().radius;
    }
    if (random.integer(0, 3) == 0) move.speed = random.uniform(0.2, 1) * arm.reach().radius;
    program.moves.push_back(move);
  }
  return program;
}

TEST(JointBlends, PassWaypointsWithoutAStop) {
  Random random;
  int blends = 0, programs = 0, quicker = 0;
  for (const std::string name : {"rrr", "panda", "ur5", "scara", "puma560", "stanford"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < cases(5); ++i) {
      SCOPED_TRACE(name + " " + std::to_string(i));
      const Program program = random_joint_moves(random, arm, random.integer(2, 9));
      PathMotionOptions options;
      if (random.integer(0, 2) == 0) options.rate = 250;
      const Configuration start = near_middle(random, arm, 0.5);
      const ProgramMotion motion = move_program(arm, start, program, options);
      const ProgramMotion stops = move_program(arm, start, with_stops(program), options);
      ASSERT_TRUE(stops) << stops;
      ASSERT_TRUE(motion) << motion;
      ++programs;
      EXPECT_LE(motion.duration(), stops.duration());
      quicker += motion.duration() < stops.duration();
      expect_blended(arm, forward_kinematics(arm, start), program, motion);
      expect_proved(arm, program, motion);
      blends += blend_count(motion);
    }
  }
  EXPECT_GE(blends, programs);
  EXPECT_GE(2 * quicker, programs);
}

/// Joint moves and lines in turn, near random configurations; some waypoints repeat.
Program random_mixed_moves(Random& random, const Arm& arm, const Configuration& start, int count) {
  Program program;
  Configuration q = start;
  Pose from = forward_kinematics(arm, start);
  const double size = 0.1 * arm.reach().radius;
  for (int i = 0; i < count; ++i) {
    Move move;
    const bool after_line = i > 0 && program.moves.back().kind == MoveKind::line;
    if (random.integer(0, 3) < (after_line ? 3 : 1)) {
      move.kind = MoveKind::joint;
      q = near_middle(random, arm, 0.3);
      if (random.integer(0, 1) == 0) move.q = q;
      move.target = forward_kinematics(arm, q);
    } else {
      Vector3 step = size * random.uniform(0.4, 1) * random.direction();
      Vector3 turn = random.uniform(0, 0.2) * random.direction();
      if (arm.planar()) {
        step.z() = 0;
        turn = {0, 0, turn.z()};
      }
      move.target = make_pose(from.translation() + step, so3_exp(turn) * from.linear());
    }
    if (move.kind == MoveKind::line && random.integer(0, 9) == 0) move.target = from;
    if (i + 1 < count && random.integer(0, 3) > 0) {
      move.blend = random.uniform(0.005, 0.06) * arm.reach().radius;
    } else if (random.integer(0, 1) == 0) {
      move.dwell = 0.1;
    }
    if (random.integer(0, 3) == 0) move.speed = random.uniform(0.2, 1) * arm.reach().radius;
    program.moves.push_back(move);
    from = move.q ? forward_kinematics(arm, *move.q) : move.target;
  }
  return program;
}

bool has_blend_of_lines(const Program& program) {
  for (std::size_t i = 0; i < program.moves.size(); ++i) {
    if (program.moves[i].blend > 0 && !blends_with_joint_move(program, i)) return true;
  }
  return false;
}

TEST(JointBlends, PassBetweenLinesAndJointMoves) {
  Random random;
  int blends = 0, with_lines = 0, programs = 0;
  for (const std::string name : {"rrr", "panda", "ur5", "scara", "puma560", "iiwa14"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < cases(20); ++i) {
      SCOPED_TRACE(name + " " + std::to_string(i));
      const Configuration start = near_middle(random, arm, 0.3);
      const Program program = random_mixed_moves(random, arm, start, random.integer(2, 6));
      PathMotionOptions options;
      if (random.integer(0, 2) == 0) options.rate = 250;
      const ProgramMotion stops = move_program(arm, start, with_stops(program), options);
      if (!stops) continue;
      const ProgramMotion motion = move_program(arm, start, program, options);
      if (!motion && has_blend_of_lines(program)) continue;  // these may not be possible
      ASSERT_TRUE(motion) << motion;
      ++programs;
      if (!has_blend_of_lines(program)) {
        EXPECT_LE(motion.duration(), stops.duration());
      }
      expect_blended(arm, forward_kinematics(arm, start), program, motion);
      expect_proved(arm, program, motion);
      for (std::size_t k = 0; k + 1 < program.moves.size(); ++k) {
        if (motion.moves[k].joint_blend_radius == 0) continue;
        ++blends;
        with_lines +=
            program.moves[k].kind == MoveKind::line || program.moves[k + 1].kind == MoveKind::line;
      }
    }
  }
  EXPECT_GE(blends, cases(15));
  EXPECT_GE(with_lines, cases(9));
}

}  // namespace
}  // namespace beeline
