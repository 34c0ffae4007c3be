#include <Eigen/LU>
#include <gtest/gtest.h>

#include <beeline/inverse/internal/redundancy.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se3.h>

#include <tests/inverse/answer.h>
#include <tests/inverse/internal/relative_margin.h>
#include <tests/random.h>

namespace beeline {
namespace {

using namespace internal;

using testing::expect_solved;
using testing::relative_margin;

/// Joints about random axes, within 2 rad, 2 m in all.
Arm chain_of_joints(int joints, testing::Random& random) {
  std::vector<Joint> chain;
  for (int i = 0; i < joints; ++i) {
    Joint joint = testing::named({}, "joint" + std::to_string(i + 1), -2, 2);
    joint.screw = rotation_screw(random.direction());
    joint.offset = make_pose({0, 0, 2.0 / joints});
    chain.push_back(joint);
  }
  return {"chain", chain, make_pose({0, 0, 2.0 / joints})};
}

/// At the optimum the gradient is normal to the self-motion of the joints that are not at a limit.
TEST(Redundancy, NearestIsStationaryOnTheSelfMotion) {
  testing::Random random;
  int redundant = 0;
  for (const char* name : {"panda", "iiwa14"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < 50; ++i) {
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      const Configuration seed = random.configuration(arm);
      InverseOptions options{.seed = seed, .method = InverseMethod::numerical};
      const InverseResult any = inverse_kinematics(arm, pose, options);
      options.redundancy = Redundancy::nearest;
      const InverseResult nearest = inverse_kinematics(arm, pose, options);
      expect_solved(arm, pose, Task::spatial(), nearest);
      const Configuration q = nearest.solutions[0], away = q - seed;
      EXPECT_LE(away.norm(), (any.solutions[0] - seed).norm() + 1e-9);
      const Bounds bounds = bounds_of(arm);
      std::vector<Eigen::Index> free;
      for (Eigen::Index k = 0; k < q.size(); ++k) {
        if (q[k] > bounds.lower[k] + 1e-9 && q[k] < bounds.upper[k] - 1e-9) free.push_back(k);
      }
      const Eigen::MatrixXd jacobian =
          task_jacobian(arm, q, Task::spatial())(Eigen::seqN(0, 6), free);
      const Eigen::FullPivLU<Eigen::MatrixXd> factor(jacobian);
      if (factor.dimensionOfKernel() == 0) continue;  // the joints at limits leave no self-motion
      ++redundant;
      const Eigen::MatrixXd basis = factor.kernel().colwise().normalized();
      EXPECT_LE((basis.transpose() * away(free)).norm(), 1e-5) << name;
    }
  }
  EXPECT_GE(redundant, 50);
}

TEST(Redundancy, AgreesWithTheClosedFormNearASolution) {
  testing::Random random;
  int compared = 0;
  for (const char* name : {"panda", "iiwa14"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < 50; ++i) {
      const Configuration q = 0.7 * random.configuration(arm);
      if (!within(bounds_of(arm), q)) continue;
      const Configuration seed = (q + 0.05 * random.configuration(arm))
                                     .cwiseMax(bounds_of(arm).lower)
                                     .cwiseMin(bounds_of(arm).upper);
      const Pose pose = forward_kinematics(arm, q);
      InverseOptions options{.seed = seed, .redundancy = Redundancy::nearest};
      const InverseResult closed = inverse_kinematics(arm, pose, options);
      options.method = InverseMethod::numerical;
      const InverseResult numerical = inverse_kinematics(arm, pose, options);
      expect_solved(arm, pose, Task::spatial(), closed);
      expect_solved(arm, pose, Task::spatial(), numerical);
      EXPECT_NEAR((closed.solutions[0] - seed).norm(), (numerical.solutions[0] - seed).norm(), 1e-6)
          << name << ' ' << q.transpose();
      ++compared;
    }
  }
  EXPECT_GE(compared, 80);
}

TEST(Redundancy, CentredLeavesMoreOfTheRangesOnLongChains) {
  testing::Random random;
  for (const int joints : {7, 8, 10, 30}) {
    double before = 0, after = 0;
    for (int i = 0; i < 10; ++i) {
      const Arm arm = chain_of_joints(joints, random);
      const Pose pose = forward_kinematics(arm, 0.9 * random.configuration(arm));
      InverseOptions options{.seed = random.configuration(arm)};
      const InverseResult any = inverse_kinematics(arm, pose, options);
      options.redundancy = Redundancy::centred;
      const InverseResult centred = inverse_kinematics(arm, pose, options);
      expect_solved(arm, pose, Task::spatial(), centred);
      before += relative_margin(arm, any.solutions[0]);
      after += relative_margin(arm, centred.solutions[0]);
    }
    EXPECT_GT(after, 1.2 * before) << joints;
  }
}

}  // namespace
}  // namespace beeline
