#include <beeline/planning/program.h>

#include <tests/planning/motion_promises.h>

namespace beeline {
namespace {

using namespace testing;

/// A pose near `pose`: a step of up to `size` metres and a small rotation.
Pose near(Random& random, const Pose& pose, double size, bool planar) {
  Vector3 step = size * random.uniform(0.4, 1) * random.direction();
  Vector3 turn = random.uniform(0.05, 0.2) * random.direction();
  if (planar) {
    step = size * random.uniform(0.4, 1) * Vector3(random.uniform(-1, 1), 1, 0).normalized();
    turn = {0, 0, random.uniform(-0.3, 0.3)};
  }
  return make_pose(pose.translation() + step, so3_exp(turn) * pose.linear());
}

/// A program of joint moves, lines, blends, arcs, screws and splines near random configurations.
Program random_program(Random& random, const Arm& arm) {
  Program program;
  const double size = 0.03 * arm.reach().radius;
  Pose from = Pose::Identity();
  for (int part = 0; part < 3; ++part) {
    const Configuration middle = middle_configuration(arm);
    const Configuration q = middle + 0.4 * (random.configuration(arm) - middle);
    Move joint{.kind = MoveKind::joint};
    if (random.integer(0, 1) == 0) joint.q = q;
    joint.target = from = forward_kinematics(arm, q);
    if (random.integer(0, 2) == 0) joint.dwell = random.uniform(0.01, 0.2);
    program.moves.push_back(joint);
    for (int i = random.integer(0, 3); i > 0; --i) {
      Move move{.kind = static_cast<MoveKind>(random.integer(1, 4))};
      move.target = near(random, from, size, arm.planar());
      if (move.kind == MoveKind::arc) {
        move.via = near(random, from, size, arm.planar()).translation();
      }
      if (random.integer(0, 2) == 0) move.dwell = random.uniform(0.01, 0.2);
      if (random.integer(0, 2) == 0) move.speed = random.uniform(0.05, 0.5) * arm.reach().radius;
      program.moves.push_back(move);
      from = move.target;
    }
  }
  for (std::size_t i = 0; i + 1 < program.moves.size(); ++i) {
    const bool lines =
        program.moves[i].kind == MoveKind::line && program.moves[i + 1].kind == MoveKind::line;
    if (lines && program.moves[i].dwell == 0) program.moves[i].blend = 0.1 * size;
  }
  return program;
}

/// The state of the motion at time t.
Configuration at_time(const Trajectory& motion, double t) {
  const auto next = std::upper_bound(motion.times.begin() + 1, motion.times.end() - 1, t);
  const auto k = static_cast<std::size_t>(next - motion.times.begin()) - 1;
  return motion_between(motion, k, (t - motion.times[k]) / (motion.times[k + 1] - motion.times[k]));
}

bool stops_after(const Program& program, std::size_t i) {
  const Move& move = program.moves[i];
  if (i + 1 == program.moves.size()) return true;
  const bool spline =
      move.kind == MoveKind::spline && program.moves[i + 1].kind == MoveKind::spline;
  return move.blend == 0 && !(spline && move.dwell == 0);
}

/// Checks waypoints, stops, dwells, lines and tool speeds from outside.
void expect_program(const Arm& arm, const Program& program, const ProgramMotion& motion,
                    double rate) {
  const Trajectory& trajectory = motion.trajectory;
  const auto& t = trajectory.times;
  ASSERT_NO_THROW(check_trajectory(trajectory));
  expect_within_limits(arm, trajectory);
  ASSERT_EQ(motion.moves.size(), program.moves.size());
  EXPECT_EQ(motion.moves.front().begin, 0);
  for (std::size_t i = 0; i < program.moves.size(); ++i) {
    const Move& move = program.moves[i];
    const auto [begin, end, bound, speed, radius] = motion.moves[i];
    SCOPED_TRACE(move_name(program, i));
    const Pose tool = forward_kinematics(arm, trajectory.positions[end]);
    if (stops_after(program, i) || (move.blend == 0 && rate == 0)) {
      const Pose goal = move.q ? forward_kinematics(arm, *move.q) : move.target;
      EXPECT_LE(pose_difference(goal, tool).norm(), 1e-5 * arm.reach().radius);
    }
    if (move.q) {
      EXPECT_LE((trajectory.positions[end] - *move.q).norm(), 1e-12);
    }
    const std::size_t next = i + 1 < motion.moves.size() ? motion.moves[i + 1].begin : t.size() - 1;
    if (stops_after(program, i)) {
      EXPECT_TRUE(trajectory.velocities[end].isZero(0));
    }
    const double rested = t[next] - t[end];
    EXPECT_GE(rested, move.dwell - 2e-9);
    EXPECT_LE(rested, move.dwell + (rate > 0 && move.dwell > 0 ? 1 / rate : 0) + 2e-9);
    for (double u : {0.1, 0.5, 0.9}) {
      if (!(rested > 0)) break;
      const Configuration q = at_time(trajectory, t[end] + u * rested);
      EXPECT_LE((q - trajectory.positions[end]).norm(), 1e-12) << "at rest";
    }
    if (rate > 0 && move.dwell > 0) {
      EXPECT_EQ(next - end, std::lround(rested * rate));
    }
    constexpr int parts = 200;
    Configuration before = trajectory.positions[begin];
    const Pose from = forward_kinematics(arm, before);
    const Line line{from, tool};
    for (int k = 1; k <= parts && t[end] > t[begin]; ++k) {
      const double dt = (t[end] - t[begin]) / parts;
      const Configuration q = at_time(trajectory, t[begin] + k * dt);
      const Vector3 step =
          forward_kinematics(arm, q).translation() - forward_kinematics(arm, before).translation();
      EXPECT_LE(step.norm() / dt, speed * (1 + 1e-6) + 1e-9);
      if (move.speed) {
        EXPECT_LE(step.norm() / dt, *move.speed * (1 + 1e-6));
      }
      if (move.kind == MoveKind::joint) {  // straight in joint space
        const Configuration whole = trajectory.positions[end] - trajectory.positions[begin];
        const Configuration moved = q - trajectory.positions[begin];
        EXPECT_LE((moved - whole * (moved.dot(whole) / whole.squaredNorm())).norm(), 1e-6);
      }
      const bool straight = move.kind == MoveKind::line && move.blend == 0 &&
                            (i == 0 || program.moves[i - 1].blend == 0);
      if (straight) {
        const Deviation off = off_segment(line, forward_kinematics(arm, q));
        EXPECT_LE(off.position, bound.position + 1e-9);
        EXPECT_LE(off.orientation, bound.orientation + 1e-9);
      }
      before = q;
    }
  }
  EXPECT_LE(motion.deviation.bound.position, 1e-4);
  EXPECT_LE(motion.deviation.bound.orientation, 1e-4);
  for (std::size_t k = 0; rate > 0 && k < t.size(); ++k) {
    ASSERT_EQ(t[k], std::round(double(k) / rate * 1e9) / 1e9);
  }
}

TEST(MoveProgram, KeepsItsPromisesOnRandomPrograms) {
  Random random;
  int reached = 0, tried = 0;
  for (const char* name : {"rrr", "ur5", "panda", "puma560"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < cases(8); ++i) {
      const Program program = random_program(random, arm);
      const double rate = random.integer(0, 1) == 0 ? 0 : 250;
      ProgramMotion motion;
      try {
        motion = move_program(arm, std::nullopt, program, {.rate = rate});
      } catch (const Error& error) {
        if (std::string(error.what()).find("speed or blend") != std::string::npos) continue;
        if (std::string(error.what()).find("three positions") != std::string::npos) continue;
        FAIL() << error.what();
      }
      ++tried;
      if (!motion) {
        EXPECT_LT(motion.failed, program.moves.size()) << motion.reason;
        EXPECT_NE(motion.reason.find("move"), std::string::npos) << motion.reason;
        continue;
      }
      ++reached;
      SCOPED_TRACE(std::string(name) + ", program " + std::to_string(i));
      expect_program(arm, program, motion, rate);
      const Verification check = verify(arm, motion.trajectory, program);
      EXPECT_TRUE(check) << check.reason;
      ASSERT_EQ(check.arrivals.size(), program.moves.size());
      for (std::size_t m = 0; m < program.moves.size(); ++m) {
        if (stops_after(program, m)) {
          const auto& positions = motion.trajectory.positions;
          EXPECT_LE((positions[check.arrivals[m]] - positions[motion.moves[m].end]).norm(), 1e-4);
        }
      }
      if (::testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GE(reached, tried / 3);
  std::cout << reached << " of " << tried << " programs are possible\n";
}

}  // namespace
}  // namespace beeline
