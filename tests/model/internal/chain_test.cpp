#include <gtest/gtest.h>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/model/internal/chain.h>
#include <beeline/model/internal/joint_axes.h>

#include <tests/random_arm.h>

namespace beeline {
using namespace internal;
namespace {

Pose through_chain(const Chain& chain, const Configuration& q) {
  Pose pose = chain.base;
  for (const Chain::Link& link : chain.links) {
    pose = pose * link_transform(link, q[link.coordinate]);
  }
  return pose * chain.tool;
}

void expect_same(const Arm& arm, testing::Random& random, double tolerance) {
  const Chain chain = chain_of(arm);
  for (int i = 0; i < 20; ++i) {
    Configuration q(arm.dof());
    for (double& value : q) value = random.uniform(-3, 3);
    const Pose joint_by_joint = link_poses(arm, q).back() * arm.tool();
    for (const Pose& pose : {through_chain(chain, q), forward_kinematics(arm, q)}) {
      EXPECT_LT((pose.matrix() - joint_by_joint.matrix()).norm(), tolerance) << arm.name();
    }
  }
}

TEST(Chain, MovesAsTheArmDoes) {
  testing::Random random;
  for (const std::string& name : built_in_names()) expect_same(built_in(name), random, 1e-13);
  for (int trial = 0; trial < 500; ++trial) {
    expect_same(testing::random_arm(random, random.integer(1, 8), trial % 3), random, 1e-11);
  }
}

TEST(Chain, KeepsItsDigitsAtLargeAngles) {
  testing::Random random;
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    for (int i = 0; i < 50; ++i) {
      Configuration q(arm.dof());
      for (int k = 0; k < q.size(); ++k) {
        const bool slides = kind(arm.joint_of(k)) == JointKind::prismatic;
        q[k] = slides ? 0.5 : random.uniform(-1e6, 1e6);
      }
      const Pose joint_by_joint = link_poses(arm, q).back() * arm.tool();
      EXPECT_LT((forward_kinematics(arm, q).matrix() - joint_by_joint.matrix()).norm(), 1e-13)
          << name;
    }
  }
}

TEST(Chain, IsTheSameMotionWithOtherFramesOnTheAxes) {
  testing::Random random;
  for (int trial = 0; trial < 200; ++trial) {
    const Arm arm = testing::random_arm(random, random.integer(1, 8), trial % 3);
    const Chain chain = chain_of(arm);
    std::vector<JointAxis> axes = axes_of(chain);
    for (JointAxis& axis : axes) {
      axis.point += random.uniform(-2, 2) * axis.direction;
      if (random.integer(0, 1) == 1) axis.direction = -axis.direction;
    }
    const Chain other = chain_through(chain, axes);
    Configuration q(arm.dof());
    for (double& value : q) value = random.uniform(-3, 3);
    EXPECT_LT((through_chain(chain, q).matrix() - through_chain(other, q).matrix()).norm(), 1e-11);
  }
}

TEST(Chain, IsExactForNearlyParallelAxes) {
  testing::Random random;
  for (double tilt = 1e-16; tilt < 1e-2; tilt *= 10) {
    std::vector<Joint> joints;
    for (int i = 0; i < 6; ++i) {
      Joint joint;
      joint.name = "j" + std::to_string(i);
      joint.offset =
          Pose(Eigen::Translation3d(0.5, 0.1, 0)) * Eigen::AngleAxisd(tilt, random.direction());
      joint.screw = rotation_screw(Vector3::UnitZ());
      joints.push_back(joint);
    }
    expect_same(Arm("nearly parallel", joints), random, 1e-13);
  }
}

}  // namespace
}  // namespace beeline
