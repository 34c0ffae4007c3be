#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/model/composite.h>
#include <beeline/motion/line.h>
#include <beeline/motion/time_law.h>
#include <beeline/pose/orientation.h>
#include <beeline/pose/se2.h>

#include <tests/motion/random_line.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using std::numbers::pi;
constexpr double deg = pi / 180;

Pose planar(double x, double y, double theta) { return to_space({x, y, theta}); }

Arm chain(int joints, double limit = Limits::none) {
  std::vector<Joint> links;
  for (int i = 1; i <= joints; ++i) {
    Joint joint = composite_joint('R', "j" + std::to_string(i)).front();
    joint.limits = {.lower = -limit, .upper = limit};
    links.push_back(planar_link(joint, 1));
  }
  return {"chain" + std::to_string(joints), links};
}

void expect_within_limits(const Arm& arm, const Trajectory& trajectory) {
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    ASSERT_TRUE(limit_violations(arm, trajectory.positions[k], 0).empty()) << "sample " << k;
    if (k == 0) continue;
    const double dt = trajectory.times[k] - trajectory.times[k - 1];
    const Configuration step = trajectory.positions[k] - trajectory.positions[k - 1];
    for (int i = 0; i < arm.dof(); ++i) {
      const double limit = arm.limits()[static_cast<std::size_t>(i)].velocity;
      const double most = std::isfinite(limit) ? limit : velocity_when_unknown;
      ASSERT_LE(std::abs(step[i]) / dt, most * (1 + 1e-9)) << "sample " << k;
      if (kind(arm.joint_of(i)) != JointKind::prismatic) {
        ASSERT_LE(std::abs(step[i]), 0.1) << "a jump at sample " << k;
      }
    }
  }
}

/// How far the tool is from the segment and from the orientation there, for lines that move.
Deviation off_segment(const Line& line, const Pose& pose) {
  const Vector3 way = line.to.translation() - line.from.translation();
  const Vector3 done = pose.translation() - line.from.translation();
  const double s = std::clamp(done.dot(way) / way.squaredNorm(), 0.0, 1.0);
  const Vector3 whole = so3_log(line.to.linear() * line.from.linear().transpose());
  const Rotation there = so3_exp(s * whole) * line.from.linear();
  return {(done - s * way).norm(), so3_log(pose.linear() * there.transpose()).norm()};
}

/// Everything that a motion must keep, checked from outside and between the samples.
void expect_straight(const Arm& arm, const Configuration& start, const std::vector<Pose>& waypoints,
                     const LineMotion& motion, const LineOptions& options = {}, int dense = 20) {
  ASSERT_EQ(motion.status, MotionStatus::reached) << arm.name() << ": " << motion.reason;
  EXPECT_EQ(motion.reason, "");
  const Trajectory& trajectory = motion.trajectory;
  ASSERT_NO_THROW(check_trajectory(trajectory));
  ASSERT_LT((trajectory.positions.front() - start).norm(), 1e-8);
  expect_within_limits(arm, trajectory);
  ASSERT_EQ(motion.arrivals.size(), waypoints.size());
  EXPECT_LE(motion.straightness.sampled.position, 1e-9);
  EXPECT_LE(motion.straightness.sampled.orientation, 1e-8);
  EXPECT_LE(motion.straightness.bound.position, options.tolerance);
  EXPECT_LE(motion.straightness.bound.orientation, options.orientation_tolerance);

  Line line{forward_kinematics(arm, start), {}};
  std::size_t k = 0;
  for (std::size_t w = 0; w < waypoints.size(); ++w) {
    line.to = waypoints[w];
    ASSERT_GE(motion.arrivals[w], k);
    const bool moves = (line.to.translation() - line.from.translation()).norm() > 0.01;
    for (; k < motion.arrivals[w]; ++k) {
      const Configuration& q = trajectory.positions[k];
      const Configuration step = trajectory.positions[k + 1] - q;
      for (int i = 0; i < dense && moves; ++i) {
        const Pose pose = forward_kinematics(arm, q + double(i) / dense * step);
        const Deviation off = off_segment(line, pose);
        const Deviation& most = i == 0 ? Deviation{1e-9, 1e-8} : motion.straightness.bound;
        ASSERT_LE(off.position, most.position + 1e-12) << "sample " << k << " + " << i;
        ASSERT_LE(off.orientation, most.orientation + 1e-12) << "sample " << k << " + " << i;
      }
    }
    const Pose end = forward_kinematics(arm, trajectory.positions[motion.arrivals[w]]);
    ASSERT_LE((end.translation() - line.to.translation()).norm(), 1e-9);
    ASSERT_LE(so3_log(end.linear() * line.to.linear().transpose()).norm(), 1e-9);
    ASSERT_TRUE(trajectory.velocities[motion.arrivals[w]].isZero(0)) << "at rest at a waypoint";
    line.from = line.to;
  }
  EXPECT_EQ(motion.arrivals.back() + 1, trajectory.size());
}

