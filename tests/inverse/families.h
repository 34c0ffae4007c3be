#pragma once

#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <beeline/inverse/analytic/pieper_loop.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/inverse/numerical/representative.h>

#include <tests/inverse/answer.h>
#include <tests/random.h>

namespace beeline::testing {

/// The arm with all lengths multiplied.
inline Arm scaled(const Arm& arm, double factor) {
  std::vector<Joint> joints = arm.joints();
  for (Joint& joint : joints) {
    joint.screw.head<3>() *= factor;
    joint.offset.translation() *= factor;
  }
  Pose tool = arm.tool(), base = arm.base();
  tool.translation() *= factor;
  base.translation() *= factor;
  return {arm.name(), joints, tool, base};
}

/// Where a joint's axis is while every coordinate is zero.
struct Axis {
  Vector3 direction;
  Vector3 point;
  bool slides = false;
};

inline Axis random_axis(Random& random, bool slides = false, double size = 1) {
  return {random.direction(), random.vector(size), slides};
}

/// The arm with these axes; its base, its tool and its link frames stand anywhere, so that nothing
/// but the axes tells what it is. No limits.
inline Arm arm_through(const std::vector<Axis>& axes, Random& random, double size = 1) {
  const Pose base = random.pose(size);
  Pose before = base;
  std::vector<Joint> joints;
  for (const Axis& axis : axes) {
    const Pose frame = random.pose(size);
    const Vector3 direction = frame.linear().transpose() * axis.direction;
    const Vector3 point = frame.inverse(Eigen::Isometry) * axis.point;
    Joint joint;
    joint.name = "j" + std::to_string(joints.size() + 1);
    joint.offset = before.inverse(Eigen::Isometry) * frame;
    joint.screw = axis.slides ? translation_screw(direction) : rotation_screw(direction, point);
    joints.push_back(joint);
    before = frame;
  }
  return {"axes", joints, random.pose(size), base};
}

/// Random axes of the letters given (R or P), of which the three from `first` on (0 to 3) meet or
/// are parallel.
inline std::vector<Axis> axes_with(internal::PieperLoop::Family family, std::size_t first,
                                   const std::string& letters, Random& random, double size = 1) {
  std::vector<Axis> axes;
  for (const char letter : letters) axes.push_back(random_axis(random, letter == 'P', size));
  for (std::size_t i = first + 1; i < first + 3; ++i) {
    if (family == internal::PieperLoop::Family::intersecting) {
      axes[i].point = axes[first].point + random.uniform(-size, size) * axes[i].direction;
    } else {
      axes[i].direction = axes[first].direction * (random.integer(0, 1) == 0 ? 1 : -1);
    }
  }
  return axes;
}

inline bool holds(const Arm& arm, const std::vector<Configuration>& list, const Configuration& q,
                  double tolerance = 1e-6) {
  for (const Configuration& each : list) {
    if (internal::same_posture(arm, each, q, tolerance)) return true;
  }
  return false;
}

/// Whether q is one of the solutions, or one with it to the tolerance: next to a singular pose two
/// solutions count as one if the configuration halfway between them nearly solves the pose.
inline bool holds_or_merged(const Arm& arm, const Task& task, const Pose& pose,
                            const std::vector<Configuration>& list, const Configuration& q) {
  constexpr double near = 0.01,
                   nearly = 1e-9;  // ten times the default of InverseOptions::tolerance
  if (holds(arm, list, q)) return true;
  for (const Configuration& each : list) {
    if (!internal::same_posture(arm, each, q, near)) continue;
    const Configuration beside =
        internal::nearest_representative(arm, each, q, internal::no_bounds(arm));
    const Pose halfway = forward_kinematics(arm, (q + beside) / 2);
    if (largest(task_deviation(task, pose, halfway)) <= nearly) return true;
  }
  return false;
}

/// The solutions that descents from random starts find, limits ignored. It ends early when it has
/// met `enough` and another 100 starts have found no more.
inline std::vector<Configuration> search_all(const Arm& arm, const Pose& pose, const Task& task,
                                             std::size_t enough, int starts, Random& random) {
  std::vector<Configuration> found;
  for (int start = 0, idle = 0; start < starts && (found.size() < enough || idle < 100); ++start) {
    const internal::NumericalResult run = internal::levenberg_marquardt(
        arm, pose, task, internal::no_bounds(arm), random.configuration(arm));
    const bool is_new = run.converged && !holds(arm, found, run.q, 1e-4);
    if (is_new) found.push_back(run.q);
    idle = is_new ? 0 : idle + 1;
  }
  return found;
}

/// All solutions that the closed form finds, by default with limits ignored.
inline InverseResult closed_form_solutions(const Arm& arm, const Pose& pose, const Task& task,
                                           bool ignore_limits = true) {
  return inverse_kinematics(arm, pose,
                            {.task = task,
                             .method = InverseMethod::closed_form,
                             .all = true,
                             .ignore_limits = ignore_limits});
}

struct Counts {
  int poses = 0;
  int equal = 0;  ///< poses for which a search found as many solutions
};

/// Checks that the closed form solves the pose, that holds_or_merged() `from`, that all reach the
/// pose, and, with `counts`, that a numerical search finds no further one.
inline void expect_every_solution(const Arm& arm, const Task& task, const Configuration& from,
                                  const Pose& pose, Random& random, Counts* counts) {
  const InverseResult result = closed_form_solutions(arm, pose, task);
  SCOPED_TRACE(name(task) + ", " + result.method);
  ASSERT_EQ(result.status, InverseStatus::solved) << result.reason;
  EXPECT_TRUE(holds_or_merged(arm, task, pose, result.solutions, from)) << from.transpose();
  EXPECT_LE(result.solutions.size(), 8U);
  for (const Configuration& q : result.solutions) {
    EXPECT_LE(largest(task_deviation(task, pose, forward_kinematics(arm, q))), 1e-10);
  }
  if (counts == nullptr) return;
  const auto found = search_all(arm, pose, task, result.solutions.size(), 400, random);
  ++counts->poses;
  counts->equal += found.size() == result.solutions.size();
  for (const Configuration& q : found) {
    EXPECT_TRUE(holds(arm, result.solutions, q, 1e-4)) << q.transpose();
  }
}

}  // namespace beeline::testing
