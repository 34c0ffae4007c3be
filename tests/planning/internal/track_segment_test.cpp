#include <algorithm>
#include <gtest/gtest.h>
#include <map>

#include <beeline/certificate/internal/segment_step.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/model/composite.h>
#include <beeline/planning/internal/track_segment.h>

#include <tests/path/random_line.h>
#include <tests/path/random_segment.h>
#include <tests/random_arm.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::kind_of;
using testing::Random;

Task task_of(Random& random) {
  constexpr const char* names[] = {"spatial", "position", "000111", "111111:tool", "101111"};
  return task_named(names[random.integer(0, 4)]);
}

Pose moved_off(Random& random, Pose pose, double size) {
  pose.translation() += random.vector(size);
  pose.linear() = random.rotation(size) * pose.linear();
  return pose;
}

// Any segment and any step, however far from one another.
TEST(MatchedStepBound, HoldsForAnySegmentAndAnyStep) {
  Random random;
  std::vector<double> ratios;
  for (int i = 0; i < 5000; ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 8), random.integer(0, 3));
    const double size = std::pow(10, random.uniform(-3, -0.3)),
                 off = std::pow(10, random.uniform(-9, 0));
    const Configuration q_a = random.configuration(arm);
    Configuration q_b = q_a;
    for (double& q : q_b) q += random.uniform(-size, size);
    std::vector<Pose> poses;
    for (const double t : {0.0, 0.5, 1.0}) {
      poses.push_back(moved_off(random, forward_kinematics(arm, q_a + t * (q_b - q_a)), off));
    }
    Segment segment = random.integer(0, 1) == 0
                          ? Segment(ScrewLine{poses[0], poses[2]})
                          : path_through(poses, PathKind::spline).segments.front();
    if (const auto spline = std::get_if<SplineSegment>(&segment)) {
      if (spline->terms.norm() > 1e3) continue;
    }
    if (random.integer(0, 4) == 0) segment = testing::random_segment(random);
    const Task task = task_of(random);
    check_matched(arm, segment, task);
    const double s_a = random.uniform(0, 1), s_b = random.uniform(0, 1);
    const auto deviation = [&](double t) {
      return task_deviation(task, pose_at(segment, std::lerp(s_a, s_b, t)),
                            forward_kinematics(arm, q_a + t * (q_b - q_a)));
    };
    const Deviation bound =
        matched_step_bound(arm, segment, task, {q_a, s_a, deviation(0)}, {q_b, s_b, deviation(1)});
    for (int k = 0; k <= 20; ++k) {
      const Deviation seen = deviation(k / 20.0);
      ASSERT_LE(seen.position, bound.position * (1 + 1e-9) + 1e-12) << kind_of(segment);
      ASSERT_LE(seen.orientation, bound.orientation * (1 + 1e-9) + 1e-12) << kind_of(segment);
    }
  }
}

// Three slides and one joint that turns: the tool keeps to its chord, and all is the segment's.
TEST(MatchedStepBound, HoldsWhereTheToolKeepsToItsChord) {
  Random random;
  double tightest = 0, tightest_turn = 0;
  for (int i = 0; i < 5000; ++i) {
    std::vector<Joint> joints;
    for (const char* axis : {"x", "y", "z"}) {
      Joint& slide = joints.emplace_back();
      slide.name = axis;
      slide.screw = translation_screw(Vector3::Unit(axis[0] - 'x'));
    }
    joints.push_back(composite_joint('R', "turn").front());
    const Arm arm("crane", joints, Pose(random.rotation()));
    const double off = std::pow(10, random.uniform(-6, 0));
    Configuration q_a = Configuration::Random(4), q_b = 1.5 * Configuration::Random(4);
    Segment segment = ScrewLine{moved_off(random, forward_kinematics(arm, q_a), off),
                                moved_off(random, forward_kinematics(arm, q_b), off)};
    double s_a = 0, s_b = 1;
    if (i % 2 == 0) {
      segment = testing::random_segment(random);
      s_a = random.uniform(0, 1), s_b = random.uniform(0, 1);
      for (auto [q, s] : {std::pair{&q_a, s_a}, std::pair{&q_b, s_b}}) {  // at its positions
        q->head<3>() = arm.base().linear().transpose() * pose_at(segment, s).translation();
      }
    }
    const auto deviation = [&](double t) {
      return task_deviation(Task::spatial(), pose_at(segment, std::lerp(s_a, s_b, t)),
                            forward_kinematics(arm, q_a + t * (q_b - q_a)));
    };
    const Deviation bound = matched_step_bound(arm, segment, Task::spatial(),
                                               {q_a, s_a, deviation(0)}, {q_b, s_b, deviation(1)});
    for (int k = 1; k < 20; ++k) {
      const Deviation seen = deviation(k / 20.0);
      ASSERT_LE(seen.position, bound.position * (1 + 1e-9) + 1e-12) << kind_of(segment);
      ASSERT_LE(seen.orientation, bound.orientation * (1 + 1e-9) + 1e-9) << kind_of(segment);
      tightest = std::max(tightest, seen.position / bound.position);
      tightest_turn = std::max(tightest_turn, seen.orientation / bound.orientation);
    }
  }
  EXPECT_GT(tightest, 0.99);
  EXPECT_GT(tightest_turn, 0.99);
}

