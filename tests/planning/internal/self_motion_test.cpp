#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/planning/internal/self_motion_sweep.h>

#include <tests/planning/motion_promises.h>

namespace beeline::internal {
namespace {

using namespace testing;

SelfMotion self_motion(const Arm& arm) {
  return {arm, Task::spatial(), bounds_of(arm), std::vector<bool>(7, false), 0.15};
}

TEST(SelfMotion, KeepsTheToolAtThePoseWithinLimits) {
  Random random;
  for (const char* name : {"panda", "iiwa14"}) {
    const Arm arm = built_in(name);
    SelfMotion motion = self_motion(arm);
    for (int i = 0; i < cases(40); ++i) {
      const Configuration q = random.configuration(arm);
      const Pose pose = forward_kinematics(arm, q);
      const SelfMotionCurve curve = motion.curve_through(pose, RedundantConfiguration(q));
      ASSERT_GE(curve.nodes.size(), 2);
      for (std::size_t k = 0; k < curve.nodes.size(); ++k) {
        const Configuration node = curve.nodes[k];
        const Deviation off = task_deviation(Task::spatial(), pose, forward_kinematics(arm, node));
        ASSERT_LT(std::max(off.position, off.orientation), 1e-6);
        ASSERT_TRUE(limit_violations(arm, node).empty());
        if (k == 0) continue;
        ASSERT_LT((node - Configuration(curve.nodes[k - 1])).norm(), 0.2);
      }
      EXPECT_TRUE(node_near(motion, curve, RedundantConfiguration(q), 1e-9));
    }
  }
}

// A curve ends at a limit, or at a singularity.
TEST(SelfMotion, EndsAtLimits) {
  const Arm arm = built_in("panda");
  Random random;
  SelfMotion motion = self_motion(arm);
  int at_limits = 0;
  for (int i = 0; i < cases(40); ++i) {
    const Configuration q = random.configuration(arm);
    const SelfMotionCurve curve =
        motion.curve_through(forward_kinematics(arm, q), RedundantConfiguration(q));
    if (curve.closed) continue;
    at_limits += motion.margin(curve.nodes.front()) < 1e-3;
    at_limits += motion.margin(curve.nodes.back()) < 1e-3;
  }
  EXPECT_GE(at_limits, cases(40));
}

// Every solution of inverse kinematics within the limits is on a curve of the first layer.
TEST(SelfMotionSweep, FirstLayerHasAllSelfMotions) {
  Random random;
  for (const char* name : {"panda", "iiwa14"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < cases(20); ++i) {
      const Pose from = forward_kinematics(arm, random.configuration(arm));
      const ToolPath path = lines_through(std::vector{from, nearby_pose(random, arm, from)});
      const GraphOptions options{.task = Task::spatial()};
      SelfMotionSweep sweep(arm, path, options, std::vector<bool>(7, false), unlimited());
      sweep.run();
      const InverseResult all = inverse_kinematics(arm, from, {.all = true, .grid = 200});
      ASSERT_FALSE(all.solutions.empty());
      for (const Configuration& q : all.solutions) {
        bool found = false;
        for (const SelfMotionCurve& curve : sweep.layers().front().curves) {
          found |= node_near(sweep.motion(), curve, RedundantConfiguration(q), 0.05).has_value();
        }
        EXPECT_TRUE(found) << name << ": " << q.transpose();
      }
    }
  }
}

}  // namespace
}  // namespace beeline::internal
