#include <bit>
#include <gtest/gtest.h>

#include <beeline/error.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/inverse/numerical/levenberg_marquardt_lanes.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se3.h>

#include <hwy/targets.h>

#include <tests/inverse/answer.h>
#include <tests/inverse/numerical/lane_starts.h>
#include <tests/random_arm.h>
#include <tests/typical_arms.h>

namespace beeline {
namespace {

using namespace internal;

using testing::found;
using testing::largest;
using testing::starts_near;

/// Built-in arms, and others with joints of all kinds, some of which follow others.
std::vector<Arm> arms(testing::Random& random) {
  std::vector<Arm> all;
  for (const std::string& name : testing::typical_arms) all.push_back(built_in(name));
  for (int joints = 1; joints <= 12; ++joints) {
    all.push_back(testing::random_arm(random, joints, joints % 2 == 0 ? 3 : 0));
  }
  return all;
}

TEST(DescentLanes, WhatArrivesIsThereByTheForwardKinematics) {
  testing::Random random;
  for (const Arm& arm : arms(random)) {
    const NumericalProblem problem = numerical_problem(arm, Task::spatial(), bounds_of(arm));
    LevenbergMarquardtLanes lanes;
    int arrived = 0;
    for (int i = 0; i < 50; ++i) {
      const Configuration q = random.configuration(arm);
      const Pose pose = forward_kinematics(arm, q);
      levenberg_marquardt_lanes(problem, pose, starts_near(q, 0.02, random), {.tolerance = 1e-8},
                                lanes);
      for (int lane = 0; lane < solver_lane_count; ++lane) {
        const Configuration at = found(problem, lanes, lane);
        EXPECT_TRUE(within(problem.bounds, at)) << arm.name() << ' ' << at.transpose();
        const Deviation seen = task_deviation(Task::spatial(), pose, forward_kinematics(arm, at));
        const Deviation said = lane_deviation(problem, lanes, lane);
        EXPECT_NEAR(seen.position, said.position, 1e-13 * problem.length * 100);
        EXPECT_NEAR(seen.orientation, said.orientation, 1e-13 * 100);
        if ((lanes.converged >> lane & 1) == 0) continue;
        ++arrived;
        EXPECT_LE(largest(seen), 1e-8) << arm.name();
      }
    }
    EXPECT_GE(arrived, 390) << arm.name() << " of " << arm.dof();
  }
}

TEST(DescentLanes, ComesToRoundingLevelAndToWhereDescendComes) {
  testing::Random random;
  for (const std::string& name : testing::typical_arms) {
    const Arm arm = built_in(name);
    const NumericalProblem problem = numerical_problem(arm, default_task(arm), bounds_of(arm));
    LevenbergMarquardtLanes lanes;
    int same = 0, both = 0;
    for (int i = 0; i < 100; ++i) {
      const Configuration q = random.configuration(arm);
      const Pose pose = forward_kinematics(arm, q);
      const Eigen::MatrixXd starts = starts_near(q, 0.02, random);
      levenberg_marquardt_lanes(problem, pose, starts, {.tolerance = 1e-9}, lanes);
      for (int lane = 0; lane < solver_lane_count; ++lane) {
        const NumericalResult one =
            levenberg_marquardt(arm, pose, problem.task, problem.bounds, starts.col(lane));
        if (!one.converged || (lanes.converged >> lane & 1) == 0) continue;
        EXPECT_LT(largest(lane_deviation(problem, lanes, lane)), 1e-11) << name;
        ++both;
        // If there are more joints than rows, or the arm is singular, the iterates differ slightly.
        same += same_posture(arm, found(problem, lanes, lane), one.q, 0.02);
      }
    }
    EXPECT_GE(both, 780) << name;
    EXPECT_GE(same, both - both / 50) << name;
  }
}

TEST(DescentLanes, NoLaneDependsOnTheOthersNorOnItsPlace) {
  testing::Random random;
  for (const char* name : {"puma560", "ur5", "panda", "stanford", "scara"}) {
    const Arm arm = built_in(name);
    const NumericalProblem problem = numerical_problem(arm, Task::spatial(), bounds_of(arm));
    LevenbergMarquardtLanes together, alone;
    for (int i = 0; i < 20; ++i) {
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      Eigen::MatrixXd starts(arm.dof(), solver_lane_count);
      for (int lane = 0; lane < solver_lane_count; ++lane) {
        starts.col(lane) = random.configuration(arm);
      }
      starts(0, 3) = 1e7;  // brought within the bounds
      levenberg_marquardt_lanes(problem, pose, starts, {}, together);
      for (int lane = 0; lane < solver_lane_count; ++lane) {
        levenberg_marquardt_lanes(problem, pose, starts.col(lane), {}, alone);
        EXPECT_EQ(found(problem, together, lane), found(problem, alone, 0)) << name;
        EXPECT_EQ(together.iterations.lane[lane], alone.iterations.lane[0]);
        EXPECT_EQ(together.converged >> lane & 1, alone.converged & 1);
      }
    }
  }
}

TEST(DescentLanes, NeverLeavesTheBoundsNorTheFinite) {
  testing::Random random;
  for (const Arm& arm : arms(random)) {
    const NumericalProblem problem = numerical_problem(arm, Task::spatial(), bounds_of(arm));
    LevenbergMarquardtLanes lanes;
    for (int i = 0; i < 30; ++i) {
      const double far = std::pow(10.0, random.uniform(-3, 8));
      const Pose pose = random.pose(far);
      const Configuration q = random.configuration(arm);
      levenberg_marquardt_lanes(problem, pose, starts_near(q, far, random), {}, lanes);
      for (int lane = 0; lane < solver_lane_count; ++lane) {
        const Configuration at = found(problem, lanes, lane);
        EXPECT_TRUE(within(problem.bounds, at)) << arm.name() << ' ' << at.transpose();
        EXPECT_TRUE(at.allFinite());
        EXPECT_TRUE(std::isfinite(largest(lane_deviation(problem, lanes, lane)))) << arm.name();
      }
    }
  }
}

TEST(DescentLanes, FindsTheEdgeOfABox) {
  // The point of a box that is nearest to one outside is known: coordinate by coordinate.
  std::vector<Joint> joints(3);
  for (int k = 0; k < 3; ++k) {
    Joint& joint = joints[k];
    joint.name = std::string(1, "xyz"[k]);
    joint.screw = translation_screw(Vector3::Unit(k));
    joint.limits.lower = -1;
    joint.limits.upper = 1;
  }
  const Arm arm("box", joints);
  const NumericalProblem problem = numerical_problem(arm, Task::position(), bounds_of(arm));
  testing::Random random;
  LevenbergMarquardtLanes lanes;
  for (int i = 0; i < 200; ++i) {
    const Vector3 p = random.vector(3);
    const Configuration q = random.configuration(arm);
    levenberg_marquardt_lanes(problem, make_pose(p), starts_near(q, 1, random), {}, lanes);
    for (int lane = 0; lane < solver_lane_count; ++lane) {
      EXPECT_LT((found(problem, lanes, lane) - p.cwiseMax(-1).cwiseMin(1)).norm(), 1e-6);
    }
  }
}

TEST(DescentLanes, WorksFrom1To100Joints) {
  testing::Random random;
  int arrived = 0, all = 0;
  for (const int dof : {1, 2, 6, 30, 100}) {
    for (const double size : {1e-3, 1.0, 1e3}) {
      std::vector<Joint> joints;
      for (int i = 0; i < dof; ++i) {
        Joint joint;
        joint.name = "joint" + std::to_string(i);
        joint.offset = random.pose(size / dof);
        joint.screw = rotation_screw(random.direction(), random.vector(size / dof / 4));
        joints.push_back(joint);
      }
      const Arm arm("chain", joints);
      const NumericalProblem problem = numerical_problem(arm, Task::spatial(), bounds_of(arm));
      const Configuration q = random.configuration(arm);
      LevenbergMarquardtLanes lanes;
      levenberg_marquardt_lanes(problem, forward_kinematics(arm, q), starts_near(q, 0.05, random),
                                {.tolerance = 1e-9 * std::max(1.0, size)}, lanes);
      all += solver_lane_count;
      arrived += std::popcount(lanes.converged);
      // Six joints may have a local minimum nearby; with many joints it is avoided.
      if (dof >= 30) {
        EXPECT_EQ(lanes.converged, 255u) << dof << " joints of " << size;
      }
    }
  }
  EXPECT_GE(arrived, all * 0.95);
}

TEST(DescentLanes, EveryMachineArrivesAlike) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const NumericalProblem problem = numerical_problem(arm, Task::spatial(), bounds_of(arm));
  for (int i = 0; i < 20; ++i) {
    const Configuration q = random.configuration(arm);
    const Pose pose = forward_kinematics(arm, q);
    const Eigen::MatrixXd starts = starts_near(q, 0.02, random);
    LevenbergMarquardtLanes first;
    levenberg_marquardt_lanes(problem, pose, starts, {}, first);
    for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      LevenbergMarquardtLanes lanes;
      levenberg_marquardt_lanes(problem, pose, starts, {}, lanes);
      hwy::SetSupportedTargetsForTest(0);
      EXPECT_EQ(lanes.converged, first.converged) << hwy::TargetName(target);
      for (int lane = 0; lane < solver_lane_count; ++lane) {
        if ((first.converged >> lane & 1) == 0) continue;
        EXPECT_LT((found(problem, lanes, lane) - found(problem, first, lane)).norm(), 1e-6)
            << hwy::TargetName(target);
      }
    }
  }
}

