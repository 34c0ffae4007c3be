#include <gtest/gtest.h>

#include <beeline/kinematics/task.h>
#include <beeline/path/tool_path.h>
#include <beeline/pose/se3.h>

#include <tests/path/random_segment.h>
#include <tests/refusal.h>

namespace beeline::internal {
namespace {

using testing::Random;
using testing::random_poses;

constexpr PathKind all_kinds[] = {PathKind::line, PathKind::screw, PathKind::arc, PathKind::spline};

/// The path's derivatives by its parameter, in segment k at its share s.
PoseMotion by_parameter(const ToolPath& path, std::size_t k, double s) {
  PoseMotion at = motion_at(path.segments[k], s);
  at.velocity /= path.spans[k];
  at.acceleration /= path.spans[k] * path.spans[k];
  return at;
}

TEST(PathThrough, SplinesHaveContinuousVelocitiesAndAccelerationsUnlessTheyTurnBack) {
  Random random;
  int continuous = 0;
  for (int i = 0; i < 3000; ++i) {
    const double angle = random.uniform(0, 2);
    const auto poses = random_poses(random, random.integer(3, 12), 1, angle);
    const ToolPath path = path_through(poses, PathKind::spline);
    for (std::size_t k = 1; k < path.segments.size(); ++k) {
      const PoseMotion before = by_parameter(path, k - 1, 1), after = by_parameter(path, k, 0);
      const double size = 1 + before.velocity.norm() + before.acceleration.norm();
      if (before.velocity.dot(after.velocity) < 0) continue;  // turns back
      ++continuous;
      ASSERT_LT((before.velocity - after.velocity).norm(), 1e-11 * size);
      ASSERT_LT((before.acceleration - after.acceleration).norm(), 1e-10 * size * size);
    }
    const std::size_t last = path.segments.size() - 1;
    const PoseMotion end = by_parameter(path, last, 1);
    ASSERT_LT(by_parameter(path, 0, 0).acceleration.norm(), 1e-9);
    ASSERT_LT(end.acceleration.norm(), 1e-9 * (1 + end.velocity.squaredNorm()));
  }
  EXPECT_GT(continuous, 15000);
}

TEST(PathThrough, SplinesStopWhereTheyTurnBack) {
  Random random;
  for (int i = 0; i < 50; ++i) {
    const Pose a = random.pose();
    const Pose b = a * make_pose(random.vector(0.2), random.rotation(2));
    const std::vector<Pose> poses{a, b, a};
    const Route back = route_of(path_through(poses, PathKind::spline), PathKind::spline);
    EXPECT_EQ(back.stops, (std::vector<bool>{true, true}));
    for (int k = 0; k <= 10; ++k) {  // there and back on one path, nowhere slower than the chord
      const double s = 0.1 * k;
      const Twist velocity = by_parameter(back.path, 0, s).velocity;
      const double turn = metres_per_radian * velocity.tail<3>().norm();
      EXPECT_NEAR(std::hypot(velocity.head<3>().norm(), turn), 1, 1e-9);
      const Pose there = pose_at(back.path, s), returning = pose_at(back.path, 2 - s);
      EXPECT_LT((there.matrix() - returning.matrix()).norm(), 1e-12);
    }
  }
}

TEST(PathThrough, SplinesPassWhereTheyTurnByLess) {
  Random random;
  for (int i = 0; i < 50; ++i) {
    const Vector3 along = random.direction(), across = along.unitOrthogonal();
    const double angle = random.uniform(0.2, 3.1);  // between the chords
    const Vector3 last = along - std::cos(angle) * along + std::sin(angle) * across;
    const std::vector<Pose> poses{make_pose({0, 0, 0}), make_pose(along), make_pose(last)};
    const Route route = route_of(path_through(poses, PathKind::spline), PathKind::spline);
    EXPECT_EQ(route.stops, (std::vector<bool>{false, true}));
  }
}

TEST(PathThrough, SplinesTakeTheVelocitiesGivenAtTheirEnds) {
  Random random;
  for (int i = 0; i < 500; ++i) {
    const auto poses = random_poses(random, random.integer(2, 8), 1, 1);
    const Twist first = Twist::Random(), last = i % 2 == 0 ? Twist(Twist::Zero()) : first;
    const ToolPath path = path_through(poses, PathKind::spline, {.first = first, .last = last});
    const std::size_t end = path.segments.size() - 1;
    ASSERT_LT((by_parameter(path, 0, 0).velocity - first).norm(), 1e-12);
    ASSERT_LT((by_parameter(path, end, 1).velocity - last).norm(), 1e-12);
  }
}

TEST(PathThrough, OfPosesOnALineIsThatLine) {
  Random random;
  for (int i = 0; i < 500; ++i) {
    const Pose from = random.pose();
    Pose to = from;
    to.translation() += random.vector();
    to.linear() = random.rotation(3) * from.linear();
    const ToolPath two = path_through(std::vector{from, to}, PathKind::spline);
    const double s = random.uniform(0.2, 0.8);
    const ToolPath three =
        path_through(std::vector{from, interpolate(from, to, s), to}, PathKind::spline);
    for (const double t : {0.1, 0.5, 0.7}) {
      const Pose on = interpolate(from, to, t), on_first = interpolate(from, to, t * s);
      ASSERT_LT(pose_difference(pose_at(two.segments[0], t), on).norm(), 1e-12);
      ASSERT_LT(pose_difference(pose_at(three.segments[0], t), on_first).norm(), 1e-12);
    }
  }
}

TEST(PathThrough, MovesWithTheWorldAndWithTheToolsOwnAxes) {
  Random random;
  for (int i = 0; i < 500; ++i) {
    const auto poses = random_poses(random, 7, 1, 2);
    const Pose moved = random.pose();
    for (const PathKind kind : all_kinds) {
      ToolPath path = path_through(poses, kind);
      std::vector<Pose> others;
      for (const Pose& pose : poses) others.push_back(moved * pose);
      const ToolPath other = path_through(others, kind);
      for (std::size_t k = 0; k < path.segments.size(); ++k) {
        for (const double s : {0.0, 0.3, 0.5, 1.0}) {
          const Pose p = moved * pose_at(path.segments[k], s), q = pose_at(other.segments[k], s);
          ASSERT_LT(pose_difference(p, q).norm(), 1e-9) << name(kind);
        }
      }
    }
    // another orientation of the tool's axes, the same for all
    std::vector<Pose> turned;
    const Rotation tool = random.rotation();
    for (Pose pose : poses) turned.push_back((pose.linear() = pose.linear() * tool, pose));
    const ToolPath path = path_through(poses, PathKind::spline);
    const ToolPath other = path_through(turned, PathKind::spline);
    for (std::size_t k = 0; k < path.segments.size(); ++k) {
      Pose p = pose_at(path.segments[k], 0.3);
      p.linear() = p.linear() * tool;
      ASSERT_LT(pose_difference(p, pose_at(other.segments[k], 0.3)).norm(), 1e-11);
    }
  }
}

TEST(PathThrough, OfPosesInReverseIsThePathInReverse) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const auto poses = random_poses(random, 7, 1, 2);
    const std::vector<Pose> reverse(poses.rbegin(), poses.rend());
    for (const PathKind kind : all_kinds) {
      const ToolPath path = path_through(poses, kind), back = path_through(reverse, kind);
      const std::size_t last = path.segments.size() - 1;
      for (std::size_t k = 0; k <= last; ++k) {
        for (const double s : {0.0, 0.3, 0.5, 1.0}) {
          const Pose p = pose_at(path.segments[k], s), q = pose_at(back.segments[last - k], 1 - s);
          ASSERT_LT(pose_difference(p, q).norm(), 1e-9) << name(kind);
        }
      }
    }
  }
}

