#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/control/replay.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/program.h>
#include <beeline/pose/se3.h>

#include <tests/random.h>

namespace beeline {
namespace {

Arm random_arm(testing::Random& random) {
  const char* names[] = {"panda", "rrr", "ur5"};
  return built_in(names[random.integer(0, 2)]);
}

/// A pose near another one, in the plane of a planar arm.
Pose near(testing::Random& random, const Arm& arm, const Pose& pose) {
  const double size = 0.05 * arm.reach().radius;
  Vector3 step = size * random.direction();
  Vector3 turn = 0.1 * random.direction();
  if (arm.planar()) step.z() = turn.x() = turn.y() = 0;
  return make_pose(pose.translation() + step, so3_exp(turn) * pose.linear());
}

/// Joint moves, lines, blends and dwells.
Program random_program(testing::Random& random, const Arm& arm) {
  Program program;
  for (int part = 0; part < 2; ++part) {
    const Configuration middle = middle_configuration(arm);
    const Configuration q = middle + 0.4 * (random.configuration(arm) - middle);
    Pose from = forward_kinematics(arm, q);
    program.moves.push_back({.kind = MoveKind::joint, .target = from, .q = q});
    for (int i = random.integer(1, 3); i > 0; --i) {
      Move move{.target = from = near(random, arm, from)};
      if (random.integer(0, 1) == 0) move.dwell = random.uniform(0.01, 0.2);
      program.moves.push_back(move);
    }
    if (random.integer(0, 1) == 0) program.moves.back().dwell = random.uniform(1e-3, 0.1);
  }
  return program;
}

/// A replay at a rate that does not divide 1 s into the periods of the recording, or at another
/// speed, or both.
ReplayOptions random_replay(testing::Random& random) {
  const double rates[] = {0, 97, 110, 133, 160, 300, 333, 700};
  const double speeds[] = {1, 1, 0.9, 0.73, 0.31, 0.1};
  ReplayOptions options{.rate = rates[random.integer(0, 7)], .speed = speeds[random.integer(0, 5)]};
  if (random.integer(0, 3) == 0) {
    options.speed = 1;
    options.rate = std::max(options.rate, 100.0);
    options.speed_at = {{0, random.uniform(0.2, 1)}, {0.5, 0}, {0.8, 1}, {1.2, 0.4}};
  }
  return options;
}

PathMotionOptions random_plan(testing::Random& random) {
  const double rates[] = {0, 0, 125, 250};
  return {.interpolation = static_cast<Interpolation>(random.integer(0, 2)),
          .rate = rates[random.integer(0, 3)]};
}

/// Chords of linear joints leave the path at low rates.
VerifyOptions tolerance_of(const Trajectory& trajectory) {
  const bool linear = trajectory.interpolation() == Interpolation::linear;
  return {.tolerance = linear ? 5e-3 : 2e-4, .orientation_tolerance = linear ? 5e-3 : 2e-4};
}

/// The longest time for which the arm is exactly at a configuration; negative where it never is.
double rest_at(const Trajectory& trajectory, const Configuration& q) {
  double longest = -1;
  for (std::size_t k = 0, begin = 0; k < trajectory.size(); ++k) {
    if (trajectory.positions[k] != q) continue;
    if (k == 0 || trajectory.positions[k - 1] != q) begin = k;
    longest = std::max(longest, trajectory.times[k] - trajectory.times[begin]);
  }
  return longest;
}

std::string trace(const Arm& arm, const Trajectory& recording, const ReplayOptions& options) {
  return arm.name() + ", " + name(recording.interpolation()) + " at " +
         std::to_string(options.rate) + " Hz, speed " + std::to_string(options.speed) +
         (options.speed_at.empty() ? "" : ", with changes");
}

// Chords of linear joints leave the path, so that a tolerance for them does not tell rests apart.
TEST(Replay, KeepsTheStopsAndDwellsOfPrograms) {
  testing::Random random;
  int checked = 0;
  for (int round = 0; round < testing::cases(60); ++round) {
    const Arm arm = random_arm(random);
    const Program program = random_program(random, arm);
    const ProgramMotion planned = move_program(arm, {}, program, random_plan(random));
    const VerifyOptions tolerance = tolerance_of(planned.trajectory);
    if (!planned || !verify(arm, planned.trajectory, program, tolerance)) continue;
    const ReplayOptions options = random_replay(random);
    const Replay played = replay(arm, planned.trajectory, options);
    SCOPED_TRACE(trace(arm, planned.trajectory, options));
    if (!played) {
      EXPECT_EQ(planned.trajectory.interpolation(), Interpolation::linear) << played.reason;
      continue;
    }
    ++checked;
    for (std::size_t i = 0; i < program.moves.size(); ++i) {
      const Configuration& stop = planned.trajectory.positions[planned.moves[i].end];
      EXPECT_GE(rest_at(played.trajectory, stop), program.moves[i].dwell - 2e-9);
    }
    if (planned.trajectory.interpolation() == Interpolation::linear) continue;
    const Verification found = verify(arm, played.trajectory, program, tolerance);
    EXPECT_TRUE(found) << found.reason;
    EXPECT_EQ(played.trajectory.positions.back(), planned.trajectory.positions.back());
  }
  EXPECT_GE(checked, testing::cases(60) / 3);
}

TEST(Replay, KeepsTheStopsOfLines) {
  testing::Random random;
  int checked = 0;
  for (int round = 0; round < testing::cases(60); ++round) {
    const Arm arm = random_arm(random);
    const Configuration middle = middle_configuration(arm);
    const Configuration start = middle + 0.4 * (random.configuration(arm) - middle);
    std::vector<Pose> waypoints{near(random, arm, forward_kinematics(arm, start))};
    for (int i = random.integer(1, 4); i > 0; --i) {
      waypoints.push_back(near(random, arm, waypoints.back()));
    }
    const PathMotion planned = move_in_lines(arm, start, waypoints, random_plan(random));
    if (!planned) continue;
    const ReplayOptions options = random_replay(random);
    const Replay played = replay(arm, planned.trajectory, options);
    SCOPED_TRACE(trace(arm, planned.trajectory, options));
    if (!played) {
      EXPECT_EQ(planned.trajectory.interpolation(), Interpolation::linear) << played.reason;
      continue;
    }
    ++checked;
    const Verification found =
        verify(arm, played.trajectory, waypoints, tolerance_of(played.trajectory));
    EXPECT_TRUE(found) << found.reason;
    for (const std::size_t arrival : planned.arrivals) {  // each stop is a sample
      const Configuration& stop = planned.trajectory.positions[arrival];
      const auto& q = played.trajectory.positions;
      EXPECT_NE(std::find(q.begin(), q.end(), stop), q.end());
    }
  }
  EXPECT_GE(checked, testing::cases(60) / 3);
}

// Above the recording's speed a dwell keeps its time; at a rate it lasts whole periods.
TEST(Replay, DoesNotShortenDwells) {
  const Arm arm = built_in("rrr");
  const Configuration a = Configuration::Zero(3), b = Configuration::Constant(3, 0.1);
  const Trajectory recorded{
      arm.joint_names(), {0, 2, 2.5, 4.5}, {a, b, b, a}, {a, a, a, a}, {a, a, a, a}};
  for (const double speed : {1.0, 0.7, 2.0}) {
    for (const double rate : {0.0, 100.0, 60.0, 7.0}) {
      const Replay played = replay(arm, recorded, {.rate = rate, .speed = speed});
      ASSERT_TRUE(played) << played.reason;
      const Trajectory& way = played.trajectory;
      std::vector<double> rests;
      for (std::size_t k = 0; k < way.size(); ++k) {
        if (way.positions[k] == b && way.velocities[k].isZero(0)) rests.push_back(way.times[k]);
      }
      ASSERT_GE(rests.size(), 2);
      const double rested = rests.back() - rests.front();
      EXPECT_GE(rested, 0.5 - 1e-9);
      EXPECT_LE(rested, 0.5 / std::min(1.0, speed) + (rate > 0 ? 1 / rate : 0) + 1e-9);
      EXPECT_LE(played.trajectory.times.back(),
                4 / speed + 0.5 / std::min(1.0, speed) + (rate > 0 ? 3 / rate : 0) + 1e-8);
    }
  }
}

}  // namespace
}  // namespace beeline
