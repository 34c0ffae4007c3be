#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/path/blend.h>

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

/// The index of each corner's piece; none where it is not rounded.
std::vector<int> pieces_of(const RoundedPath& rounded) {
  std::vector<int> pieces;
  int k = 0;
  const auto& all = rounded.path.pieces;
  for (const Corner& corner : rounded.corners) {
    if (k < static_cast<int>(all.size()) && std::holds_alternative<Line>(all[k])) ++k;
    pieces.push_back(corner.radius > 0 ? k++ : -1);
  }
  return pieces;
}

TEST(RoundedLines, KeepTheirDistanceFromLinesAndCorners) {
  Random random;
  double tightest = 0, tightest_turn = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto poses =
        random_poses(random, random.integer(3, 8), std::pow(10, random.uniform(-1, 1)), 2);
    const Deviation within = random_distance(random);
    const RoundedPath rounded = rounded_lines(poses, within);
    ASSERT_EQ(rounded.corners.size(), poses.size() - 2);
    const std::vector<int> pieces = pieces_of(rounded);
    for (std::size_t w = 0; w < rounded.corners.size(); ++w) {
      const Corner& corner = rounded.corners[w];
      if (pieces[w] < 0) continue;
      for (const Deviation& off : {corner.off_lines, corner.off_corner}) {
        ASSERT_LE(off.position, within.position * (1 + 1e-12));
        ASSERT_LE(off.orientation, within.orientation * (1 + 1e-12));
      }
      const Line in{poses[w], poses[w + 1]}, out{poses[w + 1], poses[w + 2]};
      const Piece& piece = rounded.path.pieces[pieces[w]];
      Deviation seen;
      for (int k = 0; k <= 50; ++k) {
        const Pose pose = pose_at(piece, k / 50.0);
        const Pose on = on_lines(in, out, corner.radius, k / 50.0, pose);
        seen.position = std::max(seen.position, distance_between(pose, on));
        if (k != 25) seen.orientation = std::max(seen.orientation, turn_between(pose, on));
      }
      ASSERT_LE(seen.position, corner.off_lines.position + 1e-12);
      ASSERT_LE(seen.orientation, corner.off_lines.orientation + 1e-10);
      const Pose half_way = pose_at(piece, 0.5);
      ASSERT_NEAR(distance_between(half_way, poses[w + 1]), corner.off_corner.position, 1e-12);
      ASSERT_NEAR(turn_between(half_way, poses[w + 1]), corner.off_corner.orientation, 1e-12);
      tightest = std::max(tightest, seen.position / corner.off_lines.position);
      tightest_turn = std::max(tightest_turn, seen.orientation / corner.off_lines.orientation);
    }
  }
  EXPECT_GT(tightest, 1 - 1e-9);
  EXPECT_GT(tightest_turn, 0.85);
}

TEST(RoundedLines, HaveContinuousVelocityAndAcceleration) {
  Random random;
  for (int i = 0; i < 3000; ++i) {
    auto poses = random_poses(random, random.integer(3, 8), 1, 2);
    if (i % 4 == 0) poses[1].translation() = poses[0].translation();  // a turn on the spot
    const RoundedPath rounded = rounded_lines(poses, random_distance(random));
    const ToolPath& path = rounded.path;
    const bool sharp = std::any_of(rounded.corners.begin(), rounded.corners.end(),
                                   [](const Corner& corner) { return corner.sharp; });
    if (sharp) continue;
    for (std::size_t k = 1; k < path.pieces.size(); ++k) {
      const PieceMotion before = motion_at(path.pieces[k - 1], 1);
      const PieceMotion after = motion_at(path.pieces[k], 0);
      ASSERT_LT(pose_difference(before.pose, after.pose).norm(), 1e-12);
      const Twist v = before.velocity / path.spans[k - 1], w = after.velocity / path.spans[k];
      ASSERT_LT((v - w).norm(), 1e-6 * v.norm()) << k;  // short pieces are of few digits
      ASSERT_LT(before.acceleration.norm(), 1e-9 * before.velocity.norm()) << k;
      ASSERT_LT(after.acceleration.norm(), 1e-9 * after.velocity.norm()) << k;
    }
    ASSERT_LT(pose_difference(pose_at(path.pieces.front(), 0), poses.front()).norm(), 1e-12);
    ASSERT_LT(pose_difference(pose_at(path.pieces.back(), 1), poses.back()).norm(), 1e-12);
  }
}

TEST(RoundedLines, CurveNoMoreThanToldAndThatMuch) {
  Random random;
  double most = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto poses = random_poses(random, 3, 1, 1);
    const RoundedPath rounded = rounded_lines(poses, random_distance(random));
    const int k = pieces_of(rounded).front();
    if (k < 0) continue;
    for (int j = 0; j <= 20; ++j) {
      const PieceMotion at = motion_at(rounded.path.pieces[k], j / 20.0);
      const Vector3 v = at.velocity.head<3>(), a = at.acceleration.head<3>();
      const double curvature = v.cross(a).norm() / std::pow(v.norm(), 3);
      ASSERT_LE(curvature, rounded.corners[0].curvature * (1 + 1e-9));
      most = std::max(most, curvature / rounded.corners[0].curvature);
    }
  }
  EXPECT_NEAR(most, 1, 1e-9);
}