// The spline of orientations should not wander: turning about one axis it is the spline of angles.
TEST(PathThrough, SplinesOfTurnsAboutOneAxisTurnAboutItAlone) {
  Random random;
  for (int i = 0; i < 500; ++i) {
    auto poses = random_poses(random, 6, 1, 0);
    const Vector3 axis = random.direction();
    for (Pose& pose : poses) pose.linear() = so3_exp(axis * random.uniform(-1, 1));
    const ToolPath path = path_through(poses, PathKind::spline);
    for (std::size_t k = 0; k < path.segments.size(); ++k) {
      const PoseMotion at = motion_at(path.segments[k], random.uniform(0, 1));
      ASSERT_LT(at.velocity.tail<3>().cross(axis).norm(), 1e-12);
    }
  }
}

/// A smooth motion, far from any polynomial.
Pose waving(double u) {
  Pose pose = Pose::Identity();
  pose.translation() = Vector3(std::cos(u), std::sin(u), 0.3 * std::sin(2 * u));
  pose.linear() = so3_exp({std::sin(u), 0, 0}) * so3_exp({0, 1.2 * u, std::cos(2 * u)});
  return pose;
}

/// How far the spline through `steps` + 1 poses of it is from them, in the middle of its way.
Deviation off_waving(int steps) {
  std::vector<Pose> poses;
  for (int i = 0; i <= steps; ++i) poses.push_back(waving(2.0 * i / steps));
  const ToolPath path = path_through(poses, PathKind::spline);
  Deviation off;
  for (int i = 0; i < 200; ++i) {
    const Pose pose = waving(0.8 + 0.4 * i / 200);
    Deviation least{1, 1};  // from the nearest pose of the path, by either
    for (std::size_t k = path.segments.size() / 3; k <= 2 * path.segments.size() / 3; ++k) {
      double low = 0, high = 1;
      const auto distance = [&](double s) {
        return (pose_at(path.segments[k], s).translation() - pose.translation()).norm();
      };
      while (high - low > 1e-12) {
        const double third = (high - low) / 3;
        if (distance(low + third) < distance(high - third)) {
          high -= third;
        } else {
          low += third;
        }
      }
      if (distance(low) > least.position) continue;
      least = {distance(low),
               pose_difference(pose_at(path.segments[k], low), pose).tail<3>().norm()};
    }
    off.position = std::max(off.position, least.position);
    off.orientation = std::max(off.orientation, least.orientation);
  }
  return off;
}

