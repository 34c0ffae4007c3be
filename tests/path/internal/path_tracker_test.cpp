#include <algorithm>
#include <gtest/gtest.h>

#include <beeline/path/blend.h>
#include <beeline/path/internal/consistent_parameters.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

constexpr Deviation tolerance{1e-3, 1e-3};

/// Poses in a small space: splines through them approach and cross themselves, and have cusps.
std::vector<Pose> close_poses(testing::Random& random) {
  std::vector<Pose> poses;
  const int count = random.integer(4, 8);
  const bool rotates_only = random.integer(0, 4) == 0;  // back and forth
  const double rotation = rotates_only ? 0.5 : random.integer(0, 1) == 0 ? 0 : 0.3;
  for (int k = 0; k < count; ++k) {
    Pose pose = Pose::Identity();
    if (!rotates_only) pose.translation() = random.vector(0.1);
    if (random.integer(0, 1) == 0) pose.translation().z() = 0;
    pose.linear() = random.rotation(rotation);
    // Back to near an earlier pose, or along a hairpin.
    if (k > 1 && random.integer(0, 2) == 0) {
      pose = poses[static_cast<std::size_t>(random.integer(0, k - 2))];
      pose.translation() += random.vector(0.002);
    }
    poses.push_back(pose);
  }
  return poses;
}

ToolPath self_approaching(testing::Random& random, const std::vector<Pose>& poses) {
  return random.integer(0, 2) == 0 ? blended_lines(poses, {0.02, 0.3}).path
                                   : path_through(poses, PathKind::spline);
}

/// Samples of a motion along the path, off it by up to half the tolerance.
struct Along {
  std::vector<double> parameters;
  std::vector<Pose> poses;
};

Along samples_along(testing::Random& random, const ToolPath& path) {
  Along along{{0}, {pose_at(path, 0)}};
  const auto end = static_cast<double>(path.segments.size());
  const double largest_step = random.integer(0, 1) == 0 ? 0.02 : 0.3;
  while (along.parameters.back() < end) {
    const double s = std::min(end, along.parameters.back() + random.uniform(0, largest_step));
    Pose pose = pose_at(path, s);
    pose.translation() += random.uniform(0, 0.5) * tolerance.position * random.direction();
    pose.linear() = random.rotation(0.5 * tolerance.orientation) * pose.linear();
    along.parameters.push_back(s);
    along.poses.push_back(pose);
  }
  return along;
}

TEST(ConsistentParameters, AreThoseOfTheSamplesOnPathsThatApproachThemselves) {
  testing::Random random;
  long samples = 0, elsewhere = 0;
  for (int round = 0; round < testing::cases(300); ++round) {
    const ToolPath path = self_approaching(random, close_poses(random));
    const Along along = samples_along(random, path);
    const auto end = static_cast<double>(path.segments.size());
    const Task task = Task::spatial();
    const PathTracker tracker(path, task, 0, end, tolerance);
    std::vector<double> first{0};
    for (std::size_t k = 1; k < along.poses.size(); ++k) {
      const auto fit = tracker.first_within(along.poses[k], first.back());
      ASSERT_TRUE(fit) << "case " << round << ", sample " << k << " of " << along.poses.size()
                       << " at " << along.parameters[k] << " after " << first.back();
      first.push_back(*fit);
    }
    first.back() = end;
    const auto moved = [&](std::size_t k) {
      return tracker.length(along.parameters[k], along.parameters[k + 1]);
    };
    const std::vector<double> found = consistent_parameters(tracker, along.poses, first, moved);
    ASSERT_EQ(found.size(), along.poses.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (k > 0) {
        ASSERT_GE(found[k], found[k - 1]);
      }
      const Deviation off = task_deviation(task, pose_at(path, found[k]), along.poses[k]);
      ASSERT_TRUE(within(off, tolerance)) << "case " << round << ", sample " << k;
      const double a = std::min(found[k], along.parameters[k]);
      const double b = std::max(found[k], along.parameters[k]);
      elsewhere += tracker.length(a, b) > 3 * tolerance.position;
      ++samples;
    }
  }
  EXPECT_LT(static_cast<double>(elsewhere), 1e-3 * static_cast<double>(samples))
      << elsewhere << " of " << samples;
}

// Without cells the distance has two minima near a cusp between two scanned points.
TEST(PathTracker, FindsBothSidesOfACusp) {
  std::vector<Pose> poses(3, Pose::Identity());
  poses[1].translation() = Vector3(0.1, 0, 0);
  poses[2].translation() = Vector3(0.002, 0.0003, 0);
  const ToolPath path = path_through(poses, PathKind::spline);
  const PathTracker tracker(path, Task::spatial(), 0, 2, {1e-4, 1e-4});
  for (const double s : {0.9, 0.99, 0.995, 1.005, 1.01, 1.1}) {
    const Pose pose = pose_at(path, s);
    const std::vector<double> fits = tracker.fits(pose, 0, 2);
    const auto nearest = std::min_element(fits.begin(), fits.end(), [&](double a, double b) {
      return std::abs(a - s) < std::abs(b - s);
    });
    ASSERT_NE(nearest, fits.end());
    EXPECT_NEAR(*nearest, s, 1e-6);
  }
}

}  // namespace
}  // namespace beeline::internal