TEST(MatchedStepBound, RefusesTasksThatLeaveTurnsFree) {
  Random random;
  const Arm ur5 = built_in("ur5"), rrr = built_in("rrr");
  const auto poses = testing::random_poses(random, 2, 1, 1);
  const ScrewLine tilted{poses[0], poses[1]};
  EXPECT_REFUSED(check_matched(ur5, tilted, task_named("111110:tool")), "111110:tool");
  EXPECT_REFUSED(check_matched(ur5, tilted, task_named("110111:tool")), "straight lines alone");
  EXPECT_REFUSED(check_matched(ur5, tilted, Task::planar()), "straight lines alone");
  EXPECT_REFUSED(check_matched(rrr, tilted, Task::planar()), "straight lines alone");
  Pose to = Pose::Identity();
  to.linear() = so3_exp({0, 0, 1});
  to.translation() = Vector3(1, 2, 0);
  EXPECT_NO_THROW(check_matched(rrr, ScrewLine{Pose::Identity(), to}, Task::planar()));
}

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
  double length = 0, worst = 0, worst_turn = 0;
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
      tally.worst_turn =
          std::max(tally.worst_turn, off.orientation / way.deviation.bound.orientation);
      ++tally.points;
    }
  }
}

TEST(TrackSegment, StaysWithinTheProvedBoundAllTheWay) {
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
          const TrackedSegment way = track_segment(arm, segment, task, internal::bounds_of(arm), q,
                                                   {.tolerance = tolerance, .max_samples = 5000});
          ASSERT_LE(way.deviation.bound.position, tolerance.position);
          ASSERT_LE(way.deviation.bound.orientation, tolerance.orientation);
          expect_proved(arm, segment, task, way, random, tally);
          if (HasFatalFailure()) return;
          ++(way.through() ? tally.through : tally.ended);
          if (!way.through()) break;
          tally.samples += way.samples.size() - 1;
          tally.length += length_of(segment);
          q = way.samples.back();
          ASSERT_LT(task_deviation(task, pose_at(segment, 1), forward_kinematics(arm, q)).position,
                    1e-9);
        }
      }
      EXPECT_GE(tally.points, 10'000) << arm_name << " kind " << kind;
      EXPECT_GT(tally.through, 10) << arm_name << " kind " << kind;
      std::cout << arm_name << " kind " << kind << ": " << tally.points << " points, seen/bound "
                << tally.worst << ' ' << tally.worst_turn << "; segments " << tally.through
                << " and " << tally.ended << " cut short; " << double(tally.samples) / tally.length
                << " samples per metre\n";
    }
  }
}

// A line as a line, and the same line as a segment of a spline: the same way but for the proof.
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
      return track_segment(arm, segment, Task::spatial(), internal::bounds_of(arm), q, options);
    };
    const TrackedSegment way = go(line);
    const TrackedSegment other =
        go(path_through(std::vector{line.from, line.to}, PathKind::spline).segments.front());
    ASSERT_EQ(way.through(), other.through());
    if (!way.through()) continue;
    ASSERT_LT((way.samples.back() - other.samples.back()).norm(), 1e-8);
    as_line += way.samples.size();
    as_spline += other.samples.size();
  }
  std::cout << as_line << " samples as lines, " << as_spline << " as splines\n";
}

}  // namespace
}  // namespace beeline
