#include <beeline/planning/program.h>
#include <beeline/timing/retime.h>
#include <beeline/trajectory/limit_usage.h>

#include <tests/planning/motion_promises.h>
#include <tests/random.h>
#include <tests/reason.h>

namespace beeline {
namespace {

using namespace testing;

constexpr double resolution = 1e-9;  // of a fall, rad or m

double excess_of(const Arm& arm, int k, double q) {
  return std::max(arm.limits(k).lower - q, q - arm.limits(k).upper);
}

/// A configuration within the limits, except that some joints, at least one, exceed theirs.
Configuration outside(Random& random, const Arm& arm) {
  Configuration q = 0.8 * random.configuration(arm) + 0.2 * middle_configuration(arm);
  const int first = random.integer(0, arm.dof() - 1);
  for (int k = 0; k < arm.dof(); ++k) {
    if (k != first && random.integer(0, 3) != 0) continue;
    const Limits& limits = arm.limits(k);
    const double excess = std::pow(10, random.uniform(-8, -1.4));
    q[k] = random.integer(0, 1) == 0 ? limits.upper + excess : limits.lower - excess;
  }
  return q;
}

double largest_excess(const Arm& arm, const Configuration& q) {
  double largest = 0;
  for (int k = 0; k < arm.dof(); ++k) largest = std::max(largest, excess_of(arm, k, q[k]));
  return largest;
}

/// Expects that the motion begins at `start`, brings the joints that are outside back steadily, and
/// keeps the limits after that; and that verify() accepts it with this excess only.
void expect_recovery(const Arm& arm, const Configuration& start, const Trajectory& motion,
                     const std::optional<Recovery>& recovery) {
  const double excess = largest_excess(arm, start);
  ASSERT_TRUE(recovery);
  EXPECT_EQ(recovery->excess, excess);
  EXPECT_EQ(motion.positions.front(), start);
  ASSERT_LT(recovery->sample, motion.size());
  EXPECT_EQ(recovery->time, motion.times[recovery->sample]);
  constexpr int times = 3000;
  Configuration smallest = Configuration::Constant(arm.dof(), Limits::none);
  for (int i = 0; i <= times; ++i) {
    const double t = motion.duration() * i / times;
    const Configuration q = sample(motion, t).position;
    for (int k = 0; k < arm.dof(); ++k) {
      const double here = excess_of(arm, k, q[k]);
      ASSERT_LE(here,
                std::max(0.0, std::min(smallest[k], excess_of(arm, k, start[k]))) + resolution)
          << arm.name() << " joint " << k << " at " << t;
      smallest[k] = std::min(smallest[k], here);
    }
    if (t >= recovery->time) {
      ASSERT_LE(largest_excess(arm, q), resolution);
    }
  }
  const Verification accepted = verify(arm, motion, VerifyOptions{.recover = excess});
  EXPECT_TRUE(accepted) << arm.name() << ", excess " << excess << ": " << accepted.reason;
  const Verification refused = verify(arm, motion, VerifyOptions{.recover = excess / 2});
  EXPECT_EQ(refused.fault, Fault::limits);
  EXPECT_EQ(refused.sample, 0);
  EXPECT_EQ(verify(arm, motion).fault, Fault::limits);
}

/// Expects that the joints that start within their limits stand still up to the end of the section.
void expect_others_still(const Arm& arm, const Trajectory& motion, const Recovery& recovery) {
  const Configuration& start = motion.positions.front();
  for (std::size_t i = 0; i <= recovery.sample; ++i) {
    for (int k = 0; k < arm.dof(); ++k) {
      if (excess_of(arm, k, start[k]) <= 0) {
        ASSERT_EQ(motion.positions[i][k], start[k]);
      }
    }
  }
}

TEST(RecoveryOfJointPaths, LeadsBackAndThenThroughTheWaypoints) {
  Random random;
  for (const char* name : {"panda", "puma560", "iiwa14", "scara"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < cases(45); ++i) {
      const Configuration start = outside(random, arm);
      const std::vector<Configuration> waypoints{start, random.configuration(arm),
                                                 random.configuration(arm)};
      RetimeOptions options{.joint_blend = 0, .recover = 0.1};
      options.profile = static_cast<Profile>(random.integer(0, 2));
      if (random.integer(0, 2) == 0) options.rate = 200;
      const Retimed motion = move_through(arm, waypoints, options);
      ASSERT_TRUE(motion) << name << ": " << motion.reason;
      expect_recovery(arm, start, motion.trajectory, motion.recovery);
      expect_others_still(arm, motion.trajectory, *motion.recovery);
      EXPECT_EQ(motion.trajectory.positions.back(), waypoints.back());
      EXPECT_EQ(motion.blends, (std::vector<double>{0, 0}));
      const Retimed again = retime(arm, motion.trajectory, {.recover = 0.1});
      ASSERT_TRUE(again) << name << ": " << again.reason;
      expect_recovery(arm, start, again.trajectory, again.recovery);
      EXPECT_EQ(again.trajectory.positions.back(), waypoints.back());
      options.recover = largest_excess(arm, start) / 2;
      EXPECT_FALSE(move_through(arm, waypoints, options));
    }
  }
}

TEST(RecoveryOfJointPaths, KeepsADurationAndMayBeTheWholeMotion) {
  const Arm arm = built_in("panda");
  Configuration start = middle_configuration(arm);
  start[3] = arm.limits(3).upper + 0.02;
  const Configuration back = nearest_within_limits(arm, start);
  const Retimed only = move_through(arm, std::vector{start, back}, {.recover = 0.1});
  ASSERT_TRUE(only) << only.reason;
  expect_recovery(arm, start, only.trajectory, only.recovery);
  EXPECT_EQ(only.trajectory.positions.back(), back);
  const std::vector<Configuration> on{start, middle_configuration(arm)};
  const Retimed slow = move_through(arm, on, {.duration = 5, .recover = 0.1});
  ASSERT_TRUE(slow) << slow.reason;
  EXPECT_NEAR(slow.duration(), 5, 1e-9);
  expect_recovery(arm, start, slow.trajectory, slow.recovery);
  const Retimed short_one = move_through(arm, on, {.duration = 0.01, .recover = 0.1});
  EXPECT_EQ(short_one.reason.code, ReasonCode::duration_too_short);
  EXPECT_FALSE(move_through(arm, on));
}

TEST(RecoveryOfLines, LeadsBackToTheBeginningOfThePath) {
  Random random;
  int reached = 0;
  for (const char* name : {"panda", "puma560", "iiwa14"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < cases(60); ++i) {
      const Configuration start = outside(random, arm);
      const Configuration back = nearest_within_limits(arm, start);
      Pose to = forward_kinematics(arm, back);
      to.translation() += 0.02 * random.direction();
      PathMotionOptions options{.recover = 0.1};
      if (i % 2 == 0) options.rate = 250;
      const PathMotion motion = move_in_lines(arm, start, {to}, options);
      EXPECT_REFUSED(move_in_lines(arm, start, {to}), "the motion cannot start");
      if (!motion) continue;
      ++reached;
      expect_recovery(arm, start, motion.trajectory, motion.recovery);
      expect_others_still(arm, motion.trajectory, *motion.recovery);
      EXPECT_EQ(motion.path_parameters.size(), motion.trajectory.size());
      EXPECT_EQ(motion.arrivals, std::vector{motion.trajectory.size() - 1});
      EXPECT_LE(motion.deviation.bound.position, options.tolerance);
      const Verification proved = verify(arm, motion.trajectory, {to}, {.recover = 0.1});
      EXPECT_TRUE(proved) << proved.reason;
      EXPECT_FALSE(verify(arm, motion.trajectory, {to}));
      const Retimed again = retime(arm, motion.trajectory, {.recover = 0.1});
      ASSERT_TRUE(again) << name << ": " << again.reason;
      expect_recovery(arm, start, again.trajectory, again.recovery);
      // With another sample the path is left, not before the recovery has ended.
      Trajectory off = motion.trajectory;
      off.positions.back()[arm.dof() - 2] += 0.01;
      const Verification left = verify(arm, off, {to}, {.recover = 0.1});
      EXPECT_NE(left.fault, Fault::none);
      EXPECT_GE(left.sample, motion.recovery->sample);
    }
  }
  EXPECT_GT(reached, cases(60) / 2) << "of " << 3 * cases(60) << ", many at a limit";
}

/// A joint move and two lines with blends, or a line first, from the configuration `back` on.
Program random_program(Random& random, const Arm& arm, const Configuration& back, bool joint_first,
                       double blend) {
  const auto line_to = [&](const Pose& pose) {
    Pose to = pose;
    to.translation() += 0.02 * random.direction();
    return Move{.kind = MoveKind::line, .target = to, .blend = blend};
  };
  Program program;
  Pose begin = forward_kinematics(arm, back);
  if (joint_first) {
    const Configuration goal = 0.5 * (back + middle_configuration(arm));
    program.moves.push_back({.kind = MoveKind::joint, .q = goal, .blend = blend});
    begin = forward_kinematics(arm, goal);
  }
  program.moves.push_back(line_to(begin));
  program.moves.push_back(line_to(program.moves.back().target));
  program.moves.back().blend = 0;
  return program;
}

TEST(RecoveryOfPrograms, LeadsBackToWhereTheFirstMoveBegins) {
  Random random;
  int reached = 0;
  for (const char* name : {"panda", "puma560", "iiwa14"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < cases(30); ++i) {
      const Configuration start = outside(random, arm);
      const Configuration back = nearest_within_limits(arm, start);
      const Program program = random_program(random, arm, back, i % 2 == 0, i % 3 == 0 ? 0.005 : 0);
      PathMotionOptions options{.recover = 0.1};
      if (i % 4 == 0) options.rate = 250;
      if (i % 5 == 0) options.interpolation = Interpolation::cubic;
      if (i % 5 == 1) options.interpolation = Interpolation::linear;
      const ProgramMotion motion = move_program(arm, start, program, options);
      EXPECT_REFUSED(move_program(arm, start, program), "the motion cannot start");
      if (!motion) continue;
      ++reached;
      if (i % 5 > 1) expect_recovery(arm, start, motion.trajectory, motion.recovery);
      ASSERT_TRUE(motion.recovery);
      expect_others_still(arm, motion.trajectory, *motion.recovery);
      EXPECT_EQ(motion.moves.front().begin, motion.recovery->sample);
      EXPECT_EQ(motion.moves.back().end, motion.trajectory.size() - 1);
      EXPECT_LE(motion.deviation.bound.position, options.tolerance);
      VerifyOptions accepted{.recover = 0.1};
      const Verification proved = verify(arm, motion.trajectory, program, accepted);
      EXPECT_TRUE(proved) << proved.reason;
      ASSERT_TRUE(proved.recovery);
      EXPECT_EQ(proved.recovery->sample, motion.recovery->sample);
      EXPECT_EQ(verify(arm, motion.trajectory, program).fault, Fault::limits);
      accepted.recover = largest_excess(arm, start) / 2;
      EXPECT_EQ(verify(arm, motion.trajectory, program, accepted).fault, Fault::limits);
      // With another sample the path is left, not before the recovery has ended.
      Trajectory off = motion.trajectory;
      off.positions.back()[arm.dof() - 2] += 0.01;
      const Verification left = verify(arm, off, program, {.recover = 0.1});
      EXPECT_NE(left.fault, Fault::none);
      EXPECT_GE(left.sample, motion.recovery->sample);
    }
  }
  EXPECT_GT(reached, cases(30)) << "of " << 3 * cases(30) << ", many at a limit";
}

TEST(RecoveryOfPrograms, IsNotNeededWithinTheLimits) {
  const Arm arm = built_in("panda");
  const Configuration start = middle_configuration(arm);
  Random random;
  const Program program = random_program(random, arm, start, true, 0);
  const ProgramMotion with = move_program(arm, start, program, {.recover = 0.1});
  const ProgramMotion without = move_program(arm, start, program);
  ASSERT_TRUE(with) << with.reason;
  EXPECT_FALSE(with.recovery);
  EXPECT_EQ(with.trajectory.positions, without.trajectory.positions);
  EXPECT_FALSE(verify(arm, with.trajectory, program, {.recover = 0.1}).recovery);
  for (const double amount : {-0.01, 0.2, Limits::none}) {
    EXPECT_REFUSED(move_program(arm, start, program, {.recover = amount}), "recover");
    EXPECT_REFUSED(verify(arm, with.trajectory, program, {.recover = amount}), "recover");
  }
}

TEST(RecoveryOfLines, IsProvedInTheSceneToo) {
  const Arm arm = built_in("panda");
  Configuration start = middle_configuration(arm);
  start[0] = arm.limits(0).upper + 0.05;
  Pose to = forward_kinematics(arm, nearest_within_limits(arm, start));
  to.translation().z() += 0.05;
  int asked = 0;
  PathMotionOptions options{.recover = 0.1};
  options.blocked_by.reason = [&](const Trajectory& motion, const ClearanceOptions&) {
    ++asked;
    const bool whole = motion.positions.front() == start;
    return whole ? Reason{ReasonCode::bodies_collide, {{ReasonField::time, 0.0}}} : Reason{};
  };
  const PathMotion motion = move_in_lines(arm, start, {to}, options);
  EXPECT_EQ(motion.status, MotionStatus::collides);
  EXPECT_EQ(motion.reason.code, ReasonCode::bodies_collide);
  EXPECT_EQ(motion.trajectory.size(), 0);
  EXPECT_GE(asked, 2);
}

/// A panda that starts outside a limit, and a pose near the beginning of its path.
struct Outside {
  Arm arm = built_in("panda");
  Configuration start = middle_configuration(arm);
  Pose to = Pose::Identity();