double told_fraction(const LineMotion& motion) {
  const std::size_t at = motion.reason.find("stops after ");
  return at == std::string::npos ? -1 : std::stod(motion.reason.substr(at + 12)) / 100;
}

void expect_nothing_made(const LineMotion& motion, MotionStatus status) {
  EXPECT_EQ(motion.status, status) << motion.reason;
  EXPECT_NE(motion.reason, "");
  EXPECT_EQ(motion.trajectory.size(), 0);
  EXPECT_TRUE(motion.arrivals.empty());
}

TEST(MoveInLines, DrawsTheChaptersLinesWithThePlanarArm) {
  const Arm arm = built_in("rrr");
  const Configuration start{{0, 90 * deg, 0}};
  const std::vector<std::vector<Pose>> sets = {
      {planar(4.5, 5.2, 0), planar(2, 6, 0.5), planar(5, 2, -0.5)},
      {planar(6, 3, pi / 2), planar(6, 3, 0), planar(-2, 6, 1)},
      {planar(5.5, 3.5, 1.5)},
      {planar(-4, -4, -2), planar(5.5, 3.5, pi / 2)}};
  for (const std::vector<Pose>& waypoints : sets) {
    expect_straight(arm, start, waypoints, move_in_lines(arm, start, waypoints));
  }
}

// Of random lines, those that cannot be gone must be told so for a true reason; the others be kept.
TEST(MoveInLines, KeepsEveryPromiseOnRandomLinesOfBuiltInArms) {
  testing::Random random;
  for (const std::string name : {"rrr", "panda", "ur5", "puma560", "iiwa14", "scara", "stanford"}) {
    const Arm arm = built_in(name);
    int reached = 0;
    const int lines = 25;
    for (int i = 0; i < lines; ++i) {
      const Configuration start = testing::inner_configuration(random, arm);
      const Pose to = testing::nearby_pose(random, arm, forward_kinematics(arm, start));
      const std::vector<Pose> waypoints{to};
      const LineMotion motion = move_in_lines(arm, start, waypoints);
      if (motion.status == MotionStatus::reached) {
        ++reached;
        expect_straight(arm, start, waypoints, motion);
      } else {
        expect_nothing_made(motion, motion.status);
        ASSERT_NE(motion.status, MotionStatus::not_converged) << motion.reason;
        ASSERT_GE(told_fraction(motion), 0) << motion.reason;
      }
    }
    EXPECT_GE(reached, lines / 5) << name;
  }
}

TEST(MoveInLines, GivesTheSameAnswerTwice) {
  const Arm arm = built_in("panda");
  const Configuration start{{0, -0.785, 0, -2.356, 0, 1.571, 0.785}};
  const Pose from = forward_kinematics(arm, start);
  const std::vector<Pose> waypoints{make_pose(from.translation() + Vector3(0.1, 0.2, -0.1),
                                              so3_exp({0.3, -0.2, 0.5}) * from.linear())};
  const LineMotion a = move_in_lines(arm, start, waypoints);
  const LineMotion b = move_in_lines(arm, start, waypoints);
  expect_straight(arm, start, waypoints, a);
  EXPECT_EQ(a.trajectory.positions, b.trajectory.positions);
  EXPECT_EQ(a.trajectory.times, b.trajectory.times);
}

