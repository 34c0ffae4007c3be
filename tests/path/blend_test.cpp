#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/path/blend.h>
#include <beeline/path/internal/scaled_blends.h>

#include <tests/path/random_segment.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using std::numbers::pi;
using testing::distance_between;
using testing::Random;
using testing::random_poses;
using testing::turn_between;

bool moves(const Line& line) { return span_of(line) <= distance_between(line.from, line.to); }

/// The pose on the line nearest by position.
Pose nearest(const Line& line, const Pose& pose) {
  const Vector3 way = line.to.translation() - line.from.translation();
  const Vector3 done = pose.translation() - line.from.translation();
  return interpolate(line.from, line.to, std::clamp(done.dot(way) / way.squaredNorm(), 0.0, 1.0));
}

double f(double s) { return (2 - s) * s * s * s; }

/// The pose on the two lines that the rounding at the share s is compared with.
Pose on_lines(const Line& in, const Line& out, double radius, double s, const Pose& pose) {
  if (moves(in) && moves(out)) {
    const Pose on_in = nearest(in, pose), on_out = nearest(out, pose);
    return distance_between(pose, on_in) < distance_between(pose, on_out) ? on_in : on_out;
  }
  if (s > 0.5) return interpolate(out.from, out.to, radius * f(s) / span_of(out));
  return interpolate(in.from, in.to, 1 - radius * f(1 - s) / span_of(in));
}

Deviation random_distance(Random& random) {
  return {std::pow(10, random.uniform(-4, 0)), std::pow(10, random.uniform(-2, 1))};
}

/// The index of each corner's segment; none where it is not blended.
std::vector<int> segments_of(const BlendedPath& blended) {
  std::vector<int> segments;
  int k = 0;
  const auto& all = blended.path.segments;
  for (const Blend& blend : blended.blends) {
    if (k < static_cast<int>(all.size()) && std::holds_alternative<Line>(all[k])) ++k;
    segments.push_back(blend.radius > 0 ? k++ : -1);
  }
  return segments;
}

TEST(BlendedLines, KeepTheirDistanceFromLinesAndCorners) {
  Random random;
  double tightest = 0, tightest_turn = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto poses =
        random_poses(random, random.integer(3, 8), std::pow(10, random.uniform(-1, 1)), 2);
    const Deviation within = random_distance(random);
    const BlendedPath blended = blended_lines(poses, within);
    ASSERT_EQ(blended.blends.size(), poses.size() - 2);
    const std::vector<int> segments = segments_of(blended);
    for (std::size_t w = 0; w < blended.blends.size(); ++w) {
      const Blend& blend = blended.blends[w];
      if (segments[w] < 0) continue;
      for (const Deviation& off : {blend.line_deviation, blend.corner_deviation}) {
        ASSERT_LE(off.position, within.position * (1 + 1e-12));
        ASSERT_LE(off.orientation, within.orientation * (1 + 1e-12));
      }
      const Line in{poses[w], poses[w + 1]}, out{poses[w + 1], poses[w + 2]};
      const Segment& segment = blended.path.segments[segments[w]];
      Deviation seen;
      for (int k = 0; k <= 50; ++k) {
        const Pose pose = pose_at(segment, k / 50.0);
        const Pose on = on_lines(in, out, blend.radius, k / 50.0, pose);
        seen.position = std::max(seen.position, distance_between(pose, on));
        if (k != 25) seen.orientation = std::max(seen.orientation, turn_between(pose, on));
      }
      ASSERT_LE(seen.position, blend.line_deviation.position + 1e-12);
      ASSERT_LE(seen.orientation, blend.line_deviation.orientation + 1e-10);
      const Pose half_way = pose_at(segment, 0.5);
      ASSERT_NEAR(distance_between(half_way, poses[w + 1]), blend.corner_deviation.position, 1e-12);
      ASSERT_NEAR(turn_between(half_way, poses[w + 1]), blend.corner_deviation.orientation, 1e-12);
      tightest = std::max(tightest, seen.position / blend.line_deviation.position);
      tightest_turn = std::max(tightest_turn, seen.orientation / blend.line_deviation.orientation);
    }
  }
  EXPECT_GT(tightest, 1 - 1e-9);
  EXPECT_GT(tightest_turn, 0.85);
}

