#include <algorithm>
#include <gtest/gtest.h>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/model/moving_base.h>
#include <beeline/pose/se3.h>

#include <tests/random.h>

// Arms on rails and mobile bases: seven to ten joints.

namespace beeline {
namespace {

struct MovingArm {
  std::string what;
  Arm arm;
};

std::vector<MovingArm> moving_arms() {
  const Limits rail{.lower = -0.5, .upper = 1.5}, plane{.lower = -2, .upper = 2};
  std::vector<MovingArm> arms;
  for (const char* name : {"ur5", "puma560", "stanford", "panda", "scara", "px150"}) {
    for (const Vector3& axis : {Vector3(1, 0, 0), Vector3(0, 0, 1), Vector3(1, -2, 0.5)}) {
      arms.push_back({std::string(name) + " on a rail", with_rail(built_in(name), axis, rail)});
    }
    arms.push_back({std::string(name) + " on a mobile base",
                    with_mobile_base(built_in(name), {.x = plane, .y = plane})});
  }
  return arms;
}

TEST(MovingBase, InverseKinematicsFindsReachablePoses) {
  testing::Random random;
  for (const auto& [what, arm] : moving_arms()) {
    for (int i = testing::cases(150); i > 0; --i) {
      const Configuration q = random.configuration(arm);
      const Pose pose = forward_kinematics(arm, q);
      const InverseResult found = inverse_kinematics(arm, pose);
      ASSERT_EQ(found.status, InverseStatus::solved) << what << " at " << q.transpose();
      for (const Configuration& solution : found.solutions) {
        EXPECT_TRUE(outside_limits(arm, solution).empty()) << what;
        EXPECT_TRUE(forward_kinematics(arm, solution).isApprox(pose, 1e-9)) << what;
      }
    }
  }
}

TEST(MovingBase, ASeedThatSolvesIsTheSolution) {
  testing::Random random;
  for (const auto& [what, arm] : moving_arms()) {
    for (int i = testing::cases(60); i > 0; --i) {
      const Configuration q = random.configuration(arm);
      const InverseResult found = inverse_kinematics(arm, forward_kinematics(arm, q), {.seed = q});
      ASSERT_EQ(found.status, InverseStatus::solved) << what;
      EXPECT_LT((found.solutions.front() - q).norm(), 1e-8) << what;
    }
  }
}

/// With the rail locked, an arm on a rail is the arm.
TEST(MovingBase, AllSolutionsWithALockedRailAreThoseOfTheArm) {
  testing::Random random;
  for (const char* name : {"ur5", "puma560"}) {
    const Arm arm = built_in(name);
    const Vector3 axis = random.direction();
    const Arm moving = with_rail(arm, axis, {.lower = -1, .upper = 1});
    ASSERT_TRUE(has_closed_form(moving));
    for (int i = testing::cases(100); i > 0; --i) {
      const Configuration q = random.configuration(moving);
      const Pose pose = forward_kinematics(moving, q);
      const InverseResult found =
          inverse_kinematics(moving, pose, {.seed = q, .all = true, .lock = 0});
      ASSERT_EQ(found.status, InverseStatus::solved);
      EXPECT_EQ(found.method.find("numerical"), std::string::npos) << found.method;
      const Pose seen = Pose(Eigen::Translation3d(-q[0] * axis)) * pose;
      EXPECT_EQ(found.solutions.size(),
                inverse_kinematics(arm, seen, {.all = true}).solutions.size());
      const bool has_seed =
          std::any_of(found.solutions.begin(), found.solutions.end(),
                      [&](const Configuration& each) { return (each - q).norm() < 1e-6; });
      EXPECT_TRUE(has_seed) << name << " at " << q.transpose();
    }
  }
}

TEST(MovingBase, PosesOutOfReachAreRefused) {
  const Limits range{.lower = 0, .upper = 2};
  const Arm rail = with_rail(built_in("ur5"), Vector3::UnitX(), range);
  const Arm mobile = with_mobile_base(built_in("panda"), {.x = range, .y = range});
  for (const Arm& arm : {rail, mobile}) {
    const auto status = [&](double x, double z) {
      return inverse_kinematics(arm, Pose(Eigen::Translation3d(x, 0, z))).status;
    };
    EXPECT_EQ(status(1, 2.5), InverseStatus::unreachable);
    EXPECT_EQ(status(9, 0.5), InverseStatus::outside_limits);  // of the base
  }
}

}  // namespace
}  // namespace beeline