// Without a turn the wrist of rrr goes straight as well, and leaves the disc of radius 7.
TEST(MoveInLines, TellsWhereALineLeavesTheWorkspace) {
  testing::Random random;
  const Arm arm = built_in("rrr");
  for (int i = 0; i < 40; ++i) {
    Configuration start = random.configuration(arm);
    start[1] = std::copysign(random.uniform(0.5, 2.5), start[1]);
    const Pose from = forward_kinematics(arm, start);
    Vector3 way = random.direction();
    way.z() = 0;
    way *= 20 / way.norm();
    const Pose to = make_pose(from.translation() + way, from.linear());
    const Vector3 wrist = from.translation() - 2 * from.linear().col(0);
    // |wrist + s way| = 7
    const double a = way.squaredNorm(), b = wrist.dot(way), c = wrist.squaredNorm() - 49;
    const double s = (-b + std::sqrt(b * b - a * c)) / a;
    const double nearest = std::sqrt(std::max(0.0, wrist.squaredNorm() - b * b / a));
    if (nearest < 0.1 && b < 0) continue;  // past the folded arm: a test of its own
    const LineMotion motion = move_in_lines(arm, start, std::vector{to});
    expect_nothing_made(motion, MotionStatus::unreachable);
    ASSERT_NEAR(told_fraction(motion), s, 1e-4) << motion.reason;
    ASSERT_NE(motion.reason.find("line 1 of 1"), std::string::npos);
  }
}

// The elbow's limit is met where the wrist is at the distance that the limit leaves it.
TEST(MoveInLines, NamesTheJointWhoseLimitIsInTheWay) {
  testing::Random random;
  std::vector<Joint> joints = built_in("rrr").joints();
  joints[1].limits = {.lower = 0.5, .upper = 2};
  const Arm arm("limited", joints);
  for (int i = 0; i < 20; ++i) {
    const Configuration start{{random.uniform(-3, 3), random.uniform(0.8, 1.7), 0.3}};
    const Pose from = forward_kinematics(arm, start);
    const Vector3 wrist = from.translation() - 2 * from.linear().col(0);
    const bool outwards = i % 2 == 0;
    const double elbow = outwards ? 0.5 : 2;
    const double distance = 7 * std::cos(elbow / 2);
    const Vector3 way = wrist.normalized() * (outwards ? 3 : -3);
    const double s = (distance - wrist.norm()) / (outwards ? 3 : -3);
    const LineMotion motion =
        move_in_lines(arm, start, std::vector{make_pose(from.translation() + way, from.linear())});
    expect_nothing_made(motion, MotionStatus::outside_limits);
    ASSERT_NEAR(told_fraction(motion), s, 1e-5) << motion.reason;
    ASSERT_NE(motion.reason.find(outwards ? "joint2 would have to pass its lower limit of 0.5 rad"
                                          : "joint2 would have to pass its upper limit of 2 rad"),
              std::string::npos)
        << motion.reason;
  }
}

TEST(MoveInLines, NamesASlidesLimitInMetres) {
  std::vector<Joint> joints = built_in("rp").joints();
  joints[1].limits = {.lower = 0, .upper = 2};
  const Arm arm("rp", joints);
  const Pose to = planar(9, 0, 0);
  const LineMotion motion = move_in_lines(arm, Configuration{{0, 1}}, std::vector{to});
  expect_nothing_made(motion, MotionStatus::outside_limits);
  EXPECT_NE(motion.reason.find("joint2 would have to pass its upper limit of 2 m"),
            std::string::npos)
      << motion.reason;
  EXPECT_NEAR(told_fraction(motion), 1.0 / 7, 1e-6);
}

// The wrist at the base: there the folded arm may point anywhere, but turns on only one way.
TEST(MoveInLines, StopsAtASingularityWhereItWouldHaveToJump) {
  const Arm arm = built_in("rrr");
  const std::vector<Pose> waypoints{planar(2, 0, 0), planar(2, -3, 0)};
  const Configuration start{{-70 * deg, 140 * deg, -70 * deg}};
  const LineMotion motion = move_in_lines(arm, start, waypoints);
  expect_nothing_made(motion, MotionStatus::singular);
  EXPECT_NE(motion.reason.find("line 2 of 2 stops after"), std::string::npos) << motion.reason;
  EXPECT_NE(motion.reason.find("jump"), std::string::npos) << motion.reason;
}

TEST(MoveInLines, PassesTheFoldedArmStraightThrough) {
  const Arm arm = built_in("rrr");
  const Configuration start{{-70 * deg, 140 * deg, -70 * deg}};
  const Pose from = forward_kinematics(arm, start);
  const Vector3 wrist = from.translation() - 2 * from.linear().col(0);
  const std::vector<Pose> waypoints{make_pose(from.translation() - 2 * wrist, from.linear())};
  expect_straight(arm, start, waypoints, move_in_lines(arm, start, waypoints));
}