TEST(PathThrough, SplinesComeToTheMotionThatThePosesAreOf) {
  Deviation before = off_waving(16);
  for (const int steps : {32, 64, 128}) {
    const Deviation now = off_waving(steps);
    EXPECT_LT(now.position, before.position / 8);
    EXPECT_LT(now.orientation, before.orientation / 7);
    before = now;
  }
}

TEST(PathThrough, RefusesWhatMakesNoPath) {
  Random random;
  const auto poses = random_poses(random, 4, 1, 1);
  EXPECT_REFUSED(path_through({poses.data(), 1}, PathKind::line), "two poses");
  EXPECT_REFUSED(path_through(poses, PathKind::arc), "odd number");
  Pose rough = poses[0];
  rough.linear() *= 1 + 3e-7;
  const ToolPath made = path_through(std::vector{rough, poses[1]}, PathKind::spline);
  EXPECT_LT(pose_difference(pose_at(made.segments[0], 0), poses[0]).norm(), 1e-6);
  EXPECT_NEAR(pose_at(made.segments[0], 0).linear().determinant(), 1, 1e-14);
  Pose bent = poses[0];
  bent.linear() *= 1.1;
  EXPECT_REFUSED(path_through(std::vector{poses[0], bent}, PathKind::line), "rigid");
  bent.translation().x() = NAN;
  EXPECT_REFUSED(path_through(std::vector{bent, poses[0]}, PathKind::screw), "pose 1");
  EXPECT_REFUSED(path_kind_named("splin"), "spline");
  for (const PathKind kind : all_kinds) EXPECT_EQ(path_kind_named(name(kind)), kind);
}

}  // namespace
}  // namespace beeline::internal