TEST(BlendedLines, HaveContinuousVelocityAndAcceleration) {
  Random random;
  for (int i = 0; i < 3000; ++i) {
    auto poses = random_poses(random, random.integer(3, 8), 1, 2);
    if (i % 4 == 0) poses[1].translation() = poses[0].translation();  // a turn on the spot
    const BlendedPath blended = blended_lines(poses, random_distance(random));
    const ToolPath& path = blended.path;
    const bool sharp = std::any_of(blended.blends.begin(), blended.blends.end(),
                                   [](const Blend& blend) { return blend.sharp; });
    if (sharp) continue;
    for (std::size_t k = 1; k < path.segments.size(); ++k) {
      const PoseMotion before = motion_at(path.segments[k - 1], 1);
      const PoseMotion after = motion_at(path.segments[k], 0);
      ASSERT_LT(pose_difference(before.pose, after.pose).norm(), 1e-12);
      const Twist v = before.velocity / path.spans[k - 1], w = after.velocity / path.spans[k];
      ASSERT_LT((v - w).norm(), 1e-6 * v.norm()) << k;  // short segments are of few digits
      ASSERT_LT(before.acceleration.norm(), 1e-9 * before.velocity.norm()) << k;
      ASSERT_LT(after.acceleration.norm(), 1e-9 * after.velocity.norm()) << k;
    }
    ASSERT_LT(pose_difference(pose_at(path.segments.front(), 0), poses.front()).norm(), 1e-12);
    ASSERT_LT(pose_difference(pose_at(path.segments.back(), 1), poses.back()).norm(), 1e-12);
  }
}

TEST(BlendedLines, CurveNoMoreThanToldAndThatMuch) {
  Random random;
  double most = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto poses = random_poses(random, 3, 1, 1);
    const BlendedPath blended = blended_lines(poses, random_distance(random));
    const int k = segments_of(blended).front();
    if (k < 0) continue;
    for (int j = 0; j <= 20; ++j) {
      const PoseMotion at = motion_at(blended.path.segments[k], j / 20.0);
      const Vector3 v = at.velocity.head<3>(), a = at.acceleration.head<3>();
      const double curvature = v.cross(a).norm() / std::pow(v.norm(), 3);
      ASSERT_LE(curvature, blended.blends[0].curvature * (1 + 1e-9));
      most = std::max(most, curvature / blended.blends[0].curvature);
    }
  }
  EXPECT_NEAR(most, 1, 1e-9);
}

TEST(BlendedLines, ShortenWhatWouldOverlapAndTellIt) {
  Random random;
  for (int i = 0; i < 2000; ++i) {
    const auto poses = random_poses(random, 6, 1, 1);
    const Deviation within{std::pow(10, random.uniform(-3, 1)), pi};
    const BlendedPath blended = blended_lines(poses, within);
    for (std::size_t w = 0; w < blended.blends.size(); ++w) {
      const Blend& blend = blended.blends[w];
      const double before = w > 0 ? blended.blends[w - 1].radius : 0;
      ASSERT_LE(before + blend.radius, span_of({poses[w], poses[w + 1]}) * (1 + 1e-12));
      if (blend.sharp) continue;
      const double use =
          std::max(blend.corner_deviation.position / within.position,
                   std::max(blend.corner_deviation.orientation, blend.line_deviation.orientation) /
                       within.orientation);
      ASSERT_EQ(use < 1 - 1e-9, blend.shortened) << use;
    }
    ASSERT_LE(blended.blends.back().radius, span_of({poses[4], poses[5]}) * (1 + 1e-12));
  }
}

