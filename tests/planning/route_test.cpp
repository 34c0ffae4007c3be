#include <cmath>
#include <gtest/gtest.h>

#include <beeline/certificate/verify.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/path/blend.h>
#include <beeline/planning/move_along.h>

#include <tests/planning/motion_promises.h>
#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::cases, testing::motion_between;

const Configuration ready{{0, -0.785, 0, -2.356, 0, 1.571, 0.785}};

/// Five poses in front of the panda, the first the tool's own.
std::vector<Pose> square(const Arm& arm) {
  std::vector<Pose> poses{forward_kinematics(arm, ready)};
  for (const Vector3& step : {Vector3(0, 0.15, 0), Vector3(0.1, 0, -0.05), Vector3(0, -0.2, 0.1),
                              Vector3(-0.1, 0.05, 0)}) {
    Pose next = poses.back();
    next.translation() += step;
    next.linear() = next.linear() * so3_exp({0.1, 0, 0.2});
    poses.push_back(next);
  }
  return poses;
}

Route route_through(const std::vector<Pose>& poses, PathKind kind) {
  return route_of(path_through(poses, kind), kind);
}

void expect_kept(const Arm& arm, const PathMotion& motion, const Route& route) {
  ASSERT_EQ(motion.status, MotionStatus::reached) << motion.reason;
  ASSERT_NO_THROW(check_trajectory(motion.trajectory));
  EXPECT_LE(motion.deviation.bound.position, 1e-4);
  EXPECT_LE(motion.deviation.bound.orientation, 1e-4);
  EXPECT_LE(motion.deviation.measured.position, motion.deviation.bound.position);
  EXPECT_LE(motion.deviation.sampled.position, 1e-6);
  EXPECT_FALSE(first_joint_fault(arm, motion.trajectory).has_value())
      << first_joint_fault(arm, motion.trajectory)->reason;
  ASSERT_EQ(motion.arrivals.size(), route.path.segments.size());
  for (std::size_t i = 0; i < motion.arrivals.size(); ++i) {
    const Pose end = pose_at(route.path.segments[i], 1);
    const Configuration& q = motion.trajectory.positions[motion.arrivals[i]];
    const Twist off = pose_difference(end, forward_kinematics(arm, q));
    EXPECT_LT(off.norm(), 1e-9) << "segment " << i;
    const bool stop = i + 1 == motion.arrivals.size() || route.stops[i];
    EXPECT_EQ(motion.trajectory.velocities[motion.arrivals[i]].isZero(1e-12), stop);
  }
}

TEST(MoveAlong, AcceptsARateWithFewStepsOnAShortProvedPath) {
  const Arm arm = built_in("ur5");
  const Configuration start{{0, -1, 1.2, -1.5, -1.5, 0}};
  const Pose from = forward_kinematics(arm, start);
  Pose to = from;
  to.translation().z() += 1e-3;
  const Route route = route_through({from, to}, PathKind::line);
  const PathMotion motion = move_along(arm, start, route, {.rate = 20});
  ASSERT_LT(motion.trajectory.size(), 6u) << "few steps";
  expect_kept(arm, motion, route);
}

TEST(MoveAlong, FollowsEveryKindOfPathAndStopsWhereItShould) {
  const Arm arm = built_in("panda");
  const std::vector<Pose> poses = square(arm);
  for (const PathKind kind : {PathKind::line, PathKind::screw, PathKind::arc, PathKind::spline}) {
    const Route route = route_through(poses, kind);
    expect_kept(arm, move_along(arm, ready, route), route);
    expect_kept(arm, move_along(arm, std::nullopt, route), route);
  }
}

TEST(MoveAlong, PassesRoundedCornersWithoutAStop) {
  const Arm arm = built_in("panda");
  const std::vector<Pose> poses = square(arm);
  const Route rounded = route_of(blended_lines(poses, {0.01, 0.05}));
  const PathMotion motion = move_along(arm, ready, rounded);
  expect_kept(arm, motion, rounded);
  EXPECT_EQ(std::count(rounded.stops.begin(), rounded.stops.end(), true), 0);
  const Route sharp = route_through(poses, PathKind::line);
  const PathMotion stops = move_along(arm, ready, sharp);
  EXPECT_LT(motion.trajectory.times.back(), stops.trajectory.times.back());
  for (std::size_t w = 1; w + 1 < poses.size(); ++w) {  // each pose is passed within the distance
    double nearest = 1;
    const auto& samples = motion.trajectory.positions;
    for (std::size_t k = 1; k < samples.size(); ++k) {
      for (int i = 0; i < 20; ++i) {
        const Configuration q = motion_between(motion.trajectory, k - 1, i / 20.0);
        const Vector3 p = forward_kinematics(arm, q).translation();
        nearest = std::min(nearest, (p - poses[w].translation()).norm());
      }
    }
    EXPECT_LT(nearest, 0.0101);
    EXPECT_GT(nearest, 1e-4);
  }
}

