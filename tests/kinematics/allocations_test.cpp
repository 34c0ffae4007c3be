#include <gtest/gtest.h>

#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/model/catalog.h>

#include <tests/allocations.h>
#include <tests/random_arm.h>

namespace beeline {
namespace {

TEST(Kinematics, DoesNotAllocateIntoTheCallersBuffers) {
#if !BEELINE_COUNTS_ALLOCATIONS
  GTEST_SKIP() << "allocations cannot be counted on this platform";
#endif
  testing::Random random;
  std::vector<Arm> arms;
  for (const std::string& name : built_in_names()) arms.push_back(built_in(name));
  for (int i = 0; i < 20; ++i) arms.push_back(testing::random_arm(random, 1 + i, i % 4));
  for (const Arm& arm : arms) {
    const Configuration q = random.configuration(arm);
    Jacobian columns(6, arm.dof());
    std::vector<Pose> links(arm.joints().size() + 1);
    const long before = allocations;
    const Pose tool = forward_kinematics(arm, q);
    link_poses(arm, q, links);
    for (const Frame frame : {Frame::base, Frame::tool, Frame::space}) {
      EXPECT_TRUE(jacobian(arm, q, columns, frame).isApprox(tool));
    }
    EXPECT_EQ(allocations, before) << arm.name() << " of " << arm.dof();
  }
  const long before = allocations;
  std::free(std::malloc(8));
  EXPECT_EQ(allocations, before + 1);  // the counter works
}

TEST(Derivatives, DoNotAllocateIntoTheCallersBuffers) {
#if !BEELINE_COUNTS_ALLOCATIONS
  GTEST_SKIP() << "allocations cannot be counted on this platform";
#endif
  testing::Random random;
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    const Configuration q = random.configuration(arm), dq = q, ddq = q;
    Jacobian columns(6, arm.dof()), derivative(6, arm.dof());
    Hessian derivatives(6, arm.dof() * arm.dof());
    for (const Frame frame : {Frame::base, Frame::tool, Frame::space}) {
      const long before = allocations;
      const Pose tool = jacobian_derivative(arm, q, dq, derivative, frame);
      hessian(arm, q, columns, derivatives, frame);
      const Twist acceleration = tool_acceleration(arm, q, dq, ddq, frame);
      EXPECT_EQ(allocations, before) << name;
      EXPECT_EQ(columns, jacobian(arm, q, frame));
      EXPECT_TRUE(tool.isApprox(forward_kinematics(arm, q)));
      EXPECT_TRUE(acceleration.isApprox(columns * ddq + derivative * dq));
    }
  }
}

}  // namespace
}  // namespace beeline
