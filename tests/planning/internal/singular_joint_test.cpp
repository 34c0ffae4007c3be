#include <gtest/gtest.h>

#include <beeline/kinematics/manipulability.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/internal/singular_joint.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

/// In a wrist whose middle joint is at 0 or pi, it alone ends the singularity.
TEST(SingularJoint, OfAStretchedWristIsItsMiddleJoint) {
  testing::Random random;
  int tested = 0;
  for (const char* name : {"puma560", "ur5", "ur5e"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < testing::cases(300); ++i) {
      Configuration q = random.configuration(arm);
      q[4] = 0.3;
      const auto condition =
          manipulability_measures(task_jacobian(arm, q, Task::spatial())).condition;
      if (condition > 50) continue;  // the elbow or the shoulder is singular too
      q[4] = 0;
      EXPECT_EQ(singular_joint(arm, Task::spatial(), q), 4) << name << ": " << q.transpose();
      ++tested;
    }
  }
  EXPECT_GE(tested, testing::cases(300) / 2);
}

/// Of a stretched planar arm of two joints it is the elbow; of a regular arm it is none.
TEST(SingularJoint, OfAStretchedArmIsItsElbow) {
  const Arm arm = built_in("scara");
  Configuration q = Configuration::Zero(arm.dof());
  q[0] = 0.4;
  EXPECT_EQ(singular_joint(arm, Task::position(), q), 1);
  q[1] = 1;
  EXPECT_EQ(singular_joint(arm, Task::position(), q), std::nullopt);
}

}  // namespace
}  // namespace beeline::internal
