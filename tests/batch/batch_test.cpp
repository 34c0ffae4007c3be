#include <array>
#include <gtest/gtest.h>
#include <limits>

#include <beeline/batch/batch.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/model/catalog.h>
#include <beeline/model/internal/chain.h>
#include <beeline/pose/se3.h>

#include <tests/random_arm.h>
#include <tests/refusal.h>
#include <tests/typical_arms.h>

namespace beeline {
namespace {

using Eigen::MatrixXd;
using Eigen::MatrixXf;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Offsets and tools whose right angles have the rounding of decimal text.
Arm nearly_square(double off) {
  std::vector<Joint> joints;
  for (int i = 0; i < 5; ++i) {
    Joint joint;
    joint.name = "joint" + std::to_string(i);
    joint.screw = rotation_screw(Vector3::UnitZ());
    const double angle = std::array{1.5707963267948966, -1.5707963267948966, 0.0}[i % 3] + off;
    joint.offset = Pose(Eigen::Translation3d(0.3, 0.1, 0.2)) *
                   Eigen::AngleAxisd(angle, Vector3::UnitX()) *
                   Eigen::AngleAxisd(off, Vector3::UnitZ());
    joints.push_back(joint);
  }
  return {"square", joints, Pose(Eigen::AngleAxisd(off, Vector3(1, 1, 1).normalized()))};
}

/// Built-in arms, and random arms from one joint to more joints than a register has lanes.
std::vector<Arm> arms(testing::Random& random) {
  std::vector<Arm> all;
  for (const std::string& name : testing::typical_arms) all.push_back(built_in(name));
  for (const int joints : {1, 2, 3, 4, 6, 7, 8, 9, 17}) {
    for (const int mimics : {0, 3}) all.push_back(testing::random_arm(random, joints, mimics));
  }
  for (double off = 1e-16; off < 1e-3; off *= 10) all.push_back(nearly_square(off));
  return all;
}

MatrixXd configurations(testing::Random& random, const Arm& arm, Eigen::Index count) {
  MatrixXd q(arm.dof(), count);
  for (Eigen::Index i = 0; i < count; ++i) q.col(i) = random.configuration(arm);
  return q;
}

double size_of(const Arm& arm, const Eigen::VectorXd& q) {
  double size = 1;
  for (const Pose& pose : link_poses(arm, q)) size = std::max(size, pose.translation().norm());
  return size + arm.tool().translation().norm();
}

/// A pose in the layout of the batch.
Eigen::VectorXd numbers(const Pose& pose, PoseLayout layout) {
  if (layout == PoseLayout::matrix) return pose.matrix().reshaped();
  const Quaternion r = quaternion(pose.linear());
  Eigen::VectorXd seven(7);
  seven << pose.translation(), r.qw, r.qx, r.qy, r.qz;
  return seven;
}

/// The quaternion may be the opposite where qw is nearly zero.
void expect_pose(const Eigen::VectorXd& pose, Pose expected, PoseLayout layout, double tolerance) {
  Eigen::VectorXd wanted = numbers(expected, layout);
  if (layout == PoseLayout::position_quaternion) {
    EXPECT_GE(pose[3], -1e-12);
    if (pose.tail<4>().dot(wanted.tail<4>()) < 0) wanted.tail<4>() *= -1;
  }
  ASSERT_LE((pose - wanted).cwiseAbs().maxCoeff(), tolerance) << pose << "\n\n" << wanted;
}

Pose tool_pose(const Arm& arm, const Eigen::VectorXd& q) {
  return link_poses(arm, q).back() * arm.tool();
}

TEST(Batch, ForwardIsTheSingleCall) {
  testing::Random random;
  for (const Arm& arm : arms(random)) {
    for (const Eigen::Index count : {0, 1, 7, 8, 9, 15, 16, 17, 1000}) {
      const MatrixXd q = configurations(random, arm, count);
      for (const PoseLayout layout : {PoseLayout::matrix, PoseLayout::position_quaternion}) {
        MatrixXd poses = MatrixXd::Constant(size(layout), count, nan);
        batch_forward<double>(arm, q, poses, {.layout = layout, .threads = 1});
        for (Eigen::Index i = 0; i < count; ++i) {
          expect_pose(poses.col(i), forward_kinematics(arm, q.col(i)), layout,
                      1e-13 * size_of(arm, q.col(i)));
        }
      }
    }
  }
}

TEST(Batch, LinkPosesAreTheSingleCalls) {
  testing::Random random;
  for (const Arm& arm : arms(random)) {
    const MatrixXd q = configurations(random, arm, 37);
    const auto links = static_cast<Eigen::Index>(arm.joints().size()) + 1;
    for (const PoseLayout layout : {PoseLayout::matrix, PoseLayout::position_quaternion}) {
      const int one = size(layout);
      MatrixXd poses(links * one, q.cols());
      batch_link_poses<double>(arm, q, poses, {.layout = layout});
      for (Eigen::Index i = 0; i < q.cols(); ++i) {
        const std::vector<Pose> expected = link_poses(arm, q.col(i));
        for (Eigen::Index link = 0; link < links; ++link) {
          expect_pose(poses.col(i).segment(link * one, one), expected[link], layout,
                      1e-13 * size_of(arm, q.col(i)));
        }
      }
    }
  }
}

TEST(Batch, JacobiansAreTheSingleCalls) {
  testing::Random random;
  for (const Arm& arm : arms(random)) {
    const MatrixXd q = configurations(random, arm, 41);
    for (const Frame frame : {Frame::base, Frame::tool, Frame::space}) {
      MatrixXd jacobians(6 * arm.dof(), q.cols()), poses(16, q.cols()), none(16, 0), same;
      batch_jacobian<double>(arm, q, jacobians, poses, {.frame = frame});
      same.resizeLike(jacobians);
      batch_jacobian<double>(arm, q, same, none, {.frame = frame});
      EXPECT_EQ(jacobians, same);
      for (Eigen::Index i = 0; i < q.cols(); ++i) {
        const Jacobian expected = jacobian(arm, q.col(i), frame);
        const double tolerance = 2e-13 * size_of(arm, q.col(i));
        ASSERT_LE((jacobians.col(i) - expected.reshaped()).cwiseAbs().maxCoeff(), tolerance)
            << arm.name() << ' ' << name(frame);
        expect_pose(poses.col(i), forward_kinematics(arm, q.col(i)), PoseLayout::matrix, tolerance);
      }
    }
  }
}

TEST(Batch, ManipulabilityIsTheSingleCalls) {
  testing::Random random;
  for (const Arm& arm : arms(random)) {
    MatrixXd q = configurations(random, arm, 100);
    q.col(3).setZero();  // many arms are singular there
    MatrixXd values(1, q.cols());
    batch_manipulability<double>(arm, q, values);
    for (Eigen::Index i = 0; i < q.cols(); ++i) {
      const MatrixXd rows = task_jacobian(arm, q.col(i));
      ASSERT_NEAR(values(0, i), manipulability_measures(rows).manipulability,
                  1e-13 * std::max(1.0, std::pow(rows.norm(), 6)))
          << arm.name();
    }
  }
}

TEST(Batch, TakesAnglesOfAnySize) {
  testing::Random random;
  for (const double angle : {1e3, 1e6, 1e9, 1e15}) {
    for (const char* arm_name : {"panda", "ur5", "puma560"}) {
      const Arm arm = built_in(arm_name);
      MatrixXd q(arm.dof(), 64), poses(16, 64);
      for (double& value : q.reshaped()) value = random.uniform(-angle, angle);
      batch_forward<double>(arm, q, poses);
      for (Eigen::Index i = 0; i < q.cols(); ++i) {
        expect_pose(poses.col(i), tool_pose(arm, q.col(i)), PoseLayout::matrix, 1e-13);
      }
    }
  }
}

TEST(Batch, FloatIsNearlyTheSame) {
  testing::Random random;
  for (const Arm& arm : arms(random)) {
    for (const double angle : {1.0, 1e3, 1e5}) {
      MatrixXf q = configurations(random, arm, 53).cast<float>();
      for (int k = 0; k < arm.dof(); ++k) {
        if (kind(arm.joint_of(k)) == JointKind::revolute) q.row(k) *= static_cast<float>(angle);
      }
      // The ratio of a mimic joint adds its own rounding.
      if (angle > 1 && !internal::chain_angles_of(arm).in_order) continue;
      MatrixXf poses(16, q.cols()), jacobians(6 * arm.dof(), q.cols());
      batch_jacobian<float>(arm, q, jacobians, poses);
      for (Eigen::Index i = 0; i < q.cols(); ++i) {
        const Eigen::VectorXd one = q.col(i).cast<double>();
        const double tolerance = 1e-5 * size_of(arm, one);
        expect_pose(poses.col(i).cast<double>(), tool_pose(arm, one), PoseLayout::matrix,
                    tolerance);
        const Jacobian expected = jacobian(arm, one);
        ASSERT_LE((jacobians.col(i).cast<double>() - expected.reshaped()).cwiseAbs().maxCoeff(),
                  tolerance);
      }
    }
  }
}

TEST(Batch, NonFiniteValuesAffectOnlyTheirColumn) {
  testing::Random random;
  for (const Arm& arm : arms(random)) {
    MatrixXd q = configurations(random, arm, 40);
    MatrixXd jacobians(6 * arm.dof(), 40), poses(16, 40), values(1, 40);
    batch_jacobian<double>(arm, q, jacobians, poses);
    batch_manipulability<double>(arm, q, values);
    q(random.integer(0, arm.dof() - 1), 5) = nan;
    q(random.integer(0, arm.dof() - 1), 38) = std::numeric_limits<double>::infinity();
    MatrixXd spoilt = jacobians, spoilt_poses = poses, spoilt_values = values;
    batch_jacobian<double>(arm, q, spoilt, spoilt_poses);
    batch_manipulability<double>(arm, q, spoilt_values);
    for (Eigen::Index i = 0; i < 40; ++i) {
      if (i == 5 || i == 38) {
        EXPECT_TRUE(spoilt.col(i).array().isNaN().all());
        EXPECT_TRUE(spoilt_poses.col(i).array().isNaN().all());
        EXPECT_TRUE(std::isnan(spoilt_values(0, i)));
      } else {
        EXPECT_EQ(spoilt.col(i), jacobians.col(i));
        EXPECT_EQ(spoilt_poses.col(i), poses.col(i));
        EXPECT_EQ(spoilt_values(0, i), values(0, i));
      }
    }
  }
}

TEST(Batch, IsTheSameForAnyNumberOfThreadsAndAnywhereInTheBatch) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Eigen::Index count = 30011;  // the results exceed the caches
  MatrixXd q = configurations(random, arm, count);
  q(2, 17) = 1e7;
  MatrixXd jacobians(42, count), poses(16, count);
  batch_jacobian<double>(arm, q, jacobians, poses, {.threads = 1});
  for (const int threads : {2, 3, 0}) {
    MatrixXd others(42, count), other_poses(16, count);
    batch_jacobian<double>(arm, q, others, other_poses, {.threads = threads});
    EXPECT_EQ(jacobians, others);
    EXPECT_EQ(poses, other_poses);
  }
  for (const Eigen::Index first : {1, 5, 300}) {
    MatrixXd others(42, 29), other_poses(16, 29);
    batch_jacobian<double>(arm, q.middleCols(first, 29), others, other_poses);
    EXPECT_EQ(jacobians.middleCols(first, 29), others);
    EXPECT_EQ(poses.middleCols(first, 29), other_poses);
  }
}

TEST(Batch, TakesColumnsOfLargerMatrices) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  MatrixXd q = MatrixXd::Zero(10, 100), wide = MatrixXd::Constant(20, 100, 7), poses(16, 100);
  q.topRows(6) = configurations(random, arm, 100);
  batch_forward<double>(arm, q.topRows(6), poses);
  batch_forward<double>(arm, q.topRows(6), wide.middleRows(2, 16));
  EXPECT_EQ(wide.middleRows(2, 16), poses);
  EXPECT_TRUE((wide.topRows(2).array() == 7).all() && (wide.bottomRows(2).array() == 7).all());
}

TEST(Batch, RefusesSizesThatDoNotFit) {
  const Arm arm = built_in("ur5");
  MatrixXd q(6, 4), five(5, 4), poses(16, 4), seven(7, 4), three(16, 3), jacobians(36, 4);
  MatrixXd none(16, 0), values(2, 4);
  EXPECT_THROW(batch_forward<double>(arm, five, poses), Error);
  EXPECT_THROW(batch_forward<double>(arm, q, seven), Error);
  EXPECT_THROW(batch_forward<double>(arm, q, three), Error);
  EXPECT_THROW(batch_link_poses<double>(arm, q, poses), Error);
  EXPECT_THROW(batch_jacobian<double>(arm, q, poses, none), Error);
  EXPECT_THROW(batch_jacobian<double>(arm, q, jacobians, three), Error);
  EXPECT_THROW(batch_manipulability<double>(arm, q, values), Error);
  EXPECT_THROW(batch_inverse(arm, poses, q.leftCols(3), q), Error);
  EXPECT_THROW(batch_inverse(arm, seven, q, q), Error);
}

}  // namespace
}  // namespace beeline
