#include <sstream>

#include <beeline/planning/program.h>

#include <tests/planning/dense_search.h>
#include <tests/planning/motion_promises.h>
#include <tests/planning/pick.h>
#include <tests/reason.h>

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
      Move move{.kind = static_cast<MoveKind>(random.integer(2, 5))};
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

/// Checks a move between its waypoints: tool speed, and straightness where it is straight.
void expect_move(const Arm& arm, const Program& program, const ProgramMotion& motion,
                 std::size_t i) {
  constexpr int parts = 200;
  const Trajectory& trajectory = motion.trajectory;
  const Move& move = program.moves[i];
  const auto [begin, end, bound, speed] = [](const PlannedMove& planned) {
    return std::tuple(planned.begin, planned.end, planned.bound, planned.tool_speed);
  }(motion.moves[i]);
  const double start = trajectory.times[begin], dt = (trajectory.times[end] - start) / parts;
  Configuration before = trajectory.positions[begin];
  const Line line{forward_kinematics(arm, before),
                  forward_kinematics(arm, trajectory.positions[end])};
  const Configuration whole = trajectory.positions[end] - trajectory.positions[begin];
  for (int k = 1; k <= parts && dt > 0; ++k) {
    const Configuration q = at_time(trajectory, start + k * dt);
    const Pose tool = forward_kinematics(arm, q);
    const Vector3 step = tool.translation() - forward_kinematics(arm, before).translation();
    ASSERT_LE(step.norm() / dt, speed * (1 + 1e-6) + 1e-9);
    ASSERT_LE(step.norm() / dt, move.speed.value_or(Limits::none) * (1 + 1e-6));
    if (move.kind == MoveKind::joint) {  // straight in joint space
      const Configuration moved = q - trajectory.positions[begin];
      ASSERT_LE((moved - whole * (moved.dot(whole) / whole.squaredNorm())).norm(), 1e-6);
    }
    const bool straight = move.kind == MoveKind::line && move.blend == 0 &&
                          (i == 0 || program.moves[i - 1].blend == 0);
    if (straight) {
      const Deviation off = off_segment(line, tool);
      ASSERT_LE(off.position, bound.position + 1e-9);
      ASSERT_LE(off.orientation, bound.orientation + 1e-9);
    }
    before = q;
  }
}

/// Checks that the arm rests for the dwell after move i.
void expect_dwell(const Program& program, const ProgramMotion& motion, std::size_t i, double rate) {
  const Trajectory& trajectory = motion.trajectory;
  const double dwell = program.moves[i].dwell;
  const std::size_t end = motion.moves[i].end;
  const std::size_t next =
      i + 1 < motion.moves.size() ? motion.moves[i + 1].begin : trajectory.size() - 1;
  const double rested = trajectory.times[next] - trajectory.times[end];
  EXPECT_GE(rested, dwell - 2e-9);
  EXPECT_LE(rested, dwell + (rate > 0 && dwell > 0 ? 1 / rate : 0) + 2e-9);
  if (rate > 0) {
    EXPECT_EQ(next - end, std::lround(rested * rate)) << "a sample at every period";
  }
  for (const double u : {0.1, 0.5, 0.9}) {
    if (next == end) break;
    const Configuration q = at_time(trajectory, trajectory.times[end] + u * rested);
    EXPECT_LE((q - trajectory.positions[end]).norm(), 1e-12) << "at rest";
  }
}

/// Checks waypoints, stops, dwells, lines and tool speeds from outside.
void expect_program(const Arm& arm, const Program& program, const ProgramMotion& motion,
                    double rate) {
  const Trajectory& trajectory = motion.trajectory;
  ASSERT_NO_THROW(check_trajectory(trajectory));
  expect_within_limits(arm, trajectory);
  ASSERT_EQ(motion.moves.size(), program.moves.size());
  EXPECT_EQ(motion.moves.front().begin, 0);
  for (std::size_t i = 0; i < program.moves.size(); ++i) {
    const Move& move = program.moves[i];
    const std::size_t end = motion.moves[i].end;
    SCOPED_TRACE(move_name(program, i));
    if (stops_after(program, i) || (move.blend == 0 && rate == 0)) {
      const Pose tool = forward_kinematics(arm, trajectory.positions[end]);
      const Pose goal = move.q ? forward_kinematics(arm, *move.q) : move.target;
      EXPECT_LE(pose_difference(goal, tool).norm(), 1e-5 * arm.reach().radius);
    }
    if (move.q) {
      EXPECT_LE((trajectory.positions[end] - *move.q).norm(), 1e-12);
    }
    if (stops_after(program, i)) {
      EXPECT_TRUE(trajectory.velocities[end].isZero(0)) << trajectory.velocities[end].transpose();
    }
    expect_dwell(program, motion, i, rate);
    expect_move(arm, program, motion, i);
  }
  EXPECT_LE(motion.deviation.bound.position, 1e-4);
  EXPECT_LE(motion.deviation.bound.orientation, 1e-4);
  for (std::size_t k = 0; rate > 0 && k < trajectory.size(); ++k) {
    ASSERT_EQ(trajectory.times[k], std::round(double(k) / rate * 1e9) / 1e9);
  }
}

