#include <gtest/gtest.h>
#include <numbers>

#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se3.h>

#include <tests/random_arm.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

/// Position and coordinates of the orientation of a pose.
Eigen::VectorXd coordinates_of(const Pose& pose, OrientationCoordinates coordinates) {
  const Vector3 p = pose.translation();
  Eigen::VectorXd all(coordinates == OrientationCoordinates::quaternion ? 7 : 6);
  switch (coordinates) {
    case OrientationCoordinates::roll_pitch_yaw: {
      const RollPitchYaw rpy = roll_pitch_yaw(pose.linear());
      all << p, rpy.roll, rpy.pitch, rpy.yaw;
      break;
    }
    case OrientationCoordinates::quaternion: {
      const Quaternion q = quaternion(pose.linear());
      all << p, q.qw, q.qx, q.qy, q.qz;
      break;
    }
    case OrientationCoordinates::rotation_vector:
      all << p, so3_log(pose.linear());
      break;
  }
  return all;
}

TEST(AnalyticalJacobian, IsTheDifferenceQuotientOfTheCoordinates) {
  testing::Random random;
  int compared = 0;
  for (const std::string& arm_name : built_in_names()) {
    const Arm arm = built_in(arm_name);
    for (int i = 0; i < 100; ++i) {
      const Configuration q = random.configuration(arm);
      const Pose tool = forward_kinematics(arm, q);
      const bool steep = std::abs(roll_pitch_yaw(tool.linear()).pitch) > 1.4;
      const bool turned = so3_log(tool.linear()).norm() > 3;  // near the jumps
      if (steep || turned) continue;
      ++compared;
      for (const std::string& name : orientation_coordinates_names()) {
        const OrientationCoordinates of = orientation_coordinates_named(name);
        const Eigen::MatrixXd rows = analytical_jacobian(arm, q, of);
        ASSERT_EQ(rows.rows(), static_cast<Eigen::Index>(row_names(of).size()));
        for (int k = 0; k < arm.dof(); ++k) {
          constexpr double h = 1e-6;
          const Configuration step = h * Configuration::Unit(arm.dof(), k);
          Eigen::VectorXd numeric = coordinates_of(forward_kinematics(arm, q + step), of) -
                                    coordinates_of(forward_kinematics(arm, q - step), of);
          for (Eigen::Index r = 3; r < numeric.size(); ++r) {  // roll and yaw jump at +-pi
            if (of == OrientationCoordinates::roll_pitch_yaw)
              numeric[r] = std::remainder(numeric[r], 2 * std::numbers::pi);
          }
          numeric /= 2 * h;
          ASSERT_LT((rows.col(k) - numeric).norm(), 1e-7 * (1 + numeric.squaredNorm()))
              << arm_name << ' ' << name << " coordinate " << k;
        }
      }
    }
  }
  EXPECT_GT(compared, 200);
}

TEST(AnalyticalJacobian, OfRollPitchYawIsRefusedInGimbalLock) {
  const Arm arm = built_in("ur5");
  const Configuration q{{0, std::numbers::pi / 2, 0, 0, 0, 0}};
  const double pitch = roll_pitch_yaw(forward_kinematics(arm, q).linear()).pitch;
  ASSERT_NEAR(std::abs(pitch), std::numbers::pi / 2, 1e-13);
  EXPECT_REFUSED(analytical_jacobian(arm, q, OrientationCoordinates::roll_pitch_yaw),
                 "a pitch of +-90 degrees");
  EXPECT_REFUSED(orientation_coordinates_named("euler"), "rotation-vector");
}

}  // namespace
}  // namespace beeline