TEST(MoveInLines, LeavesAndReachesTheStretchedArm) {
  const Arm rrr = built_in("rrr");
  const std::vector<Pose> waypoints{planar(5, 0, 0), planar(9, 0, 0), planar(6, 2, 0.3)};
  const Configuration zero = Configuration::Zero(3);
  expect_straight(rrr, zero, waypoints, move_in_lines(rrr, zero, waypoints));

  const Arm ur5 = built_in("ur5");
  const Configuration rest = Configuration::Zero(6);
  Pose inwards = forward_kinematics(ur5, rest);
  inwards.translation() += Vector3(0.2, 0, 0.1);
  expect_straight(ur5, rest, {inwards}, move_in_lines(ur5, rest, std::vector{inwards}));
}

TEST(MoveInLines, TurnsInPlaceByUpToHalfATurn) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Configuration start{{0, -0.785, 0, -2.356, 0, 1.571, 0}};
  const Pose from = forward_kinematics(arm, start);
  for (const double angle : {1e-7, 0.1, 1.0, 2.0, pi}) {
    const Pose to = make_pose(from.translation(), so3_exp({0, 0, angle}) * from.linear());
    const LineMotion motion = move_in_lines(arm, start, std::vector{to});
    expect_straight(arm, start, {to}, motion);
    const Vector3 whole = pose_difference(to, from).tail<3>();
    for (const Configuration& q : motion.trajectory.positions) {
      const Pose pose = forward_kinematics(arm, q);
      ASSERT_LT((pose.translation() - from.translation()).norm(), 1e-9);
      const Vector3 turned = pose_difference(pose, from).tail<3>();
      ASSERT_LT(turned.cross(whole.normalized()).norm(), 1e-8) << "about the one axis alone";
    }
  }
}

TEST(MoveInLines, TakesLinesThatHardlyMoveOrTurn) {
  const Arm arm = built_in("panda");
  const Configuration start{{0.3, -0.785, 0.2, -2.356, -0.3, 1.571, 0.785}};
  const Pose from = forward_kinematics(arm, start);
  for (const double way : {0.0, 1e-12, 1e-8, 1e-6, 1e-4, 1e-2}) {
    for (const double turn : {0.0, 1e-12, 1e-8, 1e-4, 1e-2, 0.3}) {
      const Pose to = make_pose(from.translation() + way * Vector3(0.6, 0, 0.8),
                                so3_exp({0, turn, 0}) * from.linear());
      const LineMotion motion = move_in_lines(arm, start, std::vector{to});
      expect_straight(arm, start, {to}, motion);
      ASSERT_LT(motion.trajectory.size(), 2000) << way << " m, " << turn << " rad";
    }
  }
}

TEST(MoveInLines, AddsNothingForWaypointsWhereTheToolIsAlready) {
  const Arm arm = built_in("ur5");
  const Configuration start{{0.5, -1, 1.5, -0.5, 1, 0}};
  const Pose from = forward_kinematics(arm, start);
  const Pose away = make_pose(from.translation() + Vector3(0, 0, 0.1), from.linear());
  const LineMotion still = move_in_lines(arm, start, std::vector{from});
  EXPECT_EQ(still.status, MotionStatus::reached);
  EXPECT_EQ(still.trajectory.size(), 1);
  const LineMotion motion = move_in_lines(arm, start, std::vector{from, away, away, from, from});
  expect_straight(arm, start, {from, away, away, from, from}, motion);
  EXPECT_EQ(motion.arrivals[0], 0);
  EXPECT_EQ(motion.arrivals[1], motion.arrivals[2]);
  EXPECT_EQ(motion.arrivals[3], motion.arrivals[4]);
}

TEST(MoveInLines, MovesOneJointArmsAlongWhatTheyCan) {
  const Arm slide("slide", {planar_link(composite_joint('P', "s").front(), 1)});
  const Configuration zero = Configuration::Zero(1);
  const Pose ahead = planar(4, 0, 0);
  expect_straight(slide, zero, {ahead}, move_in_lines(slide, zero, std::vector{ahead}));
  const Arm turn("turn", {planar_link(composite_joint('R', "r").front(), 0)});
  const Pose turned = planar(0, 0, 2);
  expect_straight(turn, zero, {turned}, move_in_lines(turn, zero, std::vector{turned}));
  expect_nothing_made(move_in_lines(turn, zero, std::vector{ahead}), MotionStatus::unreachable);
}