// A curve of 40 mm as poses half a millimetre apart, typed to a micrometre: as fast as the arm, not
// slowed down by the rounding.
TEST(MoveAlong, FollowsClosePosesOfACurve) {
  std::vector<Pose> poses;
  for (int i = 0; i < cases(80); ++i) {
    Pose pose = Pose::Identity();
    pose.linear() = so3_exp({3.14159, 0, 0});
    pose.translation() << 0.5 + 0.05 * std::cos(0.01 * i), 0.05 * std::sin(0.01 * i), 0.4;
    for (double& x : pose.translation()) x = std::round(1e6 * x) / 1e6;
    poses.push_back(pose);
  }
  const Route route = route_of(blended_lines(poses, {0.001, 0.005}));
  for (const auto& [name, longest] : {std::pair{"panda", 0.3}, {"ur5", 2.0}}) {
    const Arm arm = built_in(name);
    const PathMotion motion = move_along(arm, std::nullopt, route);
    ASSERT_EQ(motion.status, MotionStatus::reached) << name << ": " << motion.reason;
    EXPECT_LT(motion.trajectory.times.back(), longest) << name;
  }
}

// At a rate all samples are on the path too, and the duration is nearly the same.
TEST(MoveAlong, KeepsTheRateOnEveryKindOfPath) {
  const Arm arm = built_in("panda");
  const std::vector<Pose> poses = square(arm);
  std::vector<Route> routes{route_of(blended_lines(poses, {0.01, 0.05}))};
  for (const PathKind kind : {PathKind::line, PathKind::screw, PathKind::arc, PathKind::spline}) {
    routes.push_back(route_through(poses, kind));
  }
  for (const Route& route : routes) {
    const PathMotion sparse = move_along(arm, ready, route);
    for (const double rate : {125.0, 1000.0}) {
      const PathMotion motion = move_along(arm, ready, route, {.rate = rate});
      ASSERT_EQ(motion.status, MotionStatus::reached) << motion.reason;
      EXPECT_LE(motion.deviation.sampled.position, 1e-6);
      EXPECT_LE(motion.deviation.bound.position, 1e-4);
      EXPECT_FALSE(first_joint_fault(arm, motion.trajectory).has_value());
      EXPECT_LT(motion.trajectory.times.back(), 1.1 * sparse.trajectory.times.back() + 8 / rate);
      for (std::size_t k = 0; k < motion.trajectory.size(); ++k) {
        ASSERT_NEAR(motion.trajectory.times[k], double(k) / rate, 1e-12);
      }
    }
  }
}

TEST(MoveAlong, ReversesWithAStop) {
  const Arm arm = built_in("panda");
  std::vector<Pose> poses = square(arm);
  poses = {poses[0], poses[1], poses[0]};
  const Route back = route_of(blended_lines(poses, {0.01, 0.05}));
  expect_kept(arm, move_along(arm, ready, back), back);
  EXPECT_EQ(std::count(back.stops.begin(), back.stops.end(), true), 1);
}

TEST(MoveAlong, TellsWhereItCannotGoOn) {
  const Arm arm = built_in("panda");
  std::vector<Pose> poses = square(arm);
  poses[3].translation().x() += 0.6;
  for (const PathKind kind : {PathKind::screw, PathKind::spline}) {
    const PathMotion motion = move_along(arm, ready, route_through(poses, kind));
    EXPECT_EQ(motion.status, MotionStatus::unreachable);
    EXPECT_TRUE(motion.reason.has(ReasonField::fraction)) << motion.reason;
    EXPECT_EQ(motion.trajectory.size(), 0);
  }
}

TEST(MoveAlong, RefusesAStartElsewhere) {
  const Arm arm = built_in("panda");
  const Route route = route_through(square(arm), PathKind::screw);
  Configuration other = ready;
  other[0] += 0.1;
  EXPECT_REFUSED(move_along(arm, other, route), "away from the path's beginning");
  other[3] = 1;
  EXPECT_REFUSED(move_along(arm, other, route), "cannot start");
  EXPECT_REFUSED(move_along(arm, ready, Route{}), "segments");
  EXPECT_REFUSED(move_along(arm, ready, route, {.task = task_named("111110:tool")}), "orientation");
}

TEST(MoveAlong, RefusesOptionsThatMakeNoSense) {
  const Arm arm = built_in("panda");
  const Route route = route_through(square(arm), PathKind::screw);
  EXPECT_REFUSED(move_along(arm, ready, route, {.tolerance = -1}), "tolerance");
  EXPECT_REFUSED(move_along(arm, ready, route, {.orientation_tolerance = NAN}), "tolerance");
  EXPECT_REFUSED(move_along(arm, ready, route, {.max_samples = -5}), "samples");
}

// Only rows that the task ignores change: the arm stays at rest, and the duration is zero.
TEST(MoveAlong, StaysWhereNothingThatMattersMoves) {
  const Arm arm = built_in("rrr");
  const Configuration start{{0.3, 1, 0.2}};
  const Pose from = forward_kinematics(arm, start);
  Pose turned = from;
  turned.linear() = from.linear() * so3_exp({0, 0, 0.4});
  const Route route = route_through({from, turned}, PathKind::screw);
  const PathMotion motion = move_along(arm, start, route, {.task = task_named("110000")});
  EXPECT_EQ(motion.status, MotionStatus::reached) << motion.reason;
}

}  // namespace
}  // namespace beeline
