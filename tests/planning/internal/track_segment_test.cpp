#include <algorithm>
#include <gtest/gtest.h>

#include <beeline/certificate/internal/path_step.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/path/blend.h>
#include <beeline/planning/internal/track_segment.h>

#include <tests/path/random_line.h>
#include <tests/path/random_segment.h>

namespace beeline::internal {
namespace {

using testing::kind_of;
using testing::Random;

/// A path of the kind in front of the arm.
std::vector<Segment> path_ahead(Random& random, const Arm& arm, const Pose& from, int kind) {
  std::vector<Pose> poses{from};
  for (int w = 0; w < 4; ++w) poses.push_back(testing::nearby_pose(random, arm, from));
  for (std::size_t w = 1; kind == 2 && w < poses.size(); w += 2) {  // arcs of moderate size
    const Vector3 aside = (poses[w].translation() - from.translation()) / 3;
    poses[w].translation() = (poses[w - 1].translation() + poses[w + 1].translation()) / 2 + aside;
  }
  if (kind == 4) return blended_lines(poses, {0.03, 0.3}).path.segments;
  return path_through(poses, static_cast<PathKind>(kind)).segments;
}

struct Tally {
  int points = 0, through = 0, ended = 0;
  std::size_t samples = 0;
  double length = 0, worst = 0;
};

/// Between all samples, joints in proportion, the tool stays within the bound.
void expect_proved(const Arm& arm, const Segment& segment, const Task& task,
                   const TrackedSegment& way, Random& random, Tally& tally) {
  for (std::size_t k = 1; k < way.samples.size(); ++k) {
    const Configuration step = way.samples[k] - way.samples[k - 1];
    for (int i = 0; i < 4; ++i) {
      const double t = i == 0 ? 0.5 : random.uniform(0, 1);
      const double s = std::lerp(way.fractions[k - 1], way.fractions[k], t);
      const Pose pose = forward_kinematics(arm, way.samples[k - 1] + t * step);
      const Deviation off = deviation_from(segment, s, pose, task);
      ASSERT_LE(off.position, way.deviation.bound.position + 1e-12) << kind_of(segment);
      ASSERT_LE(off.orientation, way.deviation.bound.orientation + 1e-12) << kind_of(segment);
      tally.worst = std::max(tally.worst, off.position / way.deviation.bound.position);
      ++tally.points;
    }
  }
}

TEST(TrackSegment, StaysWithinTheProvedBound) {
  Random random;
  for (const std::string arm_name : {"puma560", "ur5", "panda", "rrr"}) {
    const Arm arm = built_in(arm_name);
    const Task task = default_task(arm);
    const Deviation tolerance{1e-4, 1e-4};
    for (int kind = 0; kind <= 4; ++kind) {
      Tally tally;
      for (int i = 0; i < 400 && tally.points < 10'000; ++i) {
        Configuration q = testing::inner_configuration(random, arm);
        for (const Segment& segment : path_ahead(random, arm, forward_kinematics(arm, q), kind)) {
          const TrackedSegment way = track_segment(arm, segment, task, bounds_of(arm), q,
                                                   {.tolerance = tolerance, .max_samples = 5000});
          ASSERT_LE(way.deviation.bound.position, tolerance.position);
          ASSERT_LE(way.deviation.bound.orientation, tolerance.orientation);
          expect_proved(arm, segment, task, way, random, tally);
          if (HasFatalFailure()) return;
          ++(way.complete() ? tally.through : tally.ended);
          if (!way.complete()) break;
          tally.samples += way.samples.size() - 1;
          tally.length += length_of(segment);
          q = way.samples.back();
          ASSERT_LT(task_deviation(task, pose_at(segment, 1), forward_kinematics(arm, q)).position,
                    1e-9);
        }
      }
      EXPECT_GE(tally.points, 10'000) << arm_name << " kind " << kind;
      EXPECT_GT(tally.through, 10) << arm_name << " kind " << kind;
      EXPECT_GT(tally.worst, 0.95) << arm_name << " kind " << kind << ": a bound that is tight";
      EXPECT_LT(static_cast<double>(tally.samples), 250 * tally.length)
          << arm_name << " kind " << kind;
    }
  }
}

// A line as Line and as SplineSegment: the same motion with different proofs.
TEST(TrackSegment, OfALineIsTheLine) {
  Random random;
  const Arm arm = built_in("puma560");
  std::size_t as_line = 0, as_spline = 0;
  for (int i = 0; i < 50; ++i) {
    const Configuration q = testing::inner_configuration(random, arm);
    const Pose from = forward_kinematics(arm, q);
    const Line line{from, testing::nearby_pose(random, arm, from)};
    const TrackOptions options{.tolerance = {1e-4, 1e-4}, .max_samples = 5000};
    const auto go = [&](const Segment& segment) {
      return track_segment(arm, segment, Task::spatial(), bounds_of(arm), q, options);
    };
    const TrackedSegment way = go(line);
    const TrackedSegment other =
        go(path_through(std::vector{line.from, line.to}, PathKind::spline).segments.front());
    ASSERT_EQ(way.complete(), other.complete());
    if (!way.complete()) continue;
    ASSERT_LT((way.samples.back() - other.samples.back()).norm(), 1e-8);
    as_line += way.samples.size();
    as_spline += other.samples.size();
  }
  EXPECT_NEAR(static_cast<double>(as_line), static_cast<double>(as_spline),
              0.05 * static_cast<double>(as_spline));
}

}  // namespace
}  // namespace beeline::internal