TEST(MoveInLines, MovesAChainOfThirtyJoints) {
  testing::Random random;
  const Arm arm = chain(30, 1);
  Configuration start(30);
  for (double& value : start) value = random.uniform(-0.3, 0.3);
  const Pose from = forward_kinematics(arm, start);
  const std::vector<Pose> waypoints{
      make_pose(0.8 * from.translation(), so3_exp({0, 0, 0.5}) * from.linear()), from};
  expect_straight(arm, start, waypoints, move_in_lines(arm, start, waypoints), {}, 3);
}

/// The line with joint motions of least size alone, by eq. 1.5 in tiny steps.
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
  for (int i = 0; i < 60; ++i) {
    const Configuration start = 0.9 * random.configuration(arm);
    Configuration goal;
    do {
      goal = 0.9 * random.configuration(arm);
    } while (std::abs(goal.sum() - start.sum()) > 3);
    const Pose to = forward_kinematics(arm, goal);
    const LineMotion motion = move_in_lines(arm, start, std::vector{to});
    if (motion.status == MotionStatus::reached) {
      ++ours;
      expect_within_limits(arm, motion.trajectory);
    }
    least += reached_by_least_motion(arm, start, to) ? 1 : 0;
  }
  EXPECT_GT(ours, 1.5 * least) << least << " lines with least motions, " << ours << " with ours";
}

TEST(MoveInLines, LeavesFreeWhatTheTaskDoesNotAsk) {
  const Arm arm = built_in("ur5");
  const Configuration start{{0.5, -1, 1.5, -0.5, 1, 0}};
  const Pose from = forward_kinematics(arm, start);
  const Pose to = make_pose(from.translation() + Vector3(0.15, 0.1, -0.1),
                            so3_exp({0.2, -0.1, 1}) * from.linear());
  for (const std::string task :
       {"position", "111110:tool", "110000", "001000", "000111", "110111:tool", "111001"}) {
    const LineOptions options{.task = task_named(task)};
    const LineMotion motion = move_in_lines(arm, start, std::vector{to}, options);
    ASSERT_EQ(motion.status, MotionStatus::reached) << task << ": " << motion.reason;
    expect_within_limits(arm, motion.trajectory);
    EXPECT_LE(motion.straightness.sampled.position, 1e-8) << task;
    EXPECT_LE(motion.straightness.sampled.orientation, 1e-7) << task;
    EXPECT_LE(motion.straightness.bound.position, options.tolerance) << task;
    EXPECT_LE(motion.straightness.bound.orientation, options.orientation_tolerance) << task;
    const Pose end = forward_kinematics(arm, motion.trajectory.positions.back());
    EXPECT_LE(task_error(*options.task, to, end).norm(), 1e-9) << task;
    const Line line{from, to};
    for (std::size_t k = 1; k < motion.trajectory.size(); k += 7) {
      const Configuration middle =
          0.5 * (motion.trajectory.positions[k - 1] + motion.trajectory.positions[k]);
      const Deviation off = deviation_from(line, forward_kinematics(arm, middle), *options.task);
      ASSERT_LE(off.position, motion.straightness.bound.position + 1e-9) << task;
      ASSERT_LE(off.orientation, motion.straightness.bound.orientation + 1e-9) << task;
    }
  }
}

TEST(MoveInLines, TurnsInPlaceAlsoWithAFreeRoll) {
  const Arm arm = built_in("ur5");
  const Configuration start{{0.5, -1, 1.5, -0.5, 1, 0}};
  const Pose from = forward_kinematics(arm, start);
  const Pose to = make_pose(from.translation(), from.linear() * so3_exp({0.2, 0.1, 0.3}));
  const LineOptions options{.task = task_named("111110:tool")};
  const LineMotion motion = move_in_lines(arm, start, std::vector{to}, options);
  ASSERT_EQ(motion.status, MotionStatus::reached) << motion.reason;
  EXPECT_LE(motion.straightness.sampled.orientation, 1e-7);
  EXPECT_LE(motion.straightness.bound.orientation, options.orientation_tolerance);
}

