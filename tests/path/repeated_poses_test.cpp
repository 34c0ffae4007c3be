#include <gtest/gtest.h>

#include <beeline/path/tool_path.h>
#include <beeline/pose/se3.h>

#include <tests/path/random_line.h>
#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

std::vector<Pose> random_poses(testing::Random& random, int count) {
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) poses.push_back(random.pose());
  return poses;
}

TEST(PathThrough, EndsASegmentAtEachPoseAsLinesThroughDoes) {
  testing::Random random;
  const std::vector<Pose> p = random_poses(random, 3);
  const std::vector<Pose> poses{p[0], p[0], p[1], p[1], p[1], p[2]};
  const ToolPath lines = lines_through(poses);
  for (const PathKind kind : {PathKind::line, PathKind::screw}) {
    const ToolPath path = path_through(poses, kind);
    ASSERT_EQ(path.segments.size(), lines.segments.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const Pose end = pose_at(path, static_cast<double>(i));
      EXPECT_LT(pose_difference(end, poses[i]).norm(), 1e-12);
    }
    for (const std::size_t rest : {0, 2, 3}) EXPECT_LT(path.spans[rest], 1e-15);
  }
  EXPECT_EQ(path_through(poses, PathKind::line).spans, lines.spans);
}

TEST(PathThrough, PassesARepeatedPoseOfASplineOnce) {
  testing::Random random;
  for (int i = 0; i < testing::cases(20); ++i) {
    const std::vector<Pose> p = random_poses(random, 4);
    const ToolPath once = path_through(p, PathKind::spline);
    const ToolPath path =
        path_through({{p[0], p[0], p[1], p[2], p[2], p[2], p[3], p[3]}}, PathKind::spline);
    ASSERT_EQ(path.segments.size(), once.segments.size());
    for (double s = 0; s <= 3; s += 0.125) {
      EXPECT_LT(pose_difference(pose_at(path, s), pose_at(once, s)).norm(), 1e-12);
    }
  }
}

TEST(PathThrough, RestsAtEqualPoses) {
  testing::Random random;
  const Pose pose = random.pose();
  for (const PathKind kind : {PathKind::line, PathKind::screw, PathKind::arc, PathKind::spline}) {
    const ToolPath path = path_through({{pose, pose, pose}}, kind);
    const bool one = kind == PathKind::arc || kind == PathKind::spline;
    ASSERT_EQ(path.segments.size(), one ? 1 : 2) << name(kind);
    EXPECT_LT(pose_difference(pose_at(path, 0.5), pose).norm(), 1e-12) << name(kind);
  }
}

TEST(PathThrough, RefusesAnArcWithTwoEqualPositions) {
  testing::Random random;
  const std::vector<Pose> p = random_poses(random, 2);
  EXPECT_REFUSED(path_through({{p[0], p[0], p[1]}}, PathKind::arc), "determine no circle");
  EXPECT_REFUSED(path_through({{p[0], p[1], p[1]}}, PathKind::arc), "determine no circle");
}

}  // namespace
}  // namespace beeline