/// Plans the program, checks the motion from outside, and has it verified; returns whether there is
/// one.
bool is_kept(const Arm& arm, const Program& program, const PathMotionOptions& options) {
  const ProgramMotion motion = move_program(arm, std::nullopt, program, options);
  if (!motion) {
    EXPECT_LT(motion.failed, program.moves.size()) << motion.reason;
    EXPECT_EQ(testing::field<std::size_t>(motion.reason, ReasonField::move), motion.failed + 1)
        << motion.reason;
    return false;
  }
  const bool quintic = options.interpolation == Interpolation::quintic;
  if (quintic) expect_program(arm, program, motion, options.rate);
  const Verification check = verify(arm, motion.trajectory, program);
  EXPECT_TRUE(check) << check.reason;
  EXPECT_EQ(check.arrivals.size(), program.moves.size());
  for (std::size_t m = 0; m < check.arrivals.size(); ++m) {
    if (!stops_after(program, m)) continue;
    const auto& positions = motion.trajectory.positions;
    EXPECT_LE((positions[check.arrivals[m]] - positions[motion.moves[m].end]).norm(), 1e-4);
  }
  return true;
}

TEST(MoveProgram, KeepsItsPromisesOnRandomPrograms) {
  Random random;
  int reached = 0, tried = 0;
  for (const char* arm_name : {"rrr", "ur5", "panda", "puma560"}) {
    const Arm arm = built_in(arm_name);
    for (int i = 0; i < cases(8); ++i) {
      const Program program = random_program(random, arm);
      PathMotionOptions options{.rate = random.integer(0, 1) == 0 ? 0.0 : 250.0};
      if (random.integer(0, 2) == 0) options.profile = static_cast<Profile>(random.integer(0, 4));
      if (random.integer(0, 2) == 0) {
        options.interpolation = static_cast<Interpolation>(random.integer(0, 2));
        options.tolerance = options.orientation_tolerance = 1e-4;
      }
      SCOPED_TRACE(std::string(arm_name) + ", program " + std::to_string(i) + ", " +
                   name(options.interpolation) + " " +
                   name(options.profile.value_or(default_profile)) + " at " + number(options.rate));
      try {
        reached += is_kept(arm, program, options) ? 1 : 0;
        ++tried;
      } catch (const Error& error) {
        const std::string refused = error.what();
        const bool expected = refused.find("speed or blend") != std::string::npos ||
                              refused.find("three positions") != std::string::npos ||
                              refused.find("samples per second") != std::string::npos;
        EXPECT_TRUE(expected) << refused;
      }
      if (::testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GE(reached, tried / 3);
  std::cout << reached << " of " << tried << " programs are possible\n";
}

TEST(MoveProgram, ChoosesTheBranchThatTheNextMovesNeed) {
  const Arm arm = built_in("ur5");
  Random random;
  int changed = 0, tried = 0;
  for (int i = 0; i < cases(40); ++i) {
    const Line line = random_certified_line(random, arm);
    Program program;
    program.moves = {{.kind = MoveKind::joint, .target = line.from}, {.target = line.to}};
    const Configuration start = random.configuration(arm);
    const ProgramMotion motion = move_program(arm, start, program);
    const PathMotion best = move_in_lines(arm, {line.from, line.to});
    ASSERT_EQ(bool(motion), bool(best)) << motion.reason << " / " << best.reason;
    if (!motion) continue;
    ++tried;
    // Solutions that are reached sooner do not allow the line.
    const Configuration chosen = motion.trajectory.positions[motion.moves[0].end];
    const auto distance = [&](const Configuration& q) {
      return ((q - start).array().abs() / assumed_velocity_limit).maxCoeff();
    };
    for (const Configuration& q :
         inverse_kinematics(arm, line.from, {.seed = start, .all = true, .every_turn = true})
             .solutions) {
      if (distance(q) >= distance(chosen) - 1e-9) continue;
      ++changed;
      EXPECT_FALSE(move_in_lines(arm, q, {line.to})) << "a nearer branch is possible";
    }
  }
  EXPECT_GT(tried, testing::cases(50) / 10);
  std::cout << changed << " nearer solutions are not possible, " << tried << " lines\n";
}

TEST(MoveProgram, ReasonsNameTheMoveAndItsPlace) {
  const Arm arm = built_in("panda");
  Program program = pick();
  for (std::size_t i = 0; i < 3; ++i) {
    program.moves[i].place = "pick.csv:" + std::to_string(i + 2);
  }
  program.moves[2].target.translation().x() = 2;
  const ProgramMotion far = move_program(arm, home, program);
  EXPECT_EQ(far.failed, 2);
  EXPECT_EQ(testing::field<std::string>(far.reason, ReasonField::segment_name),
            "move 3 (line, pick.csv:4)");
  EXPECT_EQ(testing::field<std::size_t>(far.reason, ReasonField::move), 3U);
  EXPECT_TRUE(far.reason.has(ReasonField::fraction)) << far.reason;
  EXPECT_EQ(far.trajectory.size(), 0);
  program.moves = {{.kind = MoveKind::joint, .target = program.moves[2].target, .place = "a:7"}};
  const ProgramMotion joint = move_program(arm, home, program);
  EXPECT_EQ(joint.status, MotionStatus::unreachable);
  EXPECT_EQ(testing::field<std::string>(joint.reason, ReasonField::move_name),
            "move 1 (joint, a:7)")
      << joint.reason;
}

TEST(MoveProgram, AnErrorOfAMoveHasItsNumber) {
  const Arm arm = built_in("panda");
  for (std::size_t i = 0; i < pick().moves.size(); ++i) {
    Program program = pick();
    program.moves[i].place = "a: 1.csv:7";
    program.moves[i].speed = -1;
    try {
      move_program(arm, home, program);
      FAIL() << i;
    } catch (const MoveError& error) {
      EXPECT_EQ(error.move(), i);
      EXPECT_EQ(error.what(), move_name(program, i) + ": " + error.fault());
    }
  }
}

TEST(MoveProgram, ChangesItsSpeedWithoutAStop) {
  const Arm arm = built_in("panda");
  Pose pose = forward_kinematics(arm, home);
  Program program;
  for (const auto& [step, speed] : std::initializer_list<std::pair<Vector3, double>>{
           {{0, 0.2, 0}, 0.5}, {{0, 0, -0.2}, 0.1}, {{0, -0.2, 0}, 0.4}}) {
    pose.translation() += step;
    program.moves.push_back({.target = pose, .speed = speed, .blend = 0.005});
  }
  program.moves.back().blend = 0;
  for (const double rate : {0.0, 250.0, 60.0}) {
    for (const Profile profile : {Profile::jerk, Profile::fastest, Profile::trapezoidal}) {
      SCOPED_TRACE(name(profile) + " at " + std::to_string(rate));
      const PathMotionOptions options{.profile = profile, .rate = rate};
      const ProgramMotion motion = move_program(arm, home, program, options);
      ASSERT_TRUE(motion) << motion.reason;
      expect_program(arm, program, motion, rate);
      const Verification check = verify(arm, motion.trajectory, program);
      EXPECT_TRUE(check) << check.reason;
      Program slow = program;
      for (Move& move : slow.moves) move.speed = 0.1;
      const ProgramMotion whole = move_program(arm, home, slow, options);
      if (profile == Profile::trapezoidal) continue;  // one form from stop to stop
      EXPECT_LT(motion.trajectory.times.back(), 0.65 * whole.trajectory.times.back());
      EXPECT_GT(motion.moves[1].tool_speed, 0.097);
      EXPECT_GT(motion.moves[2].tool_speed, 0.35);
    }
  }
}

TEST(MoveProgram, EndsByItsBudget) {
  const Arm arm = built_in("panda");
  for (const std::int64_t work : {0, 1, 30, 300}) {
    const ProgramMotion motion = move_program(arm, home, pick(), {.budget = {.max_work = work}});
    EXPECT_EQ(motion.status, MotionStatus::work_limit) << work;
    EXPECT_TRUE(motion.reason);
    EXPECT_EQ(motion.trajectory.size(), 0);
  }
}

TEST(MoveProgram, LongDwellsNeedNoMoreMemoryThanAllowed) {
  const Arm arm = built_in("panda");
  Program program = pick();
  program.moves[1].dwell = 1e6;
  const ProgramMotion motion = move_program(arm, home, program, {.rate = 1000});
  EXPECT_EQ(motion.status, MotionStatus::too_many_samples);
  EXPECT_EQ(motion.failed, 1u);
  EXPECT_EQ(testing::field<std::size_t>(motion.reason, ReasonField::move), 2U) << motion.reason;
  const ProgramMotion long_rest = move_program(arm, home, program);
  ASSERT_TRUE(long_rest) << long_rest.reason;
  EXPECT_GT(long_rest.trajectory.times.back(), 1e6);
  EXPECT_TRUE(verify(arm, long_rest.trajectory, program));
}

TEST(MoveProgram, RefusesWhatNoMoveCanBe) {
  const Arm arm = built_in("panda");
  const auto planned = [&](auto change) {
    Program program = pick();
    change(program.moves);
    return move_program(arm, home, program);
  };
  using Moves = std::vector<Move>;
  EXPECT_REFUSED(planned([](Moves& moves) { moves.clear(); }), "needs moves");
  EXPECT_REFUSED(planned([](Moves& moves) {
                   moves[0].blend = 0.1;
                   moves[1].kind = MoveKind::screw;
                 }),
                 "move 1 (joint): a blend");
  EXPECT_REFUSED(planned([](Moves& moves) { moves[1].blend = 0.1; }), "move 2 (line): a dwell");
  EXPECT_REFUSED(planned([](Moves& moves) { moves[2].blend = 0.1; }), "move 3 (line): a blend");
  EXPECT_REFUSED(planned([](Moves& moves) { moves[1].dwell = -1; }), "move 2 (line): dwell");
  EXPECT_REFUSED(planned([](Moves& moves) { moves[1].dwell = NAN; }), "move 2 (line): dwell");
  EXPECT_REFUSED(planned([](Moves& moves) { moves[1].speed = 0; }), "move 2 (line): speed");
  EXPECT_REFUSED(planned([](Moves& moves) { moves[1].q = home; }),
                 "only joint motions end at joint values");
  EXPECT_REFUSED(planned([](Moves& moves) { moves[1].via = Vector3(1, 0, 0); }), "only arcs");
  EXPECT_REFUSED(planned([](Moves& moves) { moves[1].kind = MoveKind::arc; }), "needs a via");
  EXPECT_REFUSED(planned([](Moves& moves) {
                   moves[1].kind = MoveKind::arc;
                   moves[1].via = moves[1].target.translation();
                 }),
                 "move 2 (arc): the via position");
  EXPECT_REFUSED(planned([](Moves& moves) { moves[0].q = Configuration::Zero(6); }), "move 1");
  EXPECT_REFUSED(planned([](Moves& moves) { moves[0].q = Configuration::Constant(7, 9); }),
                 "move 1 (joint): ");
  Program spline = pick();
  spline.moves.front().kind = MoveKind::spline;
  EXPECT_REFUSED(move_program(arm, std::nullopt, spline), "no start is given");
}

TEST(ProgramMotion, IsPrintedWithItsProofOrItsReason) {
  const auto printed = [](const ProgramMotion& motion) {
    std::ostringstream text;
    text << motion;
    return text.str();
  };
  const Arm arm = built_in("panda");
  Program program = pick();
  const ProgramMotion motion = move_program(arm, home, program);
  ASSERT_TRUE(motion) << motion.reason;
  std::ostringstream bound;
  bound << Deviation{rounded_up(motion.deviation.bound.position, 3),
                     rounded_up(motion.deviation.bound.orientation, 3)};
  EXPECT_EQ(printed(motion), "reached in " + number(motion.trajectory.times.back()) + " s, " +
                                 std::to_string(motion.trajectory.size()) +
                                 " samples, 3 moves, deviation at most " + bound.str());
  program.moves[1].target.translation().x() = 9;
  const ProgramMotion none = move_program(arm, home, program);
  EXPECT_EQ(printed(none), name(none.status) + ": " + sentence(none.reason));
  EXPECT_EQ(printed({}), "not_found");
}

}  // namespace
}  // namespace beeline
