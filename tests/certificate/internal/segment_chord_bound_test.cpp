#include <algorithm>
#include <gtest/gtest.h>
#include <map>

#include <beeline/certificate/internal/segment_chord_bound.h>
#include <beeline/kinematics/task.h>

#include <tests/path/random_segment.h>

namespace beeline::internal {
namespace {

using testing::distance_between;
using testing::kind_of;
using testing::Random;
using testing::random_poses;
using testing::random_segment;
using testing::size_of;
using testing::turn_between;

/// The largest distances from the chord at equal fractions.
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
      EXPECT_GT(median, 0.8) << what << ' ' << kind;
    }
  }
}

TEST(SegmentChordBound, OfAnArcIsItsSagitta) {
  Random random;
  for (int i = 0; i < 2000; ++i) {
    const auto poses = random_poses(random, 3, 1, 3);
    const Arc arc = arc_through(poses[0], poses[1].translation(), poses[2]);
    const double radius = (arc.from.translation() - arc.centre).norm();
    const double s_a = random.uniform(0, 1), s_b = random.uniform(0, 1);
    const double angle = arc.rotation.norm() * std::abs(s_b - s_a);
    const SegmentChordBound bound = segment_chord_bound(arc, s_a, s_b);
    const double sagitta = 2 * radius * std::pow(std::sin(angle / 4), 2);
    ASSERT_NEAR(bound.position, sagitta, 1e-9 * sagitta);
    ASSERT_LE(sampled(arc, s_a, s_b, 100).position, sagitta + 1e-13 * (1 + radius));
    ASSERT_EQ(bound.orientation, 0);
  }
}

TEST(SegmentChordBound, HoldsAsAVector) {
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
      ASSERT_LE((off + 4 * t * (1 - t) * bound.curvature_term).norm(),
                bound.remainder + 1e-12 * size_of(segment))
          << kind_of(segment);
    }
  }
}

}  // namespace
}  // namespace beeline::internal