TEST(BlendedLines, OfPosesInReverseAreTheSamePath) {
  Random random;
  for (int i = 0; i < 500; ++i) {
    const auto poses = random_poses(random, 5, 1, 2);
    const Deviation within = random_distance(random);
    const BlendedPath there = blended_lines(poses, within);
    const BlendedPath back = blended_lines(std::vector<Pose>(poses.rbegin(), poses.rend()), within);
    const std::size_t segments = there.path.segments.size();
    ASSERT_EQ(segments, back.path.segments.size());
    for (std::size_t k = 0; k < segments; ++k) {
      for (const double s : {0.0, 0.4, 0.5, 1.0}) {
        const Pose p = pose_at(there.path.segments[k], s);
        const Pose q = pose_at(back.path.segments[segments - 1 - k], 1 - s);
        ASSERT_LT(pose_difference(p, q).norm(), 1e-12);
      }
    }
  }
}

Pose at(double x, double y, double turn = 0) {
  Pose pose = Pose::Identity();
  pose.translation() = Vector3(x, y, 0);
  pose.linear() = so3_exp({0, 0, turn});
  return pose;
}

TEST(BlendedLines, OfARightAngleAreAsByHand) {
  const BlendedPath blended = blended_lines(std::vector{at(0, 0), at(1, 0), at(1, 1)}, {0.1, pi});
  const Blend& blend = blended.blends.front();
  EXPECT_NEAR(blend.radius, 0.8 / 3 * std::numbers::sqrt2, 1e-12);  // passes at 3/16 sqrt(2)
  EXPECT_NEAR(blend.corner_deviation.position, 0.1, 1e-12);
  EXPECT_NEAR(blend.line_deviation.position, blend.radius * 3 / 16, 1e-12);
  EXPECT_FALSE(blend.shortened);
  EXPECT_EQ(blended.path.segments.size(), 3u);
}

TEST(BlendedLines, StopWhereTheToolTurnsBackAndNotWhereItGoesStraightOn) {
  const BlendedPath back = blended_lines(std::vector{at(0, 0), at(1, 0), at(0, 0.01)}, {0.1, pi});
  EXPECT_TRUE(back.blends.front().sharp);
  EXPECT_EQ(back.blends.front().radius, 0);
  EXPECT_EQ(back.path.segments.size(), 2u);
  const BlendedPath on =
      blended_lines(std::vector{at(0, 0), at(1, 0, 0.5), at(2, 0, 1)}, {0.1, pi});
  EXPECT_FALSE(on.blends.front().sharp);
  EXPECT_FALSE(on.blends.front().shortened);
  EXPECT_EQ(on.path.segments.size(), 2u);
  const BlendedPath turns = blended_lines(std::vector{at(0, 0), at(0, 0, 1), at(0, 0)}, {0.1, pi});
  EXPECT_TRUE(turns.blends.front().sharp);
}

TEST(BlendedLines, StopAtASharpCornerBehindABlend) {
  const std::vector poses{at(0, 0), at(1, 0), at(1, 0.1), at(1, -1)};
  const BlendedPath blended = blended_lines(poses, {0.1, pi});
  EXPECT_NEAR(blended.blends[0].radius, 0.1 * 15 / 16, 1e-12) << "except the straight sixteenth";
  EXPECT_TRUE(blended.blends[1].sharp);
  EXPECT_EQ(route_of(blended).stops, (std::vector<bool>{false, false, true, false}));
}

