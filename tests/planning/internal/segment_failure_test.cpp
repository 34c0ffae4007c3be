#include <gtest/gtest.h>
#include <utility>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/math/decompositions.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/internal/segment_failure.h>
#include <beeline/planning/internal/track_segment.h>

#include <tests/path/random_line.h>
#include <tests/reason.h>

namespace beeline::internal {
namespace {

/// By how much a pose is missed is the answer of inverse kinematics for the pose that stands with
/// it; the first is of the kind that the reason is of.
void expect_amount_of_its_pose(const Arm& arm, const Line& line, const Task& task,
                               const Configuration& q, const Reason& reason) {
  const bool by_position = reason.code == ReasonCode::path_leaves_workspace;
  const bool by_orientation = reason.code == ReasonCode::path_loses_orientation;
  bool first = by_position || by_orientation;
  for (const Reason& detail : reason.details) {
    const bool position = detail.code == ReasonCode::position_unreachable;
    if (!position && detail.code != ReasonCode::orientation_unreachable) continue;
    const double s = testing::field<double>(detail, ReasonField::fraction).value_or(-1);
    const double amount =
        *testing::field<double>(detail, position ? ReasonField::distance : ReasonField::angle);
    const Pose pose = interpolate(line.from, line.to, s);
    InverseResult there = inverse_kinematics(arm, pose, {.seed = q, .task = task});
    explain(there);
    EXPECT_TRUE(there.solutions.empty()) << reason;
    EXPECT_NEAR(amount, there.residual, 0.02 * there.residual + 1e-5) << reason;
    EXPECT_GT(amount, 0) << reason;
    if (!std::exchange(first, false)) continue;
    EXPECT_EQ(there.status,
              by_position ? InverseStatus::unreachable : InverseStatus::orientation_unreachable)
        << reason;
  }
}

// The reason is checked independently at the pose where the line stops.
TEST(SegmentFailure, GivesTheTrueReason) {
  testing::Random random;
  int seen[8] = {};  // by status
  for (const std::string name : {"rrr", "panda", "ur5", "puma560", "stanford"}) {
    const Arm arm = built_in(name);
    const Task task = default_task(arm);
    for (int i = 0; i < 40; ++i) {
      const Configuration start = testing::inner_configuration(random, arm);
      const Pose from = forward_kinematics(arm, start);
      const Line line{from, testing::nearby_pose(random, arm, from)};
      const TrackedSegment way = track_segment(arm, line, task, bounds_of(arm), start,
                                               {.tolerance = {1e-4, 1e-3}, .max_samples = 100'000});
      if (way.complete()) continue;
      const Configuration& q = way.samples.back();
      const SegmentFailure failure = segment_failure(arm, line, task, q, way.fractions.back());
      ++seen[static_cast<int>(failure.status)];

      const double s = way.fractions.back();
      const Pose ahead = interpolate(line.from, line.to, s + 1e-3);
      const InverseResult inverse = inverse_kinematics(arm, ahead, {.seed = q, .task = task});
      const Eigen::VectorXd sigma =
          Eigen::JacobiSVD<Eigen::MatrixXd>(task_jacobian(arm, q, task)).singularValues();
      const bool singular = sigma[sigma.size() - 1] < 1e-3 * sigma[0];
      const std::string context = name + ": " + sentence(failure.reason);
      expect_amount_of_its_pose(arm, line, task, q, failure.reason);
      switch (failure.status) {
        case MotionStatus::unreachable:
        case MotionStatus::not_found:
          ASSERT_TRUE(singular) << context;
          ASSERT_TRUE(inverse.solutions.empty()) << context;
          break;
        case MotionStatus::singular:
          ASSERT_TRUE(singular) << context;
          ASSERT_FALSE(inverse.solutions.empty()) << context;
          break;
        case MotionStatus::outside_limits: {
          bool named = false;
          for (int k = 0; k < arm.dof(); ++k) {
            const Limits& limits = arm.limits(k);
            const double room = std::min(q[k] - limits.lower, limits.upper - q[k]);
            const std::string& joint = arm.joint_of(k).name;
            named |= room < 1e-3 && testing::joint(failure.reason) == joint;
            for (const Reason& detail : failure.reason.details) {
              named |= room < 1e-3 && testing::joint(detail) == joint;
            }
          }
          ASSERT_TRUE(named || singular) << context;
          break;
        }
        default:
          FAIL() << context;
      }
    }
  }
  EXPECT_GT(seen[static_cast<int>(MotionStatus::unreachable)], 0);
  EXPECT_GT(seen[static_cast<int>(MotionStatus::outside_limits)], 0);
  EXPECT_GT(seen[static_cast<int>(MotionStatus::singular)], 0);
}

// The line may be much longer than the arm: what is said still belongs to the pose at its side.
TEST(SegmentFailure, OfALongLineIsFoundAtTheArmsSize) {
  const Arm arm = built_in("panda");
  const Configuration start{{0, -0.785, 0, -2.356, 0, 1.571, 0.785}};
  const Pose from = forward_kinematics(arm, start);
  for (const double length : {1.0, 1e2, 1e5}) {
    Pose to = from;
    to.translation().x() += length;
    const Line line{from, to};
    const TrackedSegment way = track_segment(arm, line, Task::spatial(), bounds_of(arm), start,
                                             {.tolerance = {1e-4, 1e-4}, .max_samples = 100'000});
    ASSERT_FALSE(way.complete());
    const double s = way.fractions.back();
    const SegmentFailure failure =
        segment_failure(arm, line, Task::spatial(), way.samples.back(), s);
    EXPECT_EQ(failure.status, MotionStatus::unreachable) << failure.reason;
    expect_amount_of_its_pose(arm, line, Task::spatial(), way.samples.back(), failure.reason);
    // Where it stops the arm can be; a little further on it cannot.
    const Pose ahead = interpolate(from, to, s + 2e-3 / length);
    EXPECT_NE(inverse_kinematics(arm, ahead, {.seed = way.samples.back()}).status,
              InverseStatus::solved)
        << failure.reason;
  }
}

TEST(SegmentFailure, OfTooManySamplesNamesTheirNumberAndTheOption) {
  const SegmentFailure failure = too_many_samples(1234);
  EXPECT_EQ(failure.status, MotionStatus::too_many_samples);
  EXPECT_EQ(testing::field<std::size_t>(failure.reason, ReasonField::max_samples), 1234U);
}

}  // namespace
}  // namespace beeline::internal
