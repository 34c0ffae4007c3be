#include <sstream>

#include <beeline/certificate/verify.h>

#include <tests/planning/motion_promises.h>
#include <tests/reason.h>

namespace beeline {
namespace {

using namespace testing;

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

// Random lines: each is either followed, or refused with a reason that holds.
TEST(MoveInLines, MeetsItsGuaranteesOnRandomLinesOfBuiltInArms) {
  testing::Random random;
  for (const std::string name : {"rrr", "panda", "ur5", "puma560", "iiwa14", "scara", "stanford"}) {
    const Arm arm = built_in(name);
    int reached = 0;
    const int lines = cases(25);
    for (int i = 0; i < lines; ++i) {
      const Configuration start = testing::inner_configuration(random, arm);
      const Pose to = testing::nearby_pose(random, arm, forward_kinematics(arm, start));
      const std::vector<Pose> waypoints{to};
      const PathMotion motion = move_in_lines(arm, start, waypoints);
      if (motion.status == MotionStatus::reached) {
        ++reached;
        expect_straight(arm, start, waypoints, motion);
      } else {
        expect_nothing_made(motion, motion.status);
        ASSERT_NE(motion.status, MotionStatus::not_proved) << motion.reason;
        ASSERT_NE(motion.status, MotionStatus::too_many_samples) << motion.reason;
        ASSERT_GE(stopped_at(motion), 0) << motion.reason;
      }
    }
    EXPECT_GE(reached, lines / 5) << name;
  }
}

TEST(MoveInLines, TakesPosesInBracesAndAnswersInABool) {
  const Arm arm = built_in("rrr");
  const Configuration start{{0, 90 * deg, 0}};
  const Pose a = planar(4.5, 5.2, 0), b = planar(2, 6, 0.5);
  const std::vector<Pose> waypoints{a, b};
  const PathMotion motion = move_in_lines(arm, start, {a, b});
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion.trajectory.positions, move_in_lines(arm, start, waypoints).trajectory.positions);
  EXPECT_TRUE(move_in_lines(arm, {a, b}));
  const PathMotion listed = move_in_lines(built_in("rrr"), {0, 1.57, 0}, {a}, {.rate = 100});
  const PathMotion given =
      move_in_lines(built_in("rrr"), Configuration{{0, 1.57, 0}}, std::vector{a}, {.rate = 100});
  EXPECT_EQ(listed.trajectory.positions, given.trajectory.positions);
  EXPECT_EQ(listed.duration(), listed.trajectory.duration());
  const Verification verification = verify(arm, motion.trajectory, {a, b});
  EXPECT_TRUE(verification);
  EXPECT_FALSE(verify(arm, motion.trajectory, {b, a}));
  const PathMotion none = move_in_lines(arm, start, {planar(12, 0, 0)});
  EXPECT_FALSE(none);
  std::ostringstream out;
  out << motion << '\n' << none << '\n' << verification;
  EXPECT_EQ(out.str().substr(0, 11), "reached in ");
  EXPECT_NE(out.str().find("\n" + name(none.status) + ": " + sentence(none.reason) + "\n"),
            std::string::npos)
      << out.str();
  EXPECT_NE(out.str().find("\nverified, deviation at most "), std::string::npos) << out.str();
}

TEST(MoveInLines, GivesTheSameAnswerTwice) {
  const Arm arm = built_in("panda");
  const Configuration start{{0, -0.785, 0, -2.356, 0, 1.571, 0.785}};
  const Pose from = forward_kinematics(arm, start);
  const std::vector<Pose> waypoints{make_pose(from.translation() + Vector3(0.1, 0.2, -0.1),
                                              so3_exp({0.3, -0.2, 0.5}) * from.linear())};
  const PathMotion a = move_in_lines(arm, start, waypoints);
  const PathMotion b = move_in_lines(arm, start, waypoints);
  expect_straight(arm, start, waypoints, a);
  EXPECT_EQ(a.trajectory.positions, b.trajectory.positions);
  EXPECT_EQ(a.trajectory.times, b.trajectory.times);
}

// Without a rotation the wrist of rrr moves on a line too, and leaves the disc of radius 7.
TEST(MoveInLines, ReportsWhereALineLeavesTheWorkspace) {
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
    // |wrist + s direction| = 7
    const double a = way.squaredNorm(), b = wrist.dot(way), c = wrist.squaredNorm() - 49;
    const double s = (-b + std::sqrt(b * b - a * c)) / a;
    const double nearest = std::sqrt(std::max(0.0, wrist.squaredNorm() - b * b / a));
    if (nearest < 0.1 && b < 0) continue;  // past the folded arm: a test of its own
    const PathMotion motion = move_in_lines(arm, start, std::vector{to});
    expect_nothing_made(motion, MotionStatus::unreachable);
    ASSERT_NEAR(stopped_at(motion), s, 1e-4) << motion.reason;
    ASSERT_EQ(testing::field<std::size_t>(motion.reason, ReasonField::segment), 1U);
  }
}