TEST(BlendedLines, PassRepeatedPosesAsOne) {
  Random random;
  for (int i = 0; i < 200; ++i) {
    const std::vector<Pose> poses = random_poses(random, random.integer(2, 6), 1, 2);
    std::vector<Deviation> within;
    std::vector<Pose> repeated;
    std::vector<Deviation> repeated_within;
    std::vector<std::size_t> last;  // of the repeated poses
    for (std::size_t k = 0; k < poses.size(); ++k) {
      const bool inner = k > 0 && k + 1 < poses.size();
      const Deviation here = random_distance(random);
      if (inner) within.push_back(here);
      for (int times = random.integer(1, 3); times > 0; --times) {
        repeated.push_back(poses[k]);
        if (inner) repeated_within.push_back({times * here.position, times * here.orientation});
        if (!inner) repeated_within.push_back({1, 1});
      }
      last.push_back(repeated.size() - 1);
    }
    repeated_within.erase(repeated_within.begin());
    repeated_within.pop_back();
    const BlendedPath once = blended_lines(poses, within);
    const BlendedPath again = blended_lines(repeated, repeated_within);
    ASSERT_EQ(again.path.segments.size(), once.path.segments.size());
    for (std::size_t k = 0; k < once.path.spans.size(); ++k) {
      EXPECT_NEAR(again.path.spans[k], once.path.spans[k], 1e-12);
    }
    EXPECT_EQ(again.stops, once.stops);
    ASSERT_EQ(again.blends.size(), repeated.size() - 2);
    for (std::size_t k = 0; k < once.blends.size(); ++k) {
      EXPECT_NEAR(again.blends[last[k + 1] - 1].radius, once.blends[k].radius, 1e-12);
    }
    for (std::size_t k = 0; k < once.lines.size(); ++k) {
      const bool blend = std::holds_alternative<SplineSegment>(once.path.segments[k]);
      const std::size_t line = once.lines[k];
      EXPECT_EQ(again.lines[k], blend ? last[line + 1] - 1 : last[line]);
    }
    // Poses that nearly repeat are passed within the tolerance, and the path ends at the last one.
    Pose near = poses.back();
    near.translation() += Vector3(0, 0, 9e-6);
    repeated.push_back(near);
    repeated_within.push_back({1, 1});
    const BlendedPath nearly = blended_lines(repeated, repeated_within);
    EXPECT_LE(distance_between(pose_at(nearly.path.segments.back(), 1), near), 1e-15);
  }
}

TEST(BlendedLines, AreSmallerWithoutAnyThatIsLarger) {
  Random random;
  int scaled = 0;
  for (int i = 0; i < testing::cases(300); ++i) {
    const std::vector<Pose> poses = random_poses(random, random.integer(3, 7), 1, 2);
    std::vector<Deviation> within;
    std::vector<double> scales;
    for (std::size_t k = 2; k < poses.size(); ++k) {
      within.push_back(random_distance(random));
      scales.push_back(random.integer(0, 2) == 0 ? 0 : random.uniform(0, 1));
    }
    const BlendedPath full = blended_lines(poses, within);
    const BlendedPath smaller = internal::scaled_blends(poses, within, scales);
    for (std::size_t k = 0; k < scales.size(); ++k) {
      EXPECT_NEAR(smaller.blends[k].radius, scales[k] * full.blends[k].radius, 1e-12);
      scaled += full.blends[k].radius > 0;
    }
  }
  EXPECT_GE(scaled, testing::cases(300));
  const std::vector poses{at(0, 0), at(1, 0), at(1, 1)};
  const std::vector<Deviation> within{{1, 1}};
  for (const double scale : {-1.0, 1.1, double(NAN)}) {
    EXPECT_REFUSED(internal::scaled_blends(poses, within, std::vector{scale}), "from 0 to 1");
  }
}

TEST(BlendedLines, CountTheLinesBeforeARepeatedLastPose) {
  const BlendedPath blended =
      blended_lines(std::vector{at(0, 0), at(1, 0), at(1, 1), at(1, 1)}, {0.1, 1});
  EXPECT_EQ(blended.path.names.back(), "line 2 of 3 (pose 2 to 3)");
}

TEST(BlendedLines, RefuseWhatMakesNoSense) {
  const std::vector poses{at(0, 0), at(1, 0), at(1, 1)};
  EXPECT_REFUSED(blended_lines(poses, {0, 1}), "at least 0.0001");
  EXPECT_REFUSED(blended_lines(poses, {1, NAN}), "at least 0.0001");
  EXPECT_REFUSED(blended_lines({poses.data(), 1}, {1, 1}), "two poses");
  EXPECT_REFUSED(blended_lines(std::vector{poses[0], poses[0]}, {1, 1}), "pose 2");
}

}  // namespace
}  // namespace beeline
