#include <sstream>

#include <beeline/planning/internal/tool_boxes.h>

#include <tests/planning/joint_blend_promises.h>

namespace beeline {
namespace {

using namespace testing;

/// Joint moves with a blend at lines near the singularity of a wrist.
Program near_singularity(Random& random, const Arm& arm, Configuration& start) {
  constexpr double near = 5e-3;  // radians
  const auto singular = [&] {
    const double elbow = 1.5 + random.uniform(-0.4, 0.4);
    return Configuration{{random.uniform(-0.6, 0.6), random.uniform(-1.6, -0.8), elbow,
                          random.uniform(-0.5, 0.5), random.uniform(-near, near),
                          random.uniform(-0.3, 0.3)}};
  };
  const auto moved = [&](Configuration q, double most) {
    for (int i = 0; i < 6; ++i) q[i] += random.uniform(-most, most);
    return q;
  };
  const Configuration q = singular();
  start = moved(q, 0.3);
  const double blend = random.uniform(0.01, 0.06);
  Program program;
  program.moves.push_back({.kind = MoveKind::joint, .q = q, .blend = blend});
  Pose target = forward_kinematics(arm, q);
  target.translation() += random.uniform(0.03, 0.15) * random.direction();
  program.moves.push_back({.target = target, .blend = blend});
  program.moves.push_back({.kind = MoveKind::joint, .q = moved(q, 0.3), .blend = blend});
  program.moves.push_back({.kind = MoveKind::joint, .q = moved(q, 0.5)});
  return program;
}

TEST(BlendSearch, EndsNearSingularities) {
  Random random;
  const Arm arm = built_in("kr6_r900");
  int programs = 0, blends = 0;
  for (int i = 0; i < cases(12); ++i) {
    SCOPED_TRACE(i);
    Configuration start;
    const Program program = near_singularity(random, arm, start);
    PathMotionOptions options;
    if (random.integer(0, 2) == 0) options.rate = 250;
    const ProgramMotion stops = move_program(arm, start, with_stops(program), options);
    if (!stops) continue;
    options.budget.max_work = 2'000'000;  // with less than it needs, there would be no blends
    const ProgramMotion motion = move_program(arm, start, program, options);
    ASSERT_TRUE(motion) << motion;
    EXPECT_LE(motion.duration(), stops.duration());
    expect_proved(arm, program, motion);
    ++programs;
    blends += blend_count(motion);
  }
  EXPECT_GE(2 * blends, 3 * programs);
  EXPECT_GE(4 * programs, cases(12));
}

TEST(BlendSearch, GivesTheMotionWithStopsWhenItsBudgetEnds) {
  Random random;
  int ended = 0, blended = 0;
  for (const std::string name : {"panda", "ur5"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < cases(4); ++i) {
      SCOPED_TRACE(name + " " + std::to_string(i));
      const Configuration start = near_middle(random, arm, 0.3);
      Program program;
      for (int k = 0; k < 4; ++k) {
        program.moves.push_back({.kind = MoveKind::joint, .q = near_middle(random, arm, 0.3)});
        if (k < 3) program.moves.back().blend = 0.02;
      }
      const ProgramMotion stops = move_program(arm, start, with_stops(program));
      ASSERT_TRUE(stops) << stops;
      bool was_reached = false;
      for (std::int64_t work = 16; work < (1 << 24); work *= 2) {
        PathMotionOptions options;
        options.budget.max_work = work;
        const ProgramMotion motion = move_program(arm, start, program, options);
        if (!motion) {
          EXPECT_EQ(motion.status, MotionStatus::work_limit);
          EXPECT_FALSE(was_reached);
          continue;
        }
        was_reached = true;
        expect_proved(arm, program, motion);
        EXPECT_TRUE(std::isfinite(motion.deviation.bound.position));
        if (blend_count(motion) > 0) {
          ++blended;
          break;
        }
        ++ended;
        EXPECT_EQ(motion.trajectory.times, stops.trajectory.times);
        EXPECT_EQ(motion.moves[0].blend, BlendOutcome::stop);
      }
      EXPECT_TRUE(was_reached);
    }
  }
  EXPECT_GE(ended, 1);
  EXPECT_GE(blended, 1);
}

TEST(BlendSearch, MakesOnlyTheBlendThatIsRefusedAStop) {
  Random random;
  const Arm arm = built_in("ur5");
  for (const std::size_t tiny : {std::size_t{1}, std::size_t{3}, std::size_t{6}}) {
    SCOPED_TRACE(tiny);
    const Configuration start = near_middle(random, arm, 0.2);
    Configuration q = start;
    Program program;
    for (int k = 0; k < 8; ++k) {
      q[k % 3] += (random.integer(0, 1) == 0 ? 1 : -1) * random.uniform(0.5, 0.9);
      program.moves.push_back({.kind = MoveKind::joint, .q = q, .blend = 0.1});
    }
    program.moves.back().blend = 0;
    program.moves[tiny].blend = 1e-7;  // smaller than any that is made
    const ProgramMotion motion = move_program(arm, start, program, {.rate = 250});
    ASSERT_TRUE(motion) << motion;
    expect_proved(arm, program, motion);
    for (std::size_t k = 0; k + 1 < program.moves.size(); ++k) {
      EXPECT_EQ(motion.moves[k].blend == BlendOutcome::stop, k == tiny) << k;
    }
  }
}

TEST(BlendSearch, KeepsTheBlendsThatAreProvedWhenItsBudgetEnds) {
  Random random;
  const Arm arm = built_in("ur5");
  const Configuration start = near_middle(random, arm, 0.2);
  Configuration q = start;
  Program program;
  constexpr std::size_t sections = 6;  // of three moves
  for (std::size_t k = 0; k < 3 * sections; ++k) {
    q[static_cast<int>(k % 3)] += (random.integer(0, 1) == 0 ? 1 : -1) * random.uniform(0.5, 0.9);
    program.moves.push_back({.kind = MoveKind::joint, .q = q, .blend = k % 3 == 2 ? 0 : 0.05});
  }
  const ProgramMotion whole = move_program(arm, start, program);
  ASSERT_TRUE(whole) << whole;
  EXPECT_EQ(whole.search_ending, Ending::complete);
  int kept = 0, before = 0;
  for (std::int64_t work = 512; work < (1 << 22); work += work / 8) {
    PathMotionOptions options;
    options.budget.max_work = work;
    const ProgramMotion motion = move_program(arm, start, program, options);
    if (!motion) continue;
    SCOPED_TRACE(work);
    expect_proved(arm, program, motion);
    const int blends = blend_count(motion);
    EXPECT_GE(blends, before);
    before = blends;
    kept += blends > 0 && blends < blend_count(whole);
    if (motion.search_ending == Ending::complete) {
      EXPECT_EQ(motion.trajectory.times, whole.trajectory.times);
      break;
    }
    EXPECT_EQ(motion.search_ending, Ending::work_limit);
    std::ostringstream text, ended;
    text << motion;
    ended << "blends: " << Reason{ReasonCode::ended, {{ReasonField::ending, Ending::work_limit}}};
    EXPECT_NE(text.str().find(ended.str()), std::string::npos);
  }
  EXPECT_EQ(before, blend_count(whole));
  EXPECT_GE(kept, 2);
}

// A check that ends early says what is true of the whole one, however early it ends.
TEST(BlendSearch, AnEndedCheckRefutesNothingElse) {
  Random random;
  int ended = 0;
  for (const std::string name : {"panda", "ur5"}) {
    const Arm arm = built_in(name);
    const Configuration start = near_middle(random, arm, 0.2);
    Program program;
    for (int k = 0; k < 4; ++k) {
      const Configuration q = near_middle(random, arm, 0.3);
      program.moves.push_back({.kind = MoveKind::joint, .q = q, .blend = 0.05});
    }
    Pose target = forward_kinematics(arm, *program.moves.back().q);
    target.translation().z() += 0.05;
    program.moves.push_back({.target = target, .blend = 0.01});
    program.moves.push_back({.kind = MoveKind::joint, .q = start});
    const ProgramMotion motion = move_program(arm, start, program, {.rate = 100});
    ASSERT_TRUE(motion) << motion;
    for (const double speed : {0.0, 0.01, 0.3}) {
      for (std::size_t slow = 0; slow < 5; ++slow) {
        Program slower = program;
        if (speed > 0) slower.moves[slow].speed = speed;
        const Verification whole = verify(arm, motion.trajectory, slower);
        EXPECT_EQ(bool(whole), speed == 0 || whole.fault == Fault::none);
        for (int work = 1; work < 6000; work += 1 + random.integer(0, work / 20)) {
          VerifyOptions options;
          options.budget.max_work = work;
          const Verification found = verify(arm, motion.trajectory, slower, options);
          if (found.ending == Ending::complete) {
            EXPECT_EQ(found.fault, whole.fault) << work;
            break;
          }
          ++ended;
          EXPECT_FALSE(found);
          EXPECT_TRUE(found.fault == Fault::none || found.fault == whole.fault) << work;
        }
      }
    }
  }
  EXPECT_GT(ended, 100);
}

TEST(BlendSearch, StopsOnlyWhereAMotionTurnsBack) {
  Random random;
  const Arm arm = built_in("ur5");
  for (int i = 0; i < cases(10); ++i) {
    SCOPED_TRACE(i);
    const Configuration start = near_middle(random, arm, 0.2);
    const int count = 7, back = random.integer(1, 4);
    std::vector<Configuration> q{start};
    for (int k = 0; k < count; ++k) {
      // Joint by joint, so that each waypoint turns by a right angle.
      Configuration next = q.back();
      next[k % 3] += (random.integer(0, 1) == 0 ? 1 : -1) * random.uniform(0.5, 0.9);
      if (k == back + 1) next = q[static_cast<std::size_t>(back)];
      q.push_back(next);
    }
    Program program;
    for (int k = 0; k < count; ++k) {
      program.moves.push_back(
          {.kind = MoveKind::joint, .q = q[static_cast<std::size_t>(k) + 1], .blend = 0.05});
    }
    program.moves.back().blend = 0;
    const ProgramMotion motion = move_program(arm, start, program);
    ASSERT_TRUE(motion) << motion;
    for (int k = 0; k + 1 < count; ++k) {
      const BlendOutcome outcome = motion.moves[static_cast<std::size_t>(k)].blend;
      EXPECT_EQ(outcome == BlendOutcome::stop, k == back) << k << " of " << back;
    }
  }
}

TEST(BlendSearch, NoMoveEndsAtAMovingSampleUnlessItBlends) {
  Random random;
  int repeated = 0;
  for (const std::string name : {"scara", "panda", "rrr", "ur5"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < cases(5); ++i) {
      SCOPED_TRACE(name + " " + std::to_string(i));
      const Configuration start = near_middle(random, arm, 0.3);
      Program program;
      for (int k = random.integer(2, 4); k > 0; --k) {
        const Configuration q = near_middle(random, arm, 0.3);
        Move move{.kind = MoveKind::joint, .target = forward_kinematics(arm, q)};
        if (random.integer(0, 1) == 0) move.q = q;
        move.blend = random.uniform(0.005, 0.06) * arm.reach().radius;
        program.moves.push_back(move);
        if (random.integer(0, 1) == 0) continue;
        ++repeated;  // as the same pose, as the configuration, or as a line without length
        move.q.reset();
        if (random.integer(0, 1) == 0) move.kind = MoveKind::line;
        if (move.kind == MoveKind::joint && random.integer(0, 1) == 0) move.q = q;
        program.moves.push_back(move);
      }
      program.moves.back().blend = 0;
      for (const double rate : {0.0, 250.0, 20.0}) {
        const ProgramMotion motion = move_program(arm, start, program, {.rate = rate});
        ASSERT_TRUE(motion) << motion;
        const Verification proof = verify(arm, motion.trajectory, program);
        ASSERT_TRUE(proof) << proof;
        for (std::size_t k = 0; k < program.moves.size(); ++k) {
          if (motion.moves[k].joint_blend_radius > 0) continue;
          EXPECT_LE(motion.trajectory.velocities[motion.moves[k].end].norm(), 1e-6) << k;
          EXPECT_LE(motion.trajectory.velocities[proof.arrivals[k]].norm(), 1e-6) << k;
        }
      }
    }
  }
  EXPECT_GE(repeated, cases(10));
}

TEST(BlendSearch, StopsAtARepeatedPoseAtTheEndsOfLines) {
  const Arm arm = built_in("panda");
  const Configuration home = Configuration{{0, -45, 0, -135, 0, 90, 45}} * deg;
  const auto away = [&](double x, double y) { return moved_tool(arm, home, x, y); };
  Program program;
  for (const Pose& pose : {away(0, 0), away(0.1, 0.1), away(0, 0.1), away(0, 0.2), away(0, 0.2)}) {
    program.moves.push_back({.target = pose, .blend = 0.01});
  }
  program.moves.push_back({.kind = MoveKind::joint, .q = home});
  for (const double rate : {0.0, 250.0}) {
    const ProgramMotion motion = move_program(arm, home, program, {.rate = rate});
    ASSERT_TRUE(motion) << motion;
    expect_proved(arm, program, motion);
    for (std::size_t k = 0; k + 1 < program.moves.size(); ++k) {
      const bool passes = k == 1 || k == 2;  // the others are at a line without length
      EXPECT_EQ(motion.moves[k].blend == BlendOutcome::stop, !passes) << k;
      const double speed = motion.trajectory.velocities[motion.moves[k].end].norm();
      EXPECT_EQ(speed > 1e-3, passes) << k;
    }
  }
}

TEST(BlendSearch, PassesAWaypointBetweenLinesThatContinueEachOther) {
  const Arm arm = built_in("panda");
  const Configuration home = Configuration{{0, -45, 0, -135, 0, 90, 45}} * deg;
  Program program;
  for (const double x : {0.05, 0.1}) {
    Pose pose = forward_kinematics(arm, home);
    pose.translation().x() += x;
    program.moves.push_back({.target = pose});
  }
  program.moves[0].blend = 0.01;
  const ProgramMotion motion = move_program(arm, home, program);
  ASSERT_TRUE(motion) << motion;
  EXPECT_EQ(motion.moves[0].blend, BlendOutcome::full);
  EXPECT_GT(motion.trajectory.velocities[motion.moves[0].end].norm(), 1e-3);
}

TEST(ToolBoxes, FindWhatALookAtAllSamplesFinds) {
  Random random;
  for (const Task& task : {Task::spatial(), Task::planar(), Task::position()}) {
    for (int i = 0; i < cases(30); ++i) {
      std::vector<Pose> tool;
      Vector3 at = Vector3::Zero();
      for (int k = random.integer(1, 900); k > 0; --k) {
        at += random.uniform(0, 0.1) * random.direction();
        tool.push_back(make_pose(at, Rotation::Identity()));
      }
      const internal::ToolBoxes boxes(tool, task);
      const double distance = std::pow(10, random.uniform(-3, 0));
      const Vector3 goal =
          tool[static_cast<std::size_t>(random.integer(0, static_cast<int>(tool.size()) - 1))]
              .translation() +
          distance * random.direction();
      std::size_t next = boxes.next_near(goal, distance, 0);
      for (std::size_t k = 0; k < tool.size(); ++k) {
        // Boxes are larger than the balls in them.
        const bool found = k == next;
        Vector3 away = tool[k].translation() - goal;
        if (task == Task::planar()) away.z() = 0;
        EXPECT_TRUE(found || away.norm() > distance) << k;
        if (found) next = boxes.next_near(goal, distance, k + 1);
      }
      EXPECT_EQ(next, tool.size());
    }
  }
}

}  // namespace
}  // namespace beeline
