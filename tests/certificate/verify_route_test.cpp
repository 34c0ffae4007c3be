#include <gtest/gtest.h>

#include <beeline/certificate/verify.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/math/minimum_norm.h>
#include <beeline/path/blend.h>

#include <tests/planning/motion_promises.h>

namespace beeline {
namespace {

using namespace testing;

constexpr const char* arm_names[] = {"puma560", "ur5", "panda", "iiwa14"};

Configuration start_of(const Arm& arm) {
  if (arm.dof() == 7) return Configuration{{0, 0.3, 0, -1.6, 0, 1.2, 0.785}};
  return arm.name() == "puma560" ? Configuration{{0.2, -0.6, 0.3, 0.4, 0.7, 0}}
                                 : Configuration{{0.2, -1.2, 1.5, -0.5, 1.2, 0}};
}

/// A closed path of every kind, and its motion at a rate or with few samples.
struct MadeAlong {
  Arm arm;
  Route route;
  Trajectory trajectory;
};

std::vector<MadeAlong> made_along(const std::string& name) {
  const Arm arm = built_in(name);
  const Configuration start = start_of(arm);
  const Pose a = forward_kinematics(arm, start);
  std::vector<Pose> poses{a};
  for (const Vector3& corner :
       {Vector3(0.06, 0.03, -0.01), Vector3(0.05, 0.1, -0.06), Vector3(-0.02, 0.06, -0.05)}) {
    poses.push_back(a);
    poses.back().translation() += corner;
    poses.back().linear() = so3_exp(2 * corner) * a.linear();
  }
  poses.push_back(a);
  std::vector<Route> routes{route_of(blended_lines(poses, {0.01, 0.05}))};
  for (const PathKind kind : {PathKind::line, PathKind::screw, PathKind::arc, PathKind::spline}) {
    routes.push_back(route_of(path_through(poses, kind), kind));
  }
  // A whole circle: its end is its beginning.
  const Pose& begin = pose_at(routes[3].path, 0);
  const Arc round{begin, begin, begin.translation() + Vector3(0, 0.03, 0), Vector3(0, 0, 2 * pi)};
  routes.push_back({{{round, round}, {0.2, 0.2}}, {true, true}});
  std::vector<MadeAlong> all;
  for (const Route& route : routes) {
    for (const double rate : {0.0, 1000.0}) {
      const PathMotion motion =
          move_along(arm, start, route, {.profile = Profile::quintic, .rate = rate});
      EXPECT_FALSE(motion.reason) << name << " " << all.size();
      all.push_back({arm, route, motion.trajectory});
    }
  }
  return all;
}

TEST(Verify, PassesWhatMovesAlongEveryKindOfPath) {
  for (const std::string name : arm_names) {
    int number = 0;
    for (const auto& [arm, route, trajectory] : made_along(name)) {
      const Verification found = verify(arm, trajectory, route);
      EXPECT_FALSE(found.reason) << name << " " << number;
      EXPECT_EQ(found.arrivals.size(), route.path.segments.size()) << name << " " << number;
      ++number;
    }
  }
}

TEST(Verify, PassesSegmentsOnWhichNothingThatMattersMoves) {
  const Arm arm = built_in("ur5");
  const Task task = Task::position();
  const Configuration start{{0, -1, 1.2, -1.5, -1.5, 0}};
  std::vector<Pose> poses(4, forward_kinematics(arm, start));
  const Vector3 first(0, 0.1, 0), last(0.05, 0.1, 0.05);
  poses[1] = make_pose(poses[0].translation() + first, so3_exp({0, 0, 0.3}) * poses[0].linear());
  poses[2] = make_pose(poses[1].translation(), so3_exp({0, 0, 0.8}) * poses[0].linear());
  poses[3].translation() += last;
  for (const PathKind kind : {PathKind::line, PathKind::screw}) {
    for (const double rate : {0.0, 300.0}) {
      const Route route = route_of(path_through(poses, kind), kind);
      const PathMotion motion = move_along(arm, start, route, {.task = task, .rate = rate});
      ASSERT_FALSE(motion.reason);
      const Verification found = verify(arm, motion.trajectory, route, {.task = task});
      EXPECT_FALSE(found.reason) << name(kind) << " " << rate;
      EXPECT_EQ(found.arrivals.size(), 3u);
    }
  }
}

TEST(Verify, TellsThatAMotionBeginsBehindThePathsBegin) {
  for (const auto& [arm, route, trajectory] : made_along("ur5")) {
    Trajectory rest{trajectory.joint_names, {}, {}, {}, {}};
    for (std::size_t k = trajectory.size() / 4; k < trajectory.size(); ++k) {
      rest.times.push_back(trajectory.times[k]);
      rest.positions.push_back(trajectory.positions[k]);
    }
    const Verification found = verify(arm, rest, route);
    EXPECT_EQ(found.fault, Fault::deviation);
    EXPECT_EQ(found.sample, 0u);
    EXPECT_EQ(found.reason.code, ReasonCode::off_path) << found.reason;
  }
}

TEST(Verify, TellsFaultsOnEveryKindOfPath) {
  for (const auto& [arm, route, trajectory] : made_along("ur5")) {
    const std::size_t half = trajectory.size() / 2;
    Trajectory moved = trajectory;
    const Jacobian j = jacobian(arm, moved.positions[half]);
    const Twist aside = (Twist() << 2e-4 * Vector3(1, 1, 1).normalized(), 0, 0, 0).finished();
    for (const Twist& step : {aside, Twist(-aside)}) {  // one of them leads across
      moved.positions[half] += internal::minimum_norm_solution(j, step).x;
      if (verify(arm, moved, route).fault != Fault::none) break;
    }
    const Verification off = verify(arm, moved, route);
    EXPECT_NE(off.fault, Fault::none);
    EXPECT_LE(off.sample, half);
    EXPECT_GE(off.sample + 4, half);
    Trajectory shorter = trajectory;
    for (auto* column : {&shorter.positions, &shorter.velocities, &shorter.accelerations}) {
      column->resize(half);
    }
    shorter.times.resize(half);
    const Verification cut = verify(arm, shorter, route);
    EXPECT_EQ(cut.fault, Fault::not_through) << cut.reason << route.path.segments.size();
  }
}

// Paths of different kinds through the same poses differ.
TEST(Verify, TellsAnotherKindOfPath) {
  const std::vector<MadeAlong> all = made_along("puma560");
  for (std::size_t i = 0; i < all.size(); i += 2) {
    for (std::size_t k = 0; k < all.size(); k += 2) {
      const Verification found = verify(all[i].arm, all[i].trajectory, all[k].route);
      const bool same = i == k;
      EXPECT_EQ(found.fault == Fault::none, same) << i << " " << k << found.reason;
    }
  }
}

// The tool stays on its line, but moves backwards.
TEST(Verify, FindsABackwardMotion) {
  const Arm arm = built_in("ur5");
  const Configuration start = start_of(arm);
  Pose to = forward_kinematics(arm, start);
  to.translation() += Vector3(0.1, 0.05, 0);
  const std::vector<Pose> waypoints{to};
  const PathMotion motion = move_in_lines(
      arm, start, waypoints,
      {.tolerance = 5e-5, .profile = Profile::quintic, .interpolation = Interpolation::linear});
  ASSERT_FALSE(verify(arm, motion.trajectory, waypoints).reason);
  const std::size_t size = motion.trajectory.size(), turn = 3 * size / 4, back = size / 2;
  Trajectory there{motion.trajectory.joint_names, {}, {}, {}, {}};
  const auto go = [&](std::size_t k) {
    there.times.push_back(static_cast<double>(there.times.size()));  // slowly
    there.positions.push_back(motion.trajectory.positions[k]);
  };
  for (std::size_t k = 0; k <= turn; ++k) go(k);
  for (std::size_t k = turn; k-- > back;) go(k);
  for (std::size_t k = back + 1; k < size; ++k) go(k);
  const Verification found = verify(arm, there, waypoints);
  EXPECT_EQ(found.fault, Fault::backwards) << found.reason;
  EXPECT_EQ(found.sample, turn);
}

}  // namespace
}  // namespace beeline
