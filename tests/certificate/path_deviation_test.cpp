#include <gtest/gtest.h>

#include <beeline/certificate/internal/path_interval.h>
#include <beeline/certificate/internal/path_step.h>
#include <beeline/certificate/verify.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/path/internal/path_tracker.h>
#include <beeline/planning/internal/track_segment.h>
#include <beeline/pose/se3.h>

#include <tests/path/random_line.h>
#include <tests/path/random_segment.h>
#include <tests/refusal.h>

namespace beeline {

using namespace internal;

namespace {

using testing::Random;

Configuration at(double x, double y) { return Configuration{{x, y}}; }

/// Linear joints through the samples, a second apart.
Trajectory linear(const Arm& arm, const std::vector<Configuration>& samples) {
  Trajectory trajectory{arm.joint_names(), {}, samples, {}, {}};
  for (std::size_t k = 0; k < samples.size(); ++k) {
    trajectory.times.push_back(static_cast<double>(k));
  }
  return trajectory;
}

TEST(PathDeviation, MeasuresEveryLineFromItsOwnWaypoint) {
  const Arm arm = built_in("gantry");
  const std::vector<Configuration> samples{at(0, 0), at(1, 0.25), at(2, 0), at(2.5, 1), at(2, 2)};
  std::vector<Pose> poses;
  for (const Configuration& q : {at(0, 0), at(2, 0), at(2, 2)}) {
    poses.push_back(forward_kinematics(arm, q));
  }
  const ToolPath path = lines_through(poses);
  const Task task = Task::position();
  const std::vector<std::size_t> reached{2, 4};
  const std::vector<double> path_parameters =
      path_parameters_along(arm, samples, path, reached, task);
  EXPECT_EQ(arrivals(path_parameters), reached);
  EXPECT_NEAR(path_parameters[1], 0.5, 1e-12);
  const PathDeviation told = path_deviation(arm, linear(arm, samples), path_parameters, path, task);
  EXPECT_NEAR(told.sampled.position, 0.5, 1e-15);
  EXPECT_GE(told.bound.position, 0.5);
  EXPECT_NEAR(told.bound.position, 0.5, 1e-12) << "slides leave no arc";
  EXPECT_EQ(told.sampled.orientation, 0);
}

TEST(PathDeviation, RefusesWhatDoesNotFit) {
  const Arm arm = built_in("rrr");
  const std::vector<Configuration> samples{Configuration::Zero(3), Configuration::Zero(3)};
  const ToolPath path = lines_through(std::vector{make_pose({0, 0, 0}), make_pose({9, 0, 0})});
  const auto placed = [&](std::vector<std::size_t> reached) {
    return path_parameters_along(arm, samples, path, reached, Task::planar());
  };
  EXPECT_REFUSED(placed({0, 1}), "arrival");
  EXPECT_REFUSED(placed({2}), "arrival 1");
  EXPECT_REFUSED(path_parameters_along(arm, {}, path, {}, Task::planar()), "samples");
  const auto told = [&](std::vector<double> path_parameters, const ToolPath& on) {
    return path_deviation(arm, linear(arm, samples), path_parameters, on, Task::planar());
  };
  EXPECT_NO_THROW(told({0.2, 1}, path));
  EXPECT_REFUSED(told({0}, path), "2 samples and 1 path parameters");
  EXPECT_REFUSED(told({0.5, 0.4}, path), "sample 2");
  EXPECT_REFUSED(told({-0.1, 1}, path), "sample 1");
  EXPECT_REFUSED(told({0, 1.5}, path), "sample 2");
  EXPECT_REFUSED(told({0, NAN}, path), "sample 2");
  EXPECT_REFUSED(told({0, 0}, ToolPath{}), "segments");
}

/// A path of the kind in front of the arm.
ToolPath path_ahead(Random& random, const Arm& arm, const Pose& from, int kind) {
  std::vector<Pose> poses{from};
  for (int w = 0; w < 3; ++w) poses.push_back(testing::nearby_pose(random, arm, from));
  if (kind == 4) return blended_lines(poses, {0.03, 0.3}).path;
  if (kind == 2) poses.pop_back();
  return path_through(poses, static_cast<PathKind>(kind));
}

/// Follows a path with joints linear between a few samples on it, of which only the last is at the
/// end of a segment.
struct Coarse {
  std::vector<Configuration> samples;
  std::vector<double> path_parameters;
};

Coarse coarse(const Arm& arm, const ToolPath& path, Configuration q) {
  Coarse way{{q}, {0}};
  for (std::size_t i = 0; i < path.segments.size(); ++i) {
    const TrackedSegment segment =
        track_segment(arm, path.segments[i], Task::spatial(), bounds_of(arm), q,
                      {.tolerance = {1e-4, 1e-4}, .max_samples = 2000});
    const bool last = i + 1 == path.segments.size() || !segment.complete();
    for (std::size_t k = 1; k < segment.samples.size(); ++k) {
      const bool end = k + 1 == segment.samples.size();
      if (k % 2 == 0 && !(end && last)) continue;
      way.samples.push_back(segment.samples[k]);
      way.path_parameters.push_back(static_cast<double>(i) + segment.fractions[k]);
    }
    if (!segment.complete()) break;
    q = segment.samples.back();
  }
  return way;
}

// The deviation between samples is included, also at the corners of lines, where it is large.
TEST(PathDeviation, BoundsWhatIsBetweenSamplesAlsoOverTheEndsOfSegments) {
  Random random;
  int cut = 0;
  for (int i = 0; i < 60; ++i) {
    const Arm arm = built_in(i % 2 == 0 ? "ur5" : "puma560");
    const Configuration q = testing::inner_configuration(random, arm);
    const ToolPath path = path_ahead(random, arm, forward_kinematics(arm, q), i % 5);
    const Coarse way = coarse(arm, path, q);
    const Trajectory motion = linear(arm, way.samples);
    const PathDeviation told =
        path_deviation(arm, motion, way.path_parameters, path, Task::spatial());
    ASSERT_LE(told.sampled.position, 1e-9);
    for (std::size_t k = 1; k < way.samples.size(); ++k) {
      const auto parts = path_intervals(arm, motion, k - 1, path, Task::spatial(),
                                        way.path_parameters[k - 1], way.path_parameters[k]);
      cut += parts.size() > 1;
      for (const PathInterval& part : parts) {
        for (int j = 0; j <= 10; ++j) {
          const double u = part.from + j / 10.0 * (part.to - part.from);
          const Configuration between =
              way.samples[k - 1] + u * (way.samples[k] - way.samples[k - 1]);
          const Deviation off = deviation_from(path.segments[part.segment],
                                               std::clamp(part.interval.s(j / 10.0), 0.0, 1.0),
                                               forward_kinematics(arm, between), Task::spatial());
          ASSERT_LE(off.position, told.bound.position + 1e-12);
          ASSERT_LE(off.orientation, told.bound.orientation + 1e-12);
        }
      }
      ASSERT_EQ(parts.front().from, 0);
      ASSERT_EQ(parts.back().to, 1);
    }
  }
  EXPECT_GT(cut, 20);
}

// A segment at rest has no part of its own, wherever it is.
TEST(PathIntervals, CoverTheWholeIntervalWhereSegmentsAreAtRest) {
  const Arm arm = built_in("ur5");
  const Configuration q{{0.3, -1, 1.2, -1.5, -1.5, 0.2}};
  const Pose a = forward_kinematics(arm, q);
  Pose b = a;
  b.translation().z() += 0.05;
  Trajectory motion = linear(arm, {q, q + Configuration::Constant(6, 0.02)});
  for (const double speed : {0.1, -0.3}) {
    motion.velocities = {Configuration::Constant(6, speed), Configuration::Zero(6)};
    for (const auto& poses :
         {std::vector{a, a, b}, std::vector{a, b, b}, std::vector{a, b, b, b}}) {
      const ToolPath path = lines_through(poses);
      const auto segments = static_cast<double>(path.segments.size());
      const auto parts = path_intervals(arm, motion, 0, path, Task::spatial(), 0.4, segments);
      ASSERT_FALSE(parts.empty());
      EXPECT_EQ(parts.front().from, 0);
      EXPECT_EQ(parts.back().to, 1);
      for (std::size_t i = 1; i < parts.size(); ++i) EXPECT_EQ(parts[i].from, parts[i - 1].to);
    }
  }
}

TEST(PathTracker, FindsTheSamplesOfAPath) {
  Random random;
  for (int i = 0; i < 40; ++i) {
    const Arm arm = built_in("ur5");
    const Configuration q = testing::inner_configuration(random, arm);
    const ToolPath path = path_ahead(random, arm, forward_kinematics(arm, q), i % 5);
    const Coarse way = coarse(arm, path, q);
    double before = 0;
    const bool stops = i % 5 <= 2;  // at corners, one segment at a time
    for (std::size_t k = 1; k < way.samples.size(); ++k) {
      const auto segment = static_cast<double>(segment_at(path, way.path_parameters[k]));
      const double end = stops ? segment + 1 : static_cast<double>(path.segments.size());
      const Pose tool = forward_kinematics(arm, way.samples[k]);
      if (stops) before = std::max(before, segment);
      const internal::PathTracker tracker(path, Task::spatial(), before, end, {1e-4, 1e-4});
      before = tracker.nearest(tool, before);
      const Deviation off = task_deviation(Task::spatial(), pose_at(path, before), tool);
      ASSERT_LT(off.position, 1e-9)
          << i % 5 << " place " << before << " of " << way.path_parameters[k];
      ASSERT_LT(off.orientation, 1e-8) << i % 5;
      ASSERT_NEAR(before, way.path_parameters[k], 1e-6);
    }
  }
}

// If the rotation dominates, the nearest path parameter by both together may have a larger position
// error.
TEST(PathTracker, IsWithinTheToleranceWherePossible) {
  Random random;
  const Deviation tolerance{1e-4, 1e-4};
  int nearest_is_none = 0;
  for (int i = 0; i < 500; ++i) {
    const Pose from = random.pose();
    Pose to = from;
    to.translation() += 0.2 * random.direction();
    to.linear() = so3_exp(1.2 * random.direction()) * from.linear();
    const ToolPath path = path_through(std::vector{from, to}, PathKind::screw);
    const double s = random.uniform(0.1, 0.9);
    Pose tool = pose_at(path, s);
    tool.translation() += 0.95e-4 * random.direction();
    tool.linear() = so3_exp(0.95e-4 * random.direction()) * tool.linear();
    const auto fits = [&](double place) {
      return within(task_deviation(Task::spatial(), pose_at(path, place), tool), tolerance);
    };
    const internal::PathTracker tracker(path, Task::spatial(), 0, 1, tolerance);
    const auto found = tracker.first_fit(tool, 0);
    ASSERT_TRUE(found && fits(*found)) << i;
    nearest_is_none += !fits(tracker.nearest(tool, 0));
  }
  EXPECT_GT(nearest_is_none, 10);
}

TEST(CornerAt, IsWhereLinesMeetAndNotOnASpline) {
  Random random;
  const std::vector<Pose> poses = testing::random_poses(random, 4, 1, 1);
  const ToolPath lines = lines_through(poses), spline = path_through(poses, PathKind::spline);
  const ToolPath rounded = blended_lines(poses, {0.01, 0.1}).path;
  for (const double place : {0.0, 0.5, 1.0, 2.0, 3.0}) {
    EXPECT_EQ(corner_at(lines, place), place == 1 || place == 2);
    EXPECT_FALSE(corner_at(spline, place));
    EXPECT_FALSE(corner_at(rounded, place));
  }
}

TEST(Reversed, IsTheSamePathFromItsEnd) {
  Random random;
  for (int i = 0; i < 50; ++i) {
    const Segment segment = testing::random_segment(random);
    const Segment back = reversed(segment);
    for (const double s : {0.0, 0.1, 0.5, 0.77, 1.0}) {
      const Twist off = pose_difference(pose_at(segment, s), pose_at(back, 1 - s));
      ASSERT_LT(off.norm(), 1e-9) << testing::kind_of(segment) << " " << s;
    }
  }
}

}  // namespace
}  // namespace beeline