  Outside() {
    start[3] = arm.limits(3).upper + 0.02;
    Configuration goal = nearest_within_limits(arm, start);
    goal[1] += 0.05;
    goal[3] -= 0.1;
    to = forward_kinematics(arm, goal);
  }
};

TEST(RecoveryOfLines, CountsTheSamplesOfTheWhole) {
  const Outside given;
  PathMotionOptions options{.rate = 500, .recover = 0.1};
  const PathMotion whole = move_in_lines(given.arm, given.start, {given.to}, options);
  ASSERT_TRUE(whole) << whole.reason;
  const int samples = static_cast<int>(whole.trajectory.size());
  const int before = static_cast<int>(whole.recovery->sample);
  options.max_samples = samples;
  EXPECT_TRUE(move_in_lines(given.arm, given.start, {given.to}, options));
  for (const int fewer : {samples - 1, samples - before, before, 2}) {
    options.max_samples = fewer;
    const PathMotion refused = move_in_lines(given.arm, given.start, {given.to}, options);
    EXPECT_EQ(refused.status, MotionStatus::too_many_samples) << fewer;
    EXPECT_EQ(field<std::size_t>(refused.reason, ReasonField::max_samples), fewer);
  }
}

/// The least work with which a line is reached, by doubling and bisection.
std::int64_t least_work(const Outside& given, const Configuration& start) {
  const auto reached = [&](std::int64_t work) {
    PathMotionOptions options{.recover = 0.1};
    options.budget.max_work = work;
    return static_cast<bool>(move_in_lines(given.arm, start, {given.to}, options));
  };
  std::int64_t enough = 1;
  while (!reached(enough)) enough *= 2;
  std::int64_t too_little = enough / 2;
  while (enough - too_little > 1) {
    const std::int64_t middle = (enough + too_little) / 2;
    (reached(middle) ? enough : too_little) = middle;
  }
  return enough;
}

// The plan of the line and the recovery before it share one budget.
TEST(RecoveryOfLines, CountsTheBudgetOnce) {
  const Outside given;
  const Configuration back = nearest_within_limits(given.arm, given.start);
  EXPECT_GT(least_work(given, given.start), least_work(given, back));
}

TEST(RecoveryOfJointPaths, RemainsWhenTheBudgetEndsTheMotion) {
  const Outside given;
  std::vector<Configuration> waypoints{given.start};
  Random random;
  for (int i = 0; i < 20; ++i) {
    const Configuration middle = middle_configuration(given.arm);
    waypoints.insert(waypoints.end(), 2, middle + 0.5 * (random.configuration(given.arm) - middle));
  }
  int ended = 0;
  for (std::int64_t work = 1; work < 1'000'000; work *= 2) {
    RetimeOptions options{.recover = 0.1};
    options.budget.max_work = work;
    const Retimed motion = move_through(given.arm, waypoints, options);
    if (motion) break;
    ASSERT_EQ(motion.ending, Ending::work_limit);
    if (motion.trajectory.size() == 0) continue;
    ++ended;
    EXPECT_EQ(motion.trajectory.positions.front(), given.start);
    ASSERT_TRUE(motion.recovery);
    EXPECT_EQ(motion.sections, field<std::size_t>(motion.reason, ReasonField::count));
    if (motion.sections > 1) {
      EXPECT_EQ(field<std::size_t>(motion.reason, ReasonField::of), 21);
    }
    const VerifyOptions accepting{.recover = 0.1};
    EXPECT_TRUE(verify(given.arm, motion.trajectory, accepting));
  }
  EXPECT_GT(ended, 0);
}

TEST(RecoveryOfJointPaths, CountsTheSamplesOfTheWhole) {
  const Outside given;
  const std::vector<Configuration> waypoints{given.start, middle_configuration(given.arm)};
  RetimeOptions options{.rate = 100, .recover = 0.1};
  const Retimed whole = move_through(given.arm, waypoints, options);
  ASSERT_TRUE(whole) << whole.reason;
  const auto size = static_cast<int>(whole.trajectory.size());
  for (options.max_samples = 2; options.max_samples <= size; ++options.max_samples) {
    const Retimed motion = move_through(given.arm, waypoints, options);
    ASSERT_EQ(static_cast<bool>(motion), options.max_samples == size) << motion.reason;
    if (motion) continue;
    EXPECT_EQ(motion.trajectory.size(), 0);
    EXPECT_EQ(field<std::size_t>(motion.reason, ReasonField::max_samples), options.max_samples);
  }
}

TEST(RecoveryOfLines, RefusesAmountsOutOfRangeAndFartherStarts) {
  const Arm arm = built_in("panda");
  Configuration q = middle_configuration(arm);
  const Pose to = forward_kinematics(arm, q);
  for (const double wrong : {-1e-9, 0.2, 1e300, Limits::none, std::nan("")}) {
    EXPECT_REFUSED(move_in_lines(arm, q, {to}, {.recover = wrong}), "recover must be from 0");
    EXPECT_REFUSED(move_through(arm, std::vector{q, q}, {.recover = wrong}), "recover must be");
  }
  q[2] = arm.limits(2).upper + 0.05;
  EXPECT_REFUSED(move_in_lines(arm, q, {to}, {.recover = 0.04}), "the motion cannot start: ");
}

}  // namespace
}  // namespace beeline