TEST(RoundedLines, ShortenWhatWouldOverlapAndTellIt) {
  Random random;
  for (int i = 0; i < 2000; ++i) {
    const auto poses = random_poses(random, 6, 1, 1);
    const Deviation within{std::pow(10, random.uniform(-3, 1)), pi};
    const RoundedPath rounded = rounded_lines(poses, within);
    for (std::size_t w = 0; w < rounded.corners.size(); ++w) {
      const Corner& corner = rounded.corners[w];
      const double before = w > 0 ? rounded.corners[w - 1].radius : 0;
      ASSERT_LE(before + corner.radius, span_of({poses[w], poses[w + 1]}) * (1 + 1e-12));
      if (corner.sharp) continue;
      const double use =
          std::max(corner.off_corner.position / within.position,
                   std::max(corner.off_corner.orientation, corner.off_lines.orientation) /
                       within.orientation);
      ASSERT_EQ(use < 1 - 1e-9, corner.shortened) << use;
    }
    ASSERT_LE(rounded.corners.back().radius, span_of({poses[4], poses[5]}) * (1 + 1e-12));
  }
}

TEST(RoundedLines, OfPosesInReverseAreTheSamePath) {
  Random random;
  for (int i = 0; i < 500; ++i) {
    const auto poses = random_poses(random, 5, 1, 2);
    const Deviation within = random_distance(random);
    const RoundedPath there = rounded_lines(poses, within);
    const RoundedPath back = rounded_lines(std::vector<Pose>(poses.rbegin(), poses.rend()), within);
    const std::size_t pieces = there.path.pieces.size();
    ASSERT_EQ(pieces, back.path.pieces.size());
    for (std::size_t k = 0; k < pieces; ++k) {
      for (const double s : {0.0, 0.4, 0.5, 1.0}) {
        const Pose p = pose_at(there.path.pieces[k], s);
        const Pose q = pose_at(back.path.pieces[pieces - 1 - k], 1 - s);
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

TEST(RoundedLines, OfARightAngleAreAsByHand) {
  const RoundedPath rounded = rounded_lines(std::vector{at(0, 0), at(1, 0), at(1, 1)}, {0.1, pi});
  const Corner& corner = rounded.corners.front();
  EXPECT_NEAR(corner.radius, 0.8 / 3 * std::numbers::sqrt2, 1e-12);  // passes at 3/16 sqrt(2)
  EXPECT_NEAR(corner.off_corner.position, 0.1, 1e-12);
  EXPECT_NEAR(corner.off_lines.position, corner.radius * 3 / 16, 1e-12);
  EXPECT_FALSE(corner.shortened);
  EXPECT_EQ(rounded.path.pieces.size(), 3u);
}

TEST(RoundedLines, StopWhereTheToolTurnsBackAndNotWhereItGoesStraightOn) {
  const RoundedPath back = rounded_lines(std::vector{at(0, 0), at(1, 0), at(0, 0.01)}, {0.1, pi});
  EXPECT_TRUE(back.corners.front().sharp);
  EXPECT_EQ(back.corners.front().radius, 0);
  EXPECT_EQ(back.path.pieces.size(), 2u);
  const RoundedPath on =
      rounded_lines(std::vector{at(0, 0), at(1, 0, 0.5), at(2, 0, 1)}, {0.1, pi});
  EXPECT_FALSE(on.corners.front().sharp);
  EXPECT_FALSE(on.corners.front().shortened);
  EXPECT_EQ(on.path.pieces.size(), 2u);
  const RoundedPath turns = rounded_lines(std::vector{at(0, 0), at(0, 0, 1), at(0, 0)}, {0.1, pi});
  EXPECT_TRUE(turns.corners.front().sharp);
}

TEST(RoundedLines, StopAtASharpCornerWhereARoundingEnds) {
  const std::vector poses{at(0, 0), at(1, 0), at(1, 0.1), at(1, -1)};
  const RoundedPath rounded = rounded_lines(poses, {0.1, pi});
  EXPECT_NEAR(rounded.corners[0].radius, 0.1, 1e-12) << "all of the short line";
  EXPECT_TRUE(rounded.corners[1].sharp);
  EXPECT_EQ(route_of(rounded).stops, (std::vector<bool>{false, true, false}));
}

TEST(RoundedLines, RefuseWhatMakesNoSense) {
  const std::vector poses{at(0, 0), at(1, 0), at(1, 1)};
  EXPECT_REFUSED(rounded_lines(poses, {0, 1}), "above zero");
  EXPECT_REFUSED(rounded_lines(poses, {1, NAN}), "above zero");
  EXPECT_REFUSED(rounded_lines({poses.data(), 1}, {1, 1}), "two poses");
  EXPECT_REFUSED(rounded_lines(std::vector{poses[0], poses[0]}, {1, 1}), "pose 2");
}

}  // namespace
}  // namespace beeline