TEST(MoveInLines, KeepsATighterToleranceWithMoreSamples) {
  const Arm arm = built_in("rrr");
  const Configuration start{{0, 90 * deg, 0}};
  const std::vector<Pose> waypoints{planar(4.5, 5.2, 0)};
  std::size_t before = 0;
  for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
    const LineOptions options{.tolerance = tolerance, .orientation_tolerance = 1e-3};
    const LineMotion motion = move_in_lines(arm, start, waypoints, options);
    expect_straight(arm, start, waypoints, motion, options, 5);
    EXPECT_GT(motion.trajectory.size(), before);
    before = motion.trajectory.size();
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
      LineOptions options{.tool_speed = 0.05};
      if (!task.empty()) options.task = task_named(task);
      const LineMotion motion = move_in_lines(arm, start, std::vector{to}, options);
      ASSERT_EQ(motion.status, MotionStatus::reached) << motion.reason;
      const Trajectory& way = motion.trajectory;
      double fastest = 0;
      for (std::size_t k = 1; k < way.size(); ++k) {
        const Configuration v =
            (way.positions[k] - way.positions[k - 1]) / (way.times[k] - way.times[k - 1]);
        for (const double t : {0.0, 0.5, 1.0}) {
          const Configuration q = (1 - t) * way.positions[k - 1] + t * way.positions[k];
          fastest = std::max(fastest, (jacobian(arm, q) * v).head<3>().norm());
        }
      }
      EXPECT_LE(fastest, 0.05 * (1 + 1e-9)) << name << " " << task;
      EXPECT_GT(fastest, 0.04) << name << " " << task;
    }
  }
}

TEST(MoveInLines, StopsAtTheSamplesAllowed) {
  const Arm arm = built_in("rrr");
  const Configuration start{{0, 90 * deg, 0}};
  const std::vector<Pose> waypoints{planar(4.5, 5.2, 0), planar(2, 6, 0.5)};
  const int all = static_cast<int>(move_in_lines(arm, start, waypoints).trajectory.size());
  EXPECT_EQ(move_in_lines(arm, start, waypoints, {.most_samples = all}).trajectory.size(), all);
  for (const int most : {2, 10, all / 2, all - 1}) {
    const LineMotion motion = move_in_lines(arm, start, waypoints, {.most_samples = most});
    expect_nothing_made(motion, MotionStatus::not_converged);
    EXPECT_NE(motion.reason.find("more than " + std::to_string(most)), std::string::npos)
        << motion.reason;
  }
}

TEST(MoveInLines, TellsItsProgress) {
  const Arm arm = built_in("rrr");
  std::vector<double> told;
  const std::vector<Pose> waypoints{planar(4.5, 5.2, 0), planar(2, 6, 0.5)};
  move_in_lines(arm, Configuration{{0, 90 * deg, 0}}, waypoints,
                {.progress = [&told](double share) { told.push_back(share); }});
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_GE(told.front(), 0);
  EXPECT_LE(told.back(), 1);
}

TEST(MoveInLines, RefusesWhatMakesNoSense) {
  const Arm arm = built_in("panda");
  const Configuration start{{0, -0.785, 0, -2.356, 0, 1.571, 0.785}};
  const Pose from = forward_kinematics(arm, start);
  const auto moved = [&](std::vector<Pose> waypoints, LineOptions options = {}) {
    return move_in_lines(arm, start, waypoints, options);
  };
  Pose nan = from, skew = from;
  nan.translation().x() = NAN;
  skew.linear().col(0) *= 1.1;
  EXPECT_REFUSED(moved({}), "waypoint");
  EXPECT_REFUSED(moved({from, nan}), "waypoint 2");
  EXPECT_REFUSED(moved({skew}), "rigid");
  EXPECT_REFUSED(moved({from}, {.tolerance = 0}), "tolerances");
  EXPECT_REFUSED(moved({from}, {.orientation_tolerance = NAN}), "tolerances");
  EXPECT_REFUSED(moved({from}, {.tool_speed = -1}), "speed");
  EXPECT_REFUSED(moved({from}, {.most_samples = 1}), "two samples");
  Task nothing = Task::spatial();
  nothing.rows.fill(false);
  EXPECT_REFUSED(moved({from}, {.task = nothing}), "row");
  EXPECT_REFUSED(move_in_lines(arm, Configuration::Zero(7), std::vector{from}), "joint4");
  EXPECT_REFUSED(move_in_lines(arm, Configuration::Zero(6), std::vector{from}), "7 joint values");
  EXPECT_REFUSED(move_in_lines(arm, Configuration::Constant(7, NAN), std::vector{from}), "finite");
}

}  // namespace
}  // namespace beeline
