#include <beeline/path/internal/nearest_on_line.h>

#include <tests/planning/motion_promises.h>
#include <tests/reason.h>

namespace beeline {
namespace {

using namespace testing;

/// The line by minimum-norm joint motions, by eq. 1.5 in small steps.
bool reached_by_least_motion(const Arm& arm, Configuration q, const Pose& to) {
  const Pose from = forward_kinematics(arm, q);
  const int steps = 3000;
  for (int i = 1; i <= steps; ++i) {
    const Pose target = interpolate(from, to, double(i) / steps);
    const Eigen::MatrixXd j = task_jacobian(arm, q, Task::planar());
    const Eigen::VectorXd e = task_error(Task::planar(), target, forward_kinematics(arm, q));
    q += j.transpose() * (j * j.transpose()).ldlt().solve(e);
    if (!limit_violations(arm, q).empty()) return false;
  }
  return true;
}

TEST(MoveInLines, KeepsRedundantJointsFromTheirLimits) {
  testing::Random random;
  const Arm arm = chain(6, 1.2);
  int least = 0, ours = 0;
  for (int i = 0; i < cases(60); ++i) {
    const Configuration start = 0.9 * random.configuration(arm);
    Configuration goal;
    do {
      goal = 0.9 * random.configuration(arm);
    } while (std::abs(goal.sum() - start.sum()) > 3);
    const Pose to = forward_kinematics(arm, goal);
    const PathMotion motion = move_in_lines(arm, start, std::vector{to});
    if (motion.status == MotionStatus::reached) {
      ++ours;
      expect_within_limits(arm, motion.trajectory);
    }
    least += reached_by_least_motion(arm, start, to) ? 1 : 0;
  }
  EXPECT_GT(ours, 1.5 * least) << least << " lines with least motions, " << ours << " with ours";
}

TEST(MoveInLines, LeavesTheOtherRowsOfTheTaskFree) {
  const Arm arm = built_in("ur5");
  const Configuration start{{0.5, -1, 1.5, -0.5, 1, 0}};
  const Pose from = forward_kinematics(arm, start);
  const Pose to = make_pose(from.translation() + Vector3(0.15, 0.1, -0.1),
                            so3_exp({0.2, -0.1, 1}) * from.linear());
  for (const std::string task :
       {"position", "111110:tool", "110000", "001000", "000111", "110111:tool", "111001"}) {
    const PathMotionOptions options{.task = task_named(task)};
    const PathMotion motion = move_in_lines(arm, start, std::vector{to}, options);
    ASSERT_EQ(motion.status, MotionStatus::reached) << task << ": " << motion.reason;
    expect_within_limits(arm, motion.trajectory);
    EXPECT_LE(motion.deviation.bound.position, options.tolerance) << task;
    EXPECT_LE(motion.deviation.bound.orientation, options.orientation_tolerance) << task;
    const Pose end = forward_kinematics(arm, motion.trajectory.positions.back());
    EXPECT_LE(task_error(*options.task, to, end).norm(), 1e-9) << task;
    const Line line{from, to};
    for (std::size_t k = 1; k < motion.trajectory.size(); k += 7) {
      const Configuration middle = motion_between(motion.trajectory, k - 1, 0.5);
      const Deviation off =
          internal::deviation_from(line, forward_kinematics(arm, middle), *options.task);
      ASSERT_LE(off.position, motion.deviation.bound.position + 1e-9) << task;
      ASSERT_LE(off.orientation, motion.deviation.bound.orientation + 1e-9) << task;
    }
  }
}

TEST(MoveInLines, RotatesInPlaceWithAFreeRoll) {
  const Arm arm = built_in("ur5");
  const Configuration start{{0.5, -1, 1.5, -0.5, 1, 0}};
  const Pose from = forward_kinematics(arm, start);
  const Pose to = make_pose(from.translation(), from.linear() * so3_exp({0.2, 0.1, 0.3}));
  const PathMotionOptions options{.task = task_named("111110:tool")};
  const PathMotion motion = move_in_lines(arm, start, std::vector{to}, options);
  ASSERT_EQ(motion.status, MotionStatus::reached) << motion.reason;
  EXPECT_LE(motion.deviation.bound.orientation, options.orientation_tolerance);
}

TEST(MoveInLines, KeepsATighterTolerance) {
  const Arm arm = built_in("rrr");
  const Configuration start{{0, 90 * deg, 0}};
  const std::vector<Pose> waypoints{planar(4.5, 5.2, 0)};
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const PathMotionOptions options{.tolerance = tolerance, .orientation_tolerance = 1e-3};
    const PathMotion motion = move_in_lines(arm, start, waypoints, options);
    expect_straight(arm, start, waypoints, motion, options, 5);
  }
}

TEST(MoveInLines, KeepsTheToolsSpeedAlsoBetweenSamples) {
  for (const std::string name : {"rrr", "panda"}) {
    const Arm arm = built_in(name);
    const Configuration start = name == "rrr"
                                    ? Configuration{{0, 1.5, 0}}
                                    : Configuration{{0, -0.785, 0, -2.356, 0, 1.571, 0.785}};
    Pose to = forward_kinematics(arm, start);
    to.translation() += Vector3(-0.2, 0.1, 0);
    for (const std::string task : {"", "110000"}) {
      PathMotionOptions options{.tool_speed = 0.05};
      if (!task.empty()) options.task = task_named(task);
      const PathMotion motion = move_in_lines(arm, start, std::vector{to}, options);
      ASSERT_EQ(motion.status, MotionStatus::reached) << motion.reason;
      const Trajectory& way = motion.trajectory;
      double fastest = 0;
      for (std::size_t k = 1; k < way.size(); ++k) {
        constexpr double step = 1e-4;
        const double h = way.times[k] - way.times[k - 1];
        for (const double u : {0.001, 0.25, 0.5, 0.75, 0.999}) {
          const Configuration q = motion_between(way, k - 1, u);
          const Configuration v =
              (motion_between(way, k - 1, u + step) - motion_between(way, k - 1, u - step)) /
              (2 * step * h);
          fastest = std::max(fastest, (jacobian(arm, q) * v).head<3>().norm());
        }
      }
      EXPECT_LE(fastest, 0.05 * (1 + 1e-6)) << name << " " << task;
      EXPECT_GT(fastest, 0.04) << name << " " << task;
    }
  }
}

TEST(MoveInLines, ReportsARateAtWhichTheWholeMotionIsPossible) {
  const Arm arm = built_in("rrr");
  const Configuration start{{0, 90 * deg, 0}};
  const std::vector<Pose> waypoints{planar(4.5, 5.2, 0), planar(2, 6, 0.5), planar(4.5, 5.2, 0)};
  for (const int most : {80, 160}) {
    PathMotionOptions options{
        .tolerance = 0.01, .orientation_tolerance = 0.01, .rate = 500, .max_samples = most};
    const PathMotion dense = move_in_lines(arm, start, waypoints, options);
    ASSERT_EQ(dense.reason.code, ReasonCode::too_many_samples_at_rate) << dense.reason;
    const auto possible = testing::field<double>(dense.reason, ReasonField::possible_rate);
    ASSERT_TRUE(possible) << dense.reason;
    options.rate = *possible;
    EXPECT_TRUE(move_in_lines(arm, start, waypoints, options)) << dense.reason;
  }
}

TEST(MoveInLines, StopsAtTheSamplesAllowed) {
  const Arm arm = built_in("rrr");
  const Configuration start{{0, 90 * deg, 0}};
  const std::vector<Pose> waypoints{planar(4.5, 5.2, 0), planar(2, 6, 0.5)};
  const int all = 400;
  EXPECT_TRUE(move_in_lines(arm, start, waypoints, {.max_samples = all}));
  for (const int most : {2, 10, 20}) {
    const PathMotion motion = move_in_lines(arm, start, waypoints, {.max_samples = most});
    expect_nothing_made(motion, MotionStatus::too_many_samples);
    EXPECT_EQ(testing::field<std::size_t>(motion.reason, ReasonField::max_samples),
              static_cast<std::size_t>(most))
        << motion.reason;
  }
}

TEST(MoveInLines, TellsItsProgress) {
  const Arm arm = built_in("rrr");
  std::vector<double> told;
  const std::vector<Pose> waypoints{planar(4.5, 5.2, 0), planar(2, 6, 0.5)};
  move_in_lines(arm, Configuration{{0, 90 * deg, 0}}, waypoints,
                {.budget = {.progress = [&told](double share) { told.push_back(share); }}});
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_GE(told.front(), 0);
  EXPECT_LE(told.back(), 1);
}

TEST(MoveInLines, RefusesWhatMakesNoSense) {
  const Arm arm = built_in("panda");
  const Configuration start{{0, -0.785, 0, -2.356, 0, 1.571, 0.785}};
  const Pose from = forward_kinematics(arm, start);
  const auto moved = [&](std::vector<Pose> waypoints, PathMotionOptions options = {}) {
    return move_in_lines(arm, start, waypoints, options);
  };
  Pose nan = from, skew = from;
  nan.translation().x() = NAN;
  skew.linear().col(0) *= 1.1;
  EXPECT_REFUSED(moved({}), "waypoint");
  EXPECT_REFUSED(moved({from, nan}), "waypoint 2");
  EXPECT_REFUSED(moved({skew}), "rigid");
  EXPECT_REFUSED(moved({from}, {.tolerance = 0}), "tolerance");
  EXPECT_REFUSED(moved({from}, {.orientation_tolerance = NAN}), "orientation_tolerance");
  EXPECT_REFUSED(moved({from}, {.tool_speed = -1}), "speed");
  EXPECT_REFUSED(moved({from}, {.max_samples = 1}), "max_samples must be at least 2");
  Task nothing = Task::spatial();
  nothing.rows.fill(false);
  EXPECT_REFUSED(moved({from}, {.task = nothing}), "row");
  EXPECT_REFUSED(move_in_lines(arm, Configuration::Zero(7), std::vector{from}), "cannot start");
  EXPECT_REFUSED(move_in_lines(arm, Configuration::Zero(6), std::vector{from}), "7 joint values");
  EXPECT_REFUSED(move_in_lines(arm, Configuration::Constant(7, NAN), std::vector{from}), "finite");
}

}  // namespace
}  // namespace beeline