TEST(DescentLanes, StretchedArmIsReachedThoughItIsSingular) {
  const Arm arm = built_in("rrr");
  const NumericalProblem problem = numerical_problem(arm, Task::planar(), bounds_of(arm));
  LevenbergMarquardtLanes lanes;
  levenberg_marquardt_lanes(problem, forward_kinematics(arm, Configuration::Zero(3)),
                            Eigen::Vector3d(0.5, -0.8, 0.4), {}, lanes);
  EXPECT_EQ(lanes.converged, 1u);
}

TEST(DescentLanes, RefusesWhatDoesNotFit) {
  const Arm arm = built_in("puma560");
  const Bounds bounds = bounds_of(arm);
  EXPECT_THROW(numerical_problem(arm, Task{.rows = {}}, bounds), Error);
  EXPECT_THROW(numerical_problem(arm, Task{.frame = Frame::space}, bounds), Error);
  EXPECT_THROW(numerical_problem(arm, Task::spatial(), bounds_of(built_in("panda"))), Error);
  EXPECT_THROW(numerical_problem(arm, Task::spatial(), {bounds.upper, bounds.lower}), Error);
  const NumericalProblem problem = numerical_problem(arm, Task::spatial(), bounds);
  LevenbergMarquardtLanes lanes;
  const Pose pose = Pose::Identity();
  const Eigen::MatrixXd start = Eigen::MatrixXd::Zero(6, 1);
  EXPECT_THROW(levenberg_marquardt_lanes(problem, pose, Eigen::MatrixXd::Zero(7, 1), {}, lanes),
               Error);
  EXPECT_THROW(levenberg_marquardt_lanes(problem, pose, Eigen::MatrixXd::Zero(6, 9), {}, lanes),
               Error);
  EXPECT_THROW(levenberg_marquardt_lanes(problem, pose, start * NAN, {}, lanes), Error);
  EXPECT_THROW(levenberg_marquardt_lanes(problem, pose, start, {.tolerance = 0}, lanes), Error);
  EXPECT_THROW(levenberg_marquardt_lanes(problem, pose, start, {.tolerance = NAN}, lanes), Error);
  EXPECT_THROW(levenberg_marquardt_lanes(problem, pose, start, {.max_iterations = -1}, lanes),
               Error);
  EXPECT_THROW(levenberg_marquardt_lanes(problem, make_pose(Vector3(NAN, 0, 0)), start, {}, lanes),
               Error);
}

}  // namespace
}  // namespace beeline
