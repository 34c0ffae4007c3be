#pragma once

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>
#include <beeline/planning/move_along.h>
#include <beeline/pose/se2.h>
#include <beeline/pose/se3.h>

#include <tests/degrees.h>
#include <tests/path/random_line.h>
#include <tests/reason.h>
#include <tests/refusal.h>

/// What a motion along lines must keep, checked from outside.
namespace beeline::testing {

using std::numbers::pi;
using testing::deg;

inline Pose planar(double x, double y, double theta) { return to_space({x, y, theta}); }

inline Arm chain(int joints, double limit = Limits::none) {
  std::vector<Joint> links;
  for (int i = 1; i <= joints; ++i) {
    Joint joint = composite_joint('R', "j" + std::to_string(i)).front();
    joint.limits = {.lower = -limit, .upper = limit};
    links.push_back(planar_link(joint, 1));
  }
  return {"chain" + std::to_string(joints), links};
}

/// The motion between sample k and the next at the fraction u of the time: quintic, by the basis
/// polynomials of Hermite interpolation.
inline Configuration motion_between(const Trajectory& motion, std::size_t k, double u) {
  const auto& [names, t, q, v, a] = motion;
  const double h = t[k + 1] - t[k], w = 1 - u;
  const auto value = [](double x) { return x * x * x * (10 + x * (-15 + 6 * x)); };
  const auto slope = [](double x) { return x - x * x * x * (6 + x * (-8 + 3 * x)); };
  const auto bend = [](double x) { return x * x * (0.5 + x * (-1.5 + x * (1.5 - 0.5 * x))); };
  return value(w) * q[k] + value(u) * q[k + 1] + h * (slope(u) * v[k] - slope(w) * v[k + 1]) +
         h * h * (bend(u) * a[k] + bend(w) * a[k + 1]);
}

inline void expect_within_limits(const Arm& arm, const Trajectory& trajectory) {
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    ASSERT_TRUE(limit_violations(arm, trajectory.positions[k], 0).empty()) << "sample " << k;
    if (k == 0) continue;
    constexpr int parts = 20;
    const double dt = (trajectory.times[k] - trajectory.times[k - 1]) / parts;
    Configuration before = trajectory.positions[k - 1];
    for (int part = 1; part <= parts; ++part) {
      const Configuration q = motion_between(trajectory, k - 1, double(part) / parts);
      ASSERT_TRUE(limit_violations(arm, q).empty()) << "after sample " << k - 1;
      for (int i = 0; i < arm.dof(); ++i) {
        const double limit = arm.limits(i).velocity;
        const double most = std::isfinite(limit) ? limit : assumed_velocity_limit;
        ASSERT_LE(std::abs(q[i] - before[i]) / dt, most * (1 + 1e-9) + 1e-15 / dt)
            << "after sample " << k - 1;
        if (kind(arm.joint_of(i)) != JointKind::prismatic) {
          ASSERT_LE(std::abs(q[i] - before[i]), 0.5) << "a jump after sample " << k - 1;
        }
      }
      before = q;
    }
  }
}

/// How far the tool is from the segment and from the orientation there, for lines that move.
inline Deviation off_segment(const Line& line, const Pose& pose) {
  const Vector3 way = line.to.translation() - line.from.translation();
  const Vector3 done = pose.translation() - line.from.translation();
  const double s = std::clamp(done.dot(way) / way.squaredNorm(), 0.0, 1.0);
  const Vector3 whole = so3_log(line.to.linear() * line.from.linear().transpose());
  const Rotation there = so3_exp(s * whole) * line.from.linear();
  return {(done - s * way).norm(), so3_log(pose.linear() * there.transpose()).norm()};
}

/// Everything that a motion must keep, checked from outside and between the samples.
inline void expect_straight(const Arm& arm, const Configuration& start,
                            const std::vector<Pose>& waypoints, const PathMotion& motion,
                            const PathMotionOptions& options = {}, int dense = 20) {
  ASSERT_EQ(motion.status, MotionStatus::reached) << arm.name() << ": " << motion.reason;
  EXPECT_FALSE(motion.reason);
  const Trajectory& trajectory = motion.trajectory;
  ASSERT_NO_THROW(check_trajectory(trajectory));
  ASSERT_LT((trajectory.positions.front() - start).norm(), 1e-8);
  expect_within_limits(arm, trajectory);
  ASSERT_EQ(motion.arrivals.size(), waypoints.size());
  EXPECT_LE(motion.deviation.measured.position, motion.deviation.bound.position + 1e-12);
  EXPECT_LE(motion.deviation.measured.orientation, motion.deviation.bound.orientation + 1e-12);
  EXPECT_LE(motion.deviation.bound.position, options.tolerance);
  EXPECT_LE(motion.deviation.bound.orientation, options.orientation_tolerance);

  Line line{forward_kinematics(arm, start), {}};
  std::size_t k = 0;
  for (std::size_t w = 0; w < waypoints.size(); ++w) {
    line.to = waypoints[w];
    ASSERT_GE(motion.arrivals[w], k);
    const bool moves = (line.to.translation() - line.from.translation()).norm() > 0.01;
    for (; k < motion.arrivals[w]; ++k) {
      for (int i = 0; i < dense && moves; ++i) {
        const Pose pose = forward_kinematics(arm, motion_between(trajectory, k, double(i) / dense));
        const Deviation off = off_segment(line, pose);
        const Deviation& most = i == 0 ? motion.deviation.sampled : motion.deviation.bound;
        ASSERT_LE(off.position, most.position + 1e-12) << "sample " << k << " + " << i;
        ASSERT_LE(off.orientation, most.orientation + 1e-12) << "sample " << k << " + " << i;
      }
    }
    const Pose end = forward_kinematics(arm, trajectory.positions[motion.arrivals[w]]);
    ASSERT_LE((end.translation() - line.to.translation()).norm(), 1e-9);
    ASSERT_LE(so3_log(end.linear() * line.to.linear().transpose()).norm(), 1e-9);
    ASSERT_TRUE(trajectory.velocities[motion.arrivals[w]].isZero(0)) << "at rest at a waypoint";
    line.from = line.to;
  }
  EXPECT_EQ(motion.arrivals.back() + 1, trajectory.size());
}

/// The fraction of the segment at which a motion stops. The reason has it as a percentage.
inline double stopped_at(const PathMotion& motion) {
  const double fraction = motion.path_parameter - std::floor(motion.path_parameter);
  EXPECT_NEAR(testing::field<double>(motion.reason, ReasonField::fraction).value_or(-1), fraction,
              1e-12)
      << motion.reason;
  return fraction;
}

inline void expect_nothing_made(const PathMotion& motion, MotionStatus status) {
  EXPECT_EQ(motion.status, status) << motion.reason;
  EXPECT_TRUE(motion.reason);
  EXPECT_EQ(motion.trajectory.size(), 0);
  EXPECT_TRUE(motion.arrivals.empty());
}

}  // namespace beeline::testing
