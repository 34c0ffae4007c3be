#include <beeline/certificate/verify.h>

#include <tests/planning/dense_search.h>
#include <tests/planning/motion_promises.h>
#include <tests/reason.h>

namespace beeline {
namespace {

using namespace testing;

class CertifiedLines : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Arms, CertifiedLines,
                         ::testing::Values("puma560", "ur5", "panda", "iiwa14"),
                         [](const auto& arm) { return std::string(arm.param); });

/// The bound holds at 2,000 path parameters, and is at most three times the largest deviation
/// there.
void expect_proof_is_tight(const Arm& arm, const Line& line, const PathMotion& motion) {
  const auto& q = motion.trajectory.positions;
  const int parts = 2'000 / static_cast<int>(q.size()) + 4;
  Deviation worst;
  for (std::size_t k = 0; k + 1 < q.size(); ++k) {
    for (int i = 0; i < parts; ++i) {
      const Configuration between =
          motion_between(motion.trajectory, k, static_cast<double>(i) / parts);
      const Deviation off = off_segment(line, forward_kinematics(arm, between));
      worst.position = std::max(worst.position, off.position);
      worst.orientation = std::max(worst.orientation, off.orientation);
    }
  }
  const Deviation& bound = motion.deviation.bound;
  ASSERT_LE(worst.position, bound.position + 1e-12);
  ASSERT_LE(worst.orientation, bound.orientation + 1e-12);
  // The joint path itself leaves the line by up to a hundredth of the tolerance.
  EXPECT_LE(bound.position, 2 * worst.position + 1e-6);
  EXPECT_LE(bound.orientation, 2.5 * worst.orientation + 2e-6);
}

/// An independent search reaches no farther, and finds the same obstacle.
void expect_rightly_refused(const Arm& arm, const Line& line, const PathMotion& motion) {
  const double told = stopped_at(motion);
  if (arm.dof() == 7) {
    const DenseAnswer dense = dense_layers(arm, line.from, line.to, 80, 48, 0.3);
    EXPECT_FALSE(dense.feasible()) << motion.reason;
    EXPECT_TRUE(motion.status == MotionStatus::unreachable ||
                motion.status == MotionStatus::outside_limits ||
                motion.status == MotionStatus::singular)
        << motion.reason;
    return;
  }
  const DenseAnswer dense = dense_branches(arm, line.from, line.to);
  ASSERT_FALSE(dense.feasible() && dense.margin > 1e-6) << motion.reason;
  EXPECT_NEAR(told, dense.reached, 2e-3) << motion.reason;
  if (dense.joint >= 0) {
    EXPECT_EQ(motion.status, MotionStatus::outside_limits) << motion.reason;
    EXPECT_EQ(testing::joint(motion.reason), arm.joint_of(dense.joint).name);
    return;
  }
  const Pose ahead = interpolate(line.from, line.to, std::min(1.0, dense.reached + 1e-3));
  const bool reachable =
      inverse_kinematics(arm, ahead, {.ignore_limits = true}).status == InverseStatus::solved;
  EXPECT_EQ(motion.status, reachable ? MotionStatus::singular : MotionStatus::unreachable)
      << motion.reason;
}

TEST_P(CertifiedLines, EveryFeasibleLineIsSolvedAndEveryOtherRefusedWithItsReason) {
  const Arm arm = built_in(GetParam());
  Random random;
  int solved = 0;
  for (int i = 0; i < cases(40) && !HasFatalFailure(); ++i) {
    SCOPED_TRACE(i);
    const Line line = random_certified_line(random, arm);
    const std::vector<Pose> poses{line.from, line.to};
    const PathMotion motion = move_in_lines(arm, poses, {.profile = Profile::fastest});
    if (motion.status != MotionStatus::reached) {
      expect_rightly_refused(arm, line, motion);
      continue;
    }
    ++solved;
    expect_within_limits(arm, motion.trajectory);
    expect_proof_is_tight(arm, line, motion);
    const Trajectory& made = motion.trajectory;
    EXPECT_FALSE(verify(arm, made, poses).reason);
  }
  EXPECT_GE(solved, cases(40) / 8);
}

}  // namespace
}  // namespace beeline
