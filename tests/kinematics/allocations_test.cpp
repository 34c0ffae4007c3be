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

}  // namespace
}  // namespace beeline
