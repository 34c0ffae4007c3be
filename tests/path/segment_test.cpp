#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <numbers>

#include <beeline/certificate/internal/segment_chord.h>

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
using testing::turn_between;

double size_of(const Segment& segment) {
  const SegmentMotion at = motion_at(segment, 0.5);
  return 1 + at.velocity.norm() + at.acceleration.norm();
}

TEST(Segment, HasTheDerivativesThatDifferencesHave) {
  Random random;
  constexpr double h = 1e-4;
  std::map<std::string, int> kinds;
  for (int i = 0; i < 4000; ++i) {
    const Segment segment = random_segment(random);
    const double s = random.uniform(0.01, 0.99), size = size_of(segment);
    const SegmentMotion at = motion_at(segment, s);
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
    ASSERT_LE(arc.turn.norm(), 2 * pi);
    const double angle = arc.turn.norm();
    for (int k = 0; k <= 50; ++k) {
      const Vector3 p = pose_at(arc, k / 50.0).translation();
      ASSERT_NEAR((p - arc.centre).norm(), radius, slack);
      ASSERT_NEAR((p - arc.centre).dot(arc.turn), 0, slack * angle);
    }
    // where it passes: by the angle at the centre
    const Vector3 a = arc.from.translation() - arc.centre, b = passed - arc.centre;
    double turned = std::atan2(a.cross(b).dot(arc.turn) / angle, a.dot(b));
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

/// The largest distances from the chord at the same share.
Deviation sampled(const Segment& segment, double s_a, double s_b, int points) {
  const Pose from = pose_at(segment, s_a), to = pose_at(segment, s_b);
  Deviation seen;
  for (int k = 1; k < points; ++k) {
    const double t = double(k) / points;
    const Pose pose = pose_at(segment, std::lerp(s_a, s_b, t)), chord = interpolate(from, to, t);
    seen.position = std::max(seen.position, distance_between(pose, chord));
    seen.orientation = std::max(seen.orientation, turn_between(pose, chord));
  }
  return seen;
}

TEST(SegmentChordBound, HoldsForAllSegmentsAndIsNotWasteful) {
  Random random;
  std::map<std::string, std::vector<double>> ways, turns;
  for (int i = 0; i < 20000; ++i) {
    const Segment segment = random_segment(random);
    const double step = std::pow(10, random.uniform(-3, 0));
    const double s_a = random.uniform(0, 1 - step), s_b = s_a + step;
    const bool back = random.integer(0, 1) == 1;
    const SegmentChordBound bound =
        back ? segment_chord_bound(segment, s_b, s_a) : segment_chord_bound(segment, s_a, s_b);
    const Deviation seen = back ? sampled(segment, s_b, s_a, 20) : sampled(segment, s_a, s_b, 20);
    const double size = 1e-13 * size_of(segment);
    ASSERT_LE(seen.position, bound.position + 10 * size) << kind_of(segment) << " step " << step;
    ASSERT_LE(seen.orientation, bound.orientation + size) << kind_of(segment) << " step " << step;
    if (step > 0.1) continue;
    const double turned = motion_at(segment, s_a).velocity.tail<3>().norm() * step;
    if (bound.position > 1e-9) ways[kind_of(segment)].push_back(seen.position / bound.position);
    if (bound.orientation > 1e-9 && turned > 1e-6) {
      turns[kind_of(segment)].push_back(seen.orientation / bound.orientation);
    }
  }
  for (auto& [what, all] : {std::pair{"position", &ways}, std::pair{"orientation", &turns}}) {
    for (auto& [kind, ratios] : *all) {
      std::sort(ratios.begin(), ratios.end());
      const double median = ratios[ratios.size() / 2];
      std::cout << what << ", " << kind << ": median of seen/bound " << median << ", least "
                << ratios.front() << " of " << ratios.size() << '\n';
      EXPECT_GT(median, 0.8) << what << ' ' << kind;
    }
  }
}

TEST(SegmentChordBound, OfAnArcIsItsRise) {
  Random random;
  for (int i = 0; i < 2000; ++i) {
    const auto poses = random_poses(random, 3, 1, 3);
    const Arc arc = arc_through(poses[0], poses[1].translation(), poses[2]);
    const double radius = (arc.from.translation() - arc.centre).norm();
    const double s_a = random.uniform(0, 1), s_b = random.uniform(0, 1);
    const double angle = arc.turn.norm() * std::abs(s_b - s_a);
    const SegmentChordBound bound = segment_chord_bound(arc, s_a, s_b);
    const double rise = 2 * radius * std::pow(std::sin(angle / 4), 2);
    ASSERT_NEAR(bound.position, rise, 1e-9 * rise);
    ASSERT_LE(sampled(arc, s_a, s_b, 100).position, rise + 1e-13 * (1 + radius));
    ASSERT_EQ(bound.orientation, 0);
  }
}

TEST(SegmentChordBound, AsAVectorIsTheBendButForTheRest) {
  Random random;
  for (int i = 0; i < 10000; ++i) {
    const Segment segment = random_segment(random);
    const double step = std::pow(10, random.uniform(-3, 0));
    const double s_a = random.uniform(0, 1 - step), s_b = s_a + step;
    const SegmentChordBound bound = segment_chord_bound(segment, s_a, s_b);
    const Pose from = pose_at(segment, s_a), to = pose_at(segment, s_b);
    for (int k = 1; k < 20; ++k) {
      const double t = k / 20.0;
      const Vector3 off =
          pose_at(segment, s_a + t * step).translation() - interpolate(from, to, t).translation();
      ASSERT_LE((off + 4 * t * (1 - t) * bound.bend).norm(), bound.rest + 1e-12 * size_of(segment))
          << kind_of(segment);
    }
  }
}

}  // namespace
}  // namespace beeline
