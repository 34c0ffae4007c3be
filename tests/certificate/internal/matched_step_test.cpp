#include <algorithm>
#include <gtest/gtest.h>

#include <beeline/certificate/internal/matched_step.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>
#include <beeline/path/tool_path.h>

#include <tests/path/random_segment.h>
#include <tests/random_arm.h>
#include <tests/refusal.h>

namespace beeline::internal {
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

// Any segment and any step, at any distance from each other.
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

// Three prismatic joints and one revolute joint: the tool stays on its chord, so only the segment
// contributes.
TEST(MatchedStepBound, HoldsWhereTheToolIsOnItsChord) {
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

TEST(MatchedStepBound, RefusesTasksWithFreeRotations) {
  Random random;
  const Arm ur5 = built_in("ur5"), rrr = built_in("rrr");
  const auto poses = testing::random_poses(random, 2, 1, 1);
  const ScrewLine tilted{poses[0], poses[1]};
  EXPECT_REFUSED(check_matched(ur5, tilted, task_named("direction")), "direction");
  EXPECT_REFUSED(check_matched(ur5, tilted, task_named("110111:tool")), "straight lines only");
  EXPECT_REFUSED(check_matched(ur5, tilted, Task::planar()), "straight lines only");
  EXPECT_REFUSED(check_matched(rrr, tilted, Task::planar()), "straight lines only");
  Pose to = Pose::Identity();
  to.linear() = so3_exp({0, 0, 1});
  to.translation() = Vector3(1, 2, 0);
  EXPECT_NO_THROW(check_matched(rrr, ScrewLine{Pose::Identity(), to}, Task::planar()));
}

}  // namespace
}  // namespace beeline::internal
