#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <numbers>

#include <beeline/path/segment.h>

#include <tests/path/random_segment.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using std::numbers::pi;
using testing::distance_between;
using testing::kind_of;
using testing::Random;
using testing::random_poses;
using testing::random_segment;
using testing::size_of;
using testing::turn_between;

TEST(Segment, HasTheDerivativesThatDifferencesHave) {
  Random random;
  constexpr double h = 1e-4;
  std::map<std::string, int> kinds;
  for (int i = 0; i < 4000; ++i) {
    const Segment segment = random_segment(random);
    const double s = random.uniform(0.01, 0.99), size = size_of(segment);
    const PoseMotion at = motion_at(segment, s);
    const Twist ahead = pose_difference(pose_at(segment, s + h), at.pose);
    const Twist back = pose_difference(pose_at(segment, s - h), at.pose);
    ASSERT_TRUE(at.pose.isApprox(pose_at(segment, s), 1e-14));
    ASSERT_LT((at.velocity - (ahead - back) / (2 * h)).norm(), 3e-6 * size) << kind_of(segment);
    ASSERT_LT((at.acceleration - (ahead + back) / (h * h)).norm(), 1e-5 * size) << kind_of(segment);
    ++kinds[kind_of(segment)];
  }
  EXPECT_EQ(kinds.size(), 4u);
}

TEST(Segment, IsAsLongAsItsChordsTogether) {
  Random random;
  for (int i = 0; i < 300; ++i) {
    const Segment segment = random_segment(random);
    double chords = 0;
    constexpr int parts = 1000;
    for (int k = 0; k < parts; ++k) {
      chords += distance_between(pose_at(segment, double(k) / parts),
                                 pose_at(segment, double(k + 1) / parts));
    }
    ASSERT_NEAR(chords, length_of(segment), 1e-4 * chords + 1e-9) << kind_of(segment);
  }
}

TEST(Segment, BeginsAndEndsAtItsPoses) {
  Random random;
  for (int i = 0; i < 2000; ++i) {
    const auto poses = random_poses(random, 5, 1, 3);
    for (const PathKind kind : {PathKind::line, PathKind::screw, PathKind::arc, PathKind::spline}) {
      const ToolPath path = path_through(poses, kind);
      const std::size_t step = kind == PathKind::arc ? 2 : 1;
      ASSERT_EQ(path.segments.size() * step, 4u);
      for (std::size_t k = 0; k < path.segments.size(); ++k) {
        const Pose from = pose_at(path.segments[k], 0), to = pose_at(path.segments[k], 1);
        const double slack = kind == PathKind::arc ? 1e-9 : 1e-13;
        ASSERT_LT(distance_between(from, poses[k * step]), slack) << name(kind);
        ASSERT_LT(distance_between(to, poses[(k + 1) * step]), slack) << name(kind);
        ASSERT_LT(turn_between(from, poses[k * step]), 1e-13) << name(kind);
        ASSERT_LT(turn_between(to, poses[(k + 1) * step]), 1e-13) << name(kind);
      }
    }
  }
}

TEST(Arc, IsACircleThroughItsThreePositions) {
  Random random;
  for (int i = 0; i < 3000; ++i) {
    const auto poses = random_poses(random, 3, 1, 3);
    const Vector3 passed = poses[1].translation();
    const Arc arc = arc_through(poses[0], passed, poses[2]);
    const double radius = (arc.from.translation() - arc.centre).norm();
    const double slack = 1e-12 * (1 + radius) * (1 + radius);
    double nearest = radius;
    ASSERT_LE(arc.rotation.norm(), 2 * pi);
    const double angle = arc.rotation.norm();
    for (int k = 0; k <= 50; ++k) {
      const Vector3 p = pose_at(arc, k / 50.0).translation();
      ASSERT_NEAR((p - arc.centre).norm(), radius, slack);
      ASSERT_NEAR((p - arc.centre).dot(arc.rotation), 0, slack * angle);
    }
    // where it passes: by the angle at the centre
    const Vector3 a = arc.from.translation() - arc.centre, b = passed - arc.centre;
    double turned = std::atan2(a.cross(b).dot(arc.rotation) / angle, a.dot(b));
    if (turned < 0) turned += 2 * pi;
    ASSERT_LT(turned, angle);
    nearest = (pose_at(arc, turned / angle).translation() - passed).norm();
    ASSERT_LT(nearest, slack);
  }
}

TEST(Arc, IsRefusedWhereThreePositionsTellNone) {
  const auto at = [](double x, double y) {
    Pose pose = Pose::Identity();
    pose.translation() = Vector3(x, y, 0);
    return pose;
  };
  EXPECT_REFUSED(arc_through(at(0, 0), {1, 0, 0}, at(2, 0)), "straight line");
  EXPECT_REFUSED(arc_through(at(0, 0), {2, 0, 0}, at(1, 0)), "straight line");
  EXPECT_REFUSED(arc_through(at(0, 0), {1, 1, 0}, at(0, 0)), "straight line");
  EXPECT_REFUSED(arc_through(at(0, 0), {0, 0, 0}, at(1, 1)), "straight line");
}

TEST(ScrewLine, IsOneScrewAllTheWay) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const auto poses = random_poses(random, 2, 1, 3);
    const ScrewLine screw{poses[0], poses[1]};
    const double s = random.uniform(0, 1);
    const Twist whole = se3_log(poses[0].inverse() * poses[1]);
    const Twist part = se3_log(poses[0].inverse() * pose_at(screw, s));
    ASSERT_LT((part - s * whole).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace beeline
