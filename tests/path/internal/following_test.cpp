#include <cmath>
#include <gtest/gtest.h>

#include <beeline/path/internal/following.h>

#include <tests/path/random_segment.h>

namespace beeline::internal {
namespace {

using testing::kind_of;
using testing::Random;

Task random_task(Random& random) {
  Task task;
  do {
    for (bool& row : task.rows) row = random.integer(0, 2) > 0;
  } while (task.size() == 0);
  task.frame = random.integer(0, 1) == 0 ? Frame::base : Frame::tool;
  return task;
}

/// A tool with constant acceleration, linear and (at t = 0) angular.
struct MovingTool {
  Pose start;
  Twist velocity, acceleration;

  Pose at(double t) const {
    const Twist moved = velocity * t + acceleration * (t * t / 2);
    Pose pose = Pose::Identity();
    pose.translation() = start.translation() + moved.head<3>();
    pose.linear() = so3_exp(moved.tail<3>()) * start.linear();
    return pose;
  }
  PoseMotion motion() const { return {start, velocity, acceleration}; }
};

/// One up to 20 cm away from `pose`, rotated by any angle up to 2 rad if the task leaves one or two
/// rotations free, otherwise at its orientation.
MovingTool random_tool(Random& random, const Task& task, const Pose& pose) {
  MovingTool tool{pose, {}, {}};
  if (task.orientations() == 1 || task.orientations() == 2) {
    tool.start.linear() = so3_exp(random.uniform(0, 2) * random.direction()) * pose.linear();
  }
  tool.start.translation() += random.vector(0.2);
  tool.velocity << random.vector(), random.vector();
  tool.acceleration << random.vector(), random.vector();
  return tool;
}

double parameter_at(double s, const ParameterRates& rates, double t) {
  return s + rates.first * t + rates.second * t * t / 2;
}

/// The tool's error from the segment at the parameter s, all rows in the axes of the task.
Twist row_errors(const Task& task, const Pose& tool, const Segment& segment, double s) {
  Twist error = pose_difference(tool, pose_at(segment, s));
  if (task.frame == Frame::tool) {
    error << tool.linear().transpose() * error.head<3>(),
        tool.linear().transpose() * error.tail<3>();
  }
  return error;
}

/// Twists in world axes, in the axes of the task.
Twist in_axes(const Task& task, const Rotation& world_R_tool, const Twist& twist) {
  if (task.frame != Frame::tool) return twist;
  Twist turned;
  turned << world_R_tool.transpose() * twist.head<3>(), world_R_tool.transpose() * twist.tail<3>();
  return turned;
}

/// The first and second derivative at t = 0, by central differences of five points.
struct Differences {
  Twist first, second;
};
Differences differences(const auto& f) {
  constexpr double h = 2e-3;
  const Twist m2 = f(-2 * h), m1 = f(-h), zero = f(0), p1 = f(h), p2 = f(2 * h);
  return {(8 * (p1 - m1) - (p2 - m2)) / (12 * h),
          (16 * (p1 + m1) - (p2 + m2) - 30 * zero) / (12 * h * h)};
}

TEST(MotionAlong, IsTheDerivativeOfThePoseAtTheParameter) {
  Random random;
  for (int i = 0; i < testing::cases(300); ++i) {
    const Segment segment = testing::random_segment(random);
    const double s = random.uniform(0.1, 0.9);
    const ParameterRates rates{random.uniform(-1, 1), random.uniform(-1, 1)};
    const Pose start = pose_at(segment, s);
    const auto [first, second] = differences([&](double t) {
      return pose_difference(pose_at(segment, parameter_at(s, rates, t)), start);
    });
    const PoseMotion motion = motion_along(segment, s, rates);
    const double size = testing::size_of(segment);
    ASSERT_LT((motion.velocity - first).norm(), 1e-7 * size) << kind_of(segment);
    ASSERT_LT((motion.acceleration - second).norm(), 1e-5 * size) << kind_of(segment);
  }
}

TEST(ErrorRates, AreTheDerivativesOfTheToolsErrorInTheRowsOfTheTask) {
  Random random;
  for (int i = 0; i < testing::cases(1000); ++i) {
    const Segment segment = testing::random_segment(random);
    const Task task = random_task(random);
    const double s = random.uniform(0.1, 0.9);
    const MovingTool tool = random_tool(random, task, pose_at(segment, s));
    const ParameterRates rates{random.uniform(-1, 1), random.uniform(-1, 1)};
    const auto [first, second] = differences(
        [&](double t) { return row_errors(task, tool.at(t), segment, parameter_at(s, rates, t)); });
    const ErrorRates found = error_rates(task, tool.motion(), motion_along(segment, s, rates));
    const Rotation axes = tool.start.linear();
    const double size = testing::size_of(segment);
    ASSERT_LT((in_axes(task, axes, found.first) - first).norm(), 1e-6 * size)
        << kind_of(segment) << ", task " << task;
    ASSERT_LT((in_axes(task, axes, found.second) - second).norm(), 1e-4 * size)
        << kind_of(segment) << ", task " << task;
  }
}

TEST(ErrorJacobian, IsTheDerivativeOfTheRatesByTheToolsVelocity) {
  Random random;
  for (int i = 0; i < testing::cases(1000); ++i) {
    const Segment segment = testing::random_segment(random);
    const Task task = random_task(random);
    const MovingTool tool = random_tool(random, task, pose_at(segment, 0.5));
    const PoseMotion path = motion_at(segment, 0.5);
    const PoseMotion still{tool.start, Twist::Zero(), Twist::Zero()};
    const Twist rates = error_rates(task, tool.motion(), path).first;
    const Twist change = rates - error_rates(task, still, path).first;
    const Eigen::VectorXd rows = task_rows(task, in_axes(task, tool.start.linear(), change));
    const Eigen::VectorXd found = error_jacobian(task, tool.start, path.pose) * tool.velocity;
    ASSERT_LT((found - rows).norm(), 1e-12 * testing::size_of(segment)) << "task " << task;
  }
}

TEST(Following, FindsTheRatesOfAToolOnTheSegment) {
  Random random;
  int found = 0;
  for (int i = 0; i < testing::cases(1000); ++i) {
    const Segment segment = testing::random_segment(random);
    const Task task = random_task(random);
    const double s = random.uniform(0, 1);
    const ParameterRates rates{random.uniform(-2, 2), random.uniform(-2, 2)};
    const PoseMotion tool = motion_along(segment, s, rates);
    const Twist rows = in_axes(task, tool.pose.linear(), motion_at(segment, s).velocity);
    if (task_rows(task, rows).norm() < 1e-4) continue;  // at rest
    const ParameterRates back = following(segment, s, task, tool);
    const double size = testing::size_of(segment) / task_rows(task, rows).norm();
    ASSERT_NEAR(back.first, rates.first, 1e-9 * size) << kind_of(segment) << ", task " << task;
    ASSERT_NEAR(back.second, rates.second, 1e-8 * size) << kind_of(segment) << ", task " << task;
    ++found;
  }
  EXPECT_GT(found, testing::cases(1000) / 2);
}

// The derivatives of the error have no component along the segment, rotations in metres.
TEST(Following, IsTheLeastSquaresSolution) {
  Random random;
  int found = 0;
  for (int i = 0; i < testing::cases(1000); ++i) {
    const Segment segment = testing::random_segment(random);
    if (std::holds_alternative<Line>(segment)) continue;  // by position or by rotation alone
    const Task task = random_task(random);
    const double s = random.uniform(0.1, 0.9);
    const MovingTool tool = random_tool(random, task, pose_at(segment, s));
    const ParameterRates rates = following(segment, s, task, tool.motion());
    const auto weighted = [&](Twist rows) {
      for (int row = 0; row < 6; ++row) rows[row] *= task.rows[row];
      rows.tail<3>() *= metres_per_radian;
      return rows;
    };
    const auto [first, second] = differences([&](double t) {
      return weighted(row_errors(task, tool.at(t), segment, parameter_at(s, rates, t)));
    });
    const Twist along = differences([&](double t) {
                          return weighted(row_errors(task, tool.start, segment, s - t));
                        }).first;
    if (along.norm() < 1e-3 || std::abs(rates.first) > 5 || std::abs(rates.second) > 20)
      continue;  // nearly at rest
    ++found;
    const double size =
        testing::size_of(segment) * (1 + std::abs(rates.second)) * (1 + rates.first * rates.first);
    ASSERT_LT(std::abs(along.normalized().dot(first)), 1e-6 * size) << kind_of(segment);
    ASSERT_LT(std::abs(along.normalized().dot(second)), 1e-4 * size)
        << kind_of(segment) << ", task " << task;
  }
  EXPECT_GT(found, testing::cases(1000) / 4);
}

TEST(Following, IsZeroWhereTheSegmentIsAtRestInTheRows) {
  Random random;
  Pose to = Pose::Identity();
  to.linear() = so3_exp({0, 0, 1});
  const Line turn{Pose::Identity(), to};
  const ParameterRates rates =
      following(turn, 0.5, Task::position(), random_tool(random, Task::position(), to).motion());
  EXPECT_EQ(rates.first, 0);
  EXPECT_EQ(rates.second, 0);
}

}  // namespace
}  // namespace beeline::internal
