#pragma once

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>
#include <beeline/pose/se3.h>

#include <tests/random.h>

namespace beeline::testing {

inline double largest(const Deviation& error) {
  return std::max(error.position, error.orientation);
}

/// Checks all that is promised of a solved answer, by forward kinematics alone.
inline void expect_solved(const Arm& arm, const Pose& pose, const Task& task,
                          const InverseResult& result, double tolerance = 1e-9) {
  ASSERT_EQ(result.status, InverseStatus::solved) << arm.name() << ": " << result.reason;
  ASSERT_FALSE(result.solutions.empty());
  EXPECT_EQ(!result.reason, !result.singular) << result.reason;
  double residual = 0;
  for (const Configuration& q : result.solutions) {
    EXPECT_TRUE(within(internal::bounds_of(arm), q)) << arm.name() << ' ' << q.transpose();
    residual = std::max(residual, largest(task_deviation(task, pose, forward_kinematics(arm, q))));
  }
  EXPECT_LE(residual, tolerance) << arm.name();
  EXPECT_NEAR(residual, result.residual, 1e-12);
}

/// inverse_kinematics() with the nearest configuration.
inline InverseResult explained_inverse(const Arm& arm, const Pose& pose,
                                       const InverseOptions& options = {}) {
  InverseResult result = inverse_kinematics(arm, pose, options);
  explain(result);
  return result;
}

inline void expect_no(const InverseResult& result, InverseStatus status) {
  EXPECT_EQ(result.status, status) << name(result.status) << ": " << result.reason;
  EXPECT_TRUE(result.solutions.empty());
  EXPECT_TRUE(result.reason);
  EXPECT_TRUE(std::isfinite(result.residual));
}

/// The pose with what the task leaves free turned and moved far away: it must not disturb the rest.
inline Pose moved_where_free(Pose pose, const Task& task, Random& random) {
  Twist free = Twist::Zero();
  for (int k = 0; k < 6; ++k) {
    if (!task.rows[k]) free[k] = random.uniform(-1, 1);
  }
  if (task.frame == Frame::tool) return pose * se3_exp(free);
  pose.translation() += free.head<3>();
  pose.linear() = so3_exp(free.tail<3>()) * pose.linear();
  return pose;
}

inline Joint named(Joint joint, const std::string& name, double lower = -Limits::none,
                   double upper = Limits::none) {
  joint.name = name;
  joint.limits.lower = lower;
  joint.limits.upper = upper;
  return joint;
}

}  // namespace beeline::testing