// The elbow's limit is met where the wrist is at the distance that the limit leaves it.
TEST(MoveInLines, NamesTheJointWhoseLimitStopsTheMotion) {
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
    const PathMotion motion =
        move_in_lines(arm, start, std::vector{make_pose(from.translation() + way, from.linear())});
    expect_nothing_made(motion, MotionStatus::outside_limits);
    ASSERT_NEAR(stopped_at(motion), s, 1e-5) << motion.reason;
    ASSERT_EQ(testing::joint(motion.reason), "joint2");
    ASSERT_EQ(testing::field<bool>(motion.reason, ReasonField::is_upper), !outwards)
        << motion.reason;
  }
}

TEST(MoveInLines, NamesASlidesLimitInMetres) {
  std::vector<Joint> joints = built_in("rp").joints();
  joints[1].limits = {.lower = 0, .upper = 2};
  const Arm arm("rp", joints);
  const Pose to = planar(9, 0, 0);
  const PathMotion motion = move_in_lines(arm, Configuration{{0, 1}}, std::vector{to});
  expect_nothing_made(motion, MotionStatus::outside_limits);
  EXPECT_EQ(testing::joint(motion.reason), "joint2");
  EXPECT_EQ(testing::field<double>(motion.reason, ReasonField::limit), 2.0);
  EXPECT_NEAR(stopped_at(motion), 1.0 / 7, 1e-6);
}

// The wrist at the base: the folded arm may have any direction there, but can continue in only one.
TEST(MoveInLines, StopsAtASingularityWhereItWouldHaveToJump) {
  const Arm arm = built_in("rrr");
  const std::vector<Pose> waypoints{planar(2, 0, 0), planar(2, -3, 0)};
  const Configuration start{{-70 * deg, 140 * deg, -70 * deg}};
  const PathMotion motion = move_in_lines(arm, start, waypoints);
  expect_nothing_made(motion, MotionStatus::singular);
  EXPECT_EQ(testing::field<std::size_t>(motion.reason, ReasonField::segment), 2U);
  EXPECT_EQ(motion.reason.code, ReasonCode::singular_on_path) << motion.reason;
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

TEST(MoveInLines, RotatesInPlaceByUpToPi) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Configuration start{{0, -0.785, 0, -2.356, 0, 1.571, 0}};
  const Pose from = forward_kinematics(arm, start);
  for (const double angle : {1e-7, 0.1, 1.0, 2.0, pi}) {
    const Pose to = make_pose(from.translation(), so3_exp({0, 0, angle}) * from.linear());
    const PathMotion motion = move_in_lines(arm, start, std::vector{to});
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

TEST(MoveInLines, AcceptsLinesThatHardlyTranslateOrRotate) {
  const Arm arm = built_in("panda");
  const Configuration start{{0.3, -0.785, 0.2, -2.356, -0.3, 1.571, 0.785}};
  const Pose from = forward_kinematics(arm, start);
  for (const double way : {0.0, 1e-12, 1e-8, 1e-6, 1e-4, 1e-2}) {
    for (const double turn : {0.0, 1e-12, 1e-8, 1e-4, 1e-2, 0.3}) {
      const Pose to = make_pose(from.translation() + way * Vector3(0.6, 0, 0.8),
                                so3_exp({0, turn, 0}) * from.linear());
      const PathMotion motion = move_in_lines(arm, start, std::vector{to});
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
  const PathMotion still = move_in_lines(arm, start, std::vector{from});
  EXPECT_EQ(still.status, MotionStatus::reached);
  EXPECT_EQ(still.trajectory.size(), 1);
  const PathMotion motion = move_in_lines(arm, start, std::vector{from, away, away, from, from});
  expect_straight(arm, start, {from, away, away, from, from}, motion);
  EXPECT_EQ(motion.arrivals[0], 0);
  EXPECT_EQ(motion.arrivals[1], motion.arrivals[2]);
  EXPECT_EQ(motion.arrivals[3], motion.arrivals[4]);
}

TEST(MoveInLines, ArrivesOnceOnEachLineFromTheFirstPose) {
  const Arm arm = built_in("rrr");
  const std::vector<Pose> poses{planar(4.5, 5.2, 0), planar(2, 6, 0.5), planar(3, 5, 0.2)};
  const PathMotion motion = move_in_lines(arm, poses);
  ASSERT_EQ(motion.status, MotionStatus::reached) << motion.reason;
  ASSERT_EQ(motion.arrivals.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Configuration& q = motion.trajectory.positions[motion.arrivals[i]];
    EXPECT_LT(pose_difference(forward_kinematics(arm, q), poses[i + 1]).norm(), 1e-3) << i;
  }
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

}  // namespace
}  // namespace beeline
