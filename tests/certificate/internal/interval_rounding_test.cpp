#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/certificate/internal/interval_deviation.h>
#include <beeline/kinematics/forward.h>

#include <tests/random.h>
#include <tests/random_arm.h>

namespace beeline::internal {
namespace {

using Real = long double;  // more digits than double, where the platform has them
using Matrix4 = Eigen::Matrix<Real, 4, 4>;
using Matrix3 = Eigen::Matrix<Real, 3, 3>;
using Vector3L = Eigen::Matrix<Real, 3, 1>;

/// exp(screw q) by Rodrigues' formula (LP 3.88).
Matrix4 exponential(const Twist& screw, Real q) {
  const Vector3L v = screw.head<3>().cast<Real>(), w = screw.tail<3>().cast<Real>();
  Matrix3 hat;
  hat << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  const Real sine = std::sin(q), versine = 2 * std::sin(q / 2) * std::sin(q / 2);
  const Matrix3 unit = Matrix3::Identity(), square = hat * hat;
  Matrix4 motion = Matrix4::Identity();
  motion.topLeftCorner<3, 3>() = unit + sine * hat + versine * square;
  motion.topRightCorner<3, 1>() = (q * unit + versine * hat + (q - sine) * square) * v;
  return motion;
}

/// world_T_tool, straight from the description of the arm.
Matrix4 tool_pose(const Arm& arm, const Configuration& q) {
  Matrix4 pose = arm.base().matrix().cast<Real>();
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    const Joint& joint = arm.joints()[i];
    const Arm::JointCoupling& coupling = arm.couplings()[i];
    pose = pose * joint.offset.matrix().cast<Real>() *
           exponential(joint.screw, coupling.ratio * static_cast<Real>(q[coupling.coordinate]) +
                                        static_cast<Real>(coupling.shift));
  }
  return pose * arm.tool().matrix().cast<Real>();
}

/// The same arm with all lengths times `scale`, its base moved by `offset`.
Arm scaled(const Arm& arm, double scale, const Vector3& offset) {
  std::vector<Joint> joints = arm.joints();
  for (Joint& joint : joints) {
    joint.offset.translation() *= scale;
    if (kind(joint) != JointKind::prismatic) joint.screw.head<3>() *= scale;
  }
  Pose base = arm.base(), tool = arm.tool();
  base.translation() = scale * base.translation() + offset;
  tool.translation() *= scale;
  return {"scaled", joints, base, tool};
}

/// The same arm, its base moved by `away` and its first joint back.
Arm with_lengths_that_cancel(const Arm& arm, const Vector3& away) {
  std::vector<Joint> joints = arm.joints();
  Pose base = arm.base();
  base.translation() += away;
  joints.front().offset.translation() -= base.linear().transpose() * away;
  return {"far", joints, base, arm.tool()};
}

struct Case {
  Arm arm;
  Configuration q;
};

/// An arm of any size, near the world's origin or far from it.
Case random_case(testing::Random& random) {
  const double scale = std::pow(10, random.uniform(-6, 2));
  const Vector3 offset = random.integer(0, 2) == 0 ? random.vector(1e5) : random.vector(scale);
  Arm arm = scaled(testing::random_arm(random, random.integer(1, 7), random.integer(0, 3)), scale,
                   offset);
  if (random.integer(0, 2) == 0) arm = with_lengths_that_cancel(arm, random.vector(1e4));
  Case made{arm, {}};
  made.q = random.configuration(made.arm);
  if (random.integer(0, 3) == 0) made.q *= 100;  // many revolutions
  return made;
}

/// The deviation of the exact pose of the tool from a pose.
Deviation exact_deviation(const Arm& arm, const Configuration& q, const Pose& pose) {
  const Matrix4 difference = tool_pose(arm, q) - pose.matrix().cast<Real>();
  const auto chord = static_cast<double>(difference.topLeftCorner<3, 3>().norm());
  return {static_cast<double>(difference.topRightCorner<3, 1>().norm()),
          2 * std::asin(std::min(1.0, chord / std::sqrt(8.0)))};
}

// At rest the deviation is the rounding error of the kinematics, and the bound is little more.
TEST(IntervalRounding, BoundsTheDeviationInMoreDigits) {
  testing::Random random;
  int below = 0;
  double largest = 0;
  const int count = testing::cases(3000);
  for (int i = 0; i < count; ++i) {
    const auto [arm, q] = random_case(random);
    Interval interval;
    for (const double value : q) interval.coordinates.emplace_back().c[0] = value;
    const Pose pose = forward_kinematics(arm, q);
    const IntervalDeviation proved =
        interval_deviation(arm, SplineSegment{.centre = pose}, Task::spatial(), interval);
    const Deviation exact = exact_deviation(arm, q, pose);
    ASSERT_LE(exact.position, proved.bound.position) << q.transpose();
    ASSERT_LE(exact.orientation, proved.bound.orientation) << q.transpose();
    below += exact.position > proved.measured.position ? 1 : 0;
    largest = std::max(largest, exact.position / proved.bound.position);
  }
  EXPECT_GT(below, count / 4) << "doubles measure less than the deviation";
  EXPECT_GT(largest, 0.02) << "the bound is far above every rounding error";
}

TEST(IntervalRounding, BoundsTheDeviationOfMotionsInMoreDigits) {
  testing::Random random;
  for (int i = 0; i < testing::cases(3000); ++i) {
    const auto [arm, q] = random_case(random);
    const double size = std::pow(10, random.uniform(-17, -1));
    Interval interval;
    for (const double value : q) {
      Polynomial& p = interval.coordinates.emplace_back();
      p.c[0] = value;
      for (std::size_t k = 1; k < Polynomial::terms; ++k) p.c[k] = random.uniform(-size, size);
    }
    const Pose pose = forward_kinematics(arm, q);
    const Deviation bound =
        interval_deviation(arm, SplineSegment{.centre = pose}, Task::spatial(), interval).bound;
    for (int n = 0; n <= 4; ++n) {
      Configuration then = q;
      for (Eigen::Index k = 0; k < q.size(); ++k) {
        then[k] = interval.coordinates[static_cast<std::size_t>(k)](n / 4.0);
      }
      const Deviation exact = exact_deviation(arm, then, pose);
      ASSERT_LE(exact.position, bound.position) << "motion of " << size;
      ASSERT_LE(exact.orientation, bound.orientation) << "motion of " << size;
    }
  }
}

}  // namespace
}  // namespace beeline::internal
