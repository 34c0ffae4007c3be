#include <bit>
#include <gtest/gtest.h>

#include <beeline/inverse/numerical/levenberg_marquardt_lanes.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se3.h>

#include <tests/inverse/answer.h>
#include <tests/inverse/numerical/lane_starts.h>
#include <tests/random.h>

namespace beeline {
namespace {

using namespace internal;

using testing::found;
using testing::largest;
using testing::starts_near;

TEST(DescentLanes, EveryMaskAndFrameConvergesFromNearby) {
  testing::Random random;
  const Arm arm = built_in("puma560");
  LevenbergMarquardtLanes lanes;
  for (int mask = 1; mask < 64; ++mask) {
    for (const Frame frame : {Frame::base, Frame::tool}) {
      Task task{.rows = {}, .frame = frame};
      for (std::size_t i = 0; i < 6; ++i) task.rows[i] = (mask >> i & 1) != 0;
      const NumericalProblem problem = numerical_problem(arm, task, no_bounds(arm));
      int arrived = 0;
      for (int i = 0; i < 10; ++i) {
        const Configuration q = random.configuration(arm);
        const Pose pose = testing::moved_where_free(forward_kinematics(arm, q), task, random);
        levenberg_marquardt_lanes(problem, pose, starts_near(q, 0.02, random), {}, lanes);
        for (int lane = 0; lane < solver_lane_count; ++lane) {
          const Pose at = forward_kinematics(arm, found(problem, lanes, lane));
          const bool there = (lanes.converged >> lane & 1) != 0;
          EXPECT_EQ(there, largest(task_deviation(task, pose, at)) <= 1e-10) << name(task);
          arrived += there;
        }
      }
      EXPECT_GE(arrived, 72) << name(task);
    }
  }
}

TEST(DescentLanes, ErrorIsTheTasksAtEveryAngleUpToAHalfTurn) {
  testing::Random random;
  const Arm arm = built_in("iiwa14");
  LevenbergMarquardtLanes lanes;
  for (const Task& task : {Task::spatial(), task_named("111110:tool"), task_named("101011")}) {
    const NumericalProblem problem = numerical_problem(arm, task, no_bounds(arm));
    for (int i = 0; i < 300; ++i) {
      const Configuration q = random.configuration(arm);
      Pose pose = forward_kinematics(arm, q);
      const double pi = 3.14159265358979323846;
      const double short_of_pi = i % 3 == 0 ? 0 : std::pow(10.0, random.uniform(-16, 0.4));
      const double angle = i % 2 == 0 ? pi - short_of_pi : short_of_pi;
      pose.linear() = so3_exp(random.direction() * angle) * pose.linear();
      levenberg_marquardt_lanes(problem, pose, q, {.max_iterations = 0}, lanes);
      const Eigen::VectorXd error = task_error(task, pose, forward_kinematics(arm, q));
      int row = 0;
      for (int r = 0; r < 6; ++r) {
        const double seen = lanes.error[r].lane[0] * (r < 3 ? problem.length : 1);
        if (!task.rows[r]) {
          EXPECT_EQ(seen, 0);
        } else if (angle < 3.14159) {  // for a rotation by pi both signs are right
          EXPECT_NEAR(seen, error[row], 1e-14 + 1e-9 * angle * angle) << angle;
          ++row;
        } else {
          EXPECT_NEAR(std::abs(seen), std::abs(error[row]), 2e-7) << pi - angle;
          ++row;
        }
      }
    }
  }
}

}  // namespace
}  // namespace beeline
