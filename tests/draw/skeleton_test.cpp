#include <gtest/gtest.h>

#include <beeline/draw/arm_figure.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>
#include <beeline/pose/se2.h>
#include <beeline/pose/se3.h>

#include <tests/random_arm.h>
#include <tests/refusal.h>
#include <tests/typical_arms.h>

namespace beeline {
using namespace internal;
namespace {

using testing::Random;

/// Joint i's axis in the world at q, told apart from the skeleton: a point and a direction.
Twist world_screw(const Arm& arm, const std::vector<Pose>& links, std::size_t i) {
  return adjoint(links[i + 1], arm.joints()[i].screw);
}

double distance_to_axis(const Vector3& p, const Twist& screw) {
  const Vector3 w = screw.tail<3>();
  const double pitch = w.dot(screw.head<3>());
  return (screw.head<3>() + w.cross(p) - pitch * w).norm();  // the velocity that is no travel
}

TEST(Skeleton, RunsThroughTheChaptersJointCentres) {
  Random random;
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<Joint> joints;
    const int n = random.integer(1, 12);
    for (int i = 0; i < n; ++i) {
      const std::string name = "j" + std::to_string(i);
      joints.push_back(planar_link(composite_joint('R', name).front(), random.uniform(0.1, 2)));
    }
    const Arm arm("chain", joints, Pose::Identity(), to_space({1, 2, random.uniform(-3, 3)}, 0.5));
    const Configuration q = random.configuration(arm);
    const std::vector<Pose> links = link_poses(arm, q);
    const Skeleton bones = skeleton(arm, q);
    for (std::size_t i = 0; i < joints.size(); ++i) {  // frame i sits at joint i + 1
      EXPECT_LT((bones.joints[i].centre - links[i].translation()).norm(), 1e-12);
      EXPECT_LT((bones.joints[i].leave - bones.joints[i].enter).norm(), 1e-12);
    }
    EXPECT_LT((bones.tool - forward_kinematics(arm, q).translation()).norm(), 1e-12);
  }
}

TEST(Skeleton, EntersAndLeavesOnTheAxes) {
  Random random;
  for (int trial = 0; trial < 1000; ++trial) {
    const Arm arm = testing::random_arm(random, random.integer(1, 8), 4);
    const Configuration q = random.configuration(arm);
    const std::vector<Pose> links = link_poses(arm, q);
    const Skeleton bones = skeleton(arm, q);
    for (std::size_t i = 0; i < bones.joints.size(); ++i) {
      const SkeletonJoint& joint = bones.joints[i];
      if (joint.kind == JointKind::prismatic) {
        const Vector3 slid = joint.leave - joint.enter;
        EXPECT_LT(slid.cross(joint.direction).norm(), 1e-9);
        continue;
      }
      const Twist screw = world_screw(arm, links, i);
      EXPECT_LT(distance_to_axis(joint.enter, screw), 1e-9);
      EXPECT_LT(distance_to_axis(joint.leave, screw), 1e-9);
      EXPECT_LT(distance_to_axis(joint.centre, screw), 1e-9);
    }
  }
}

TEST(Skeleton, DrawsLinksThatKeepTheirLength) {
  Random random;
  for (const std::string& name : testing::typical_arms) {
    const Arm arm = built_in(name);
    const auto lengths = [&] {
      const Skeleton bones = skeleton(arm, random.configuration(arm));
      std::vector<double> all;
      for (std::size_t i = 0; i + 1 < bones.joints.size(); ++i) {
        all.push_back((bones.joints[i + 1].enter - bones.joints[i].leave).norm());
      }
      all.push_back((bones.tool - bones.joints.back().leave).norm());
      return all;
    };
    const std::vector<double> first = lengths();
    for (int trial = 0; trial < 100; ++trial) {
      const std::vector<double> again = lengths();
      for (std::size_t i = 0; i < first.size(); ++i) EXPECT_NEAR(again[i], first[i], 1e-9) << name;
    }
  }
}

TEST(Skeleton, DoesNotDependOnWhereLinkFramesAre) {
  Random random;
  for (const char* name : {"panda", "iiwa14", "puma560"}) {
    const Arm arm = built_in(name);
    // Axes that are not parallel are met at their common perpendicular, wherever the frames are.
    std::vector<Joint> moved = arm.joints();
    Pose shift = Pose::Identity();
    for (Joint& joint : moved) {
      joint.offset = shift.inverse() * joint.offset;
      const Pose along =
          Pose(Eigen::Translation3d(random.uniform(-0.2, 0.2) * Vector3(joint.screw.tail<3>())));
      const bool parallel = std::string(name) == "puma560";
      shift = parallel ? Pose::Identity() : along;
      joint = with_link_frame(joint, shift);
    }
    const Arm other("other", moved, shift.inverse() * arm.tool());
    for (int trial = 0; trial < 100; ++trial) {
      const Configuration q = random.configuration(arm);
      const std::vector<Vector3> a = skeleton(arm, q).line(), b = skeleton(other, q).line();
      for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT((a[i] - b[i]).norm(), 1e-9) << name;
    }
  }
}

TEST(Skeleton, RefusesAConfigurationThatDoesNotFit) {
  EXPECT_REFUSED(skeleton(built_in("rrr"), Configuration::Zero(2)), "3 joint values");
}

}  // namespace
}  // namespace beeline
