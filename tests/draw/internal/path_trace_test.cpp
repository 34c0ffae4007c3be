#include <algorithm>
#include <gtest/gtest.h>

#include <beeline/draw/internal/deviation_charts.h>
#include <beeline/draw/internal/path_trace.h>
#include <beeline/draw/internal/projection.h>
#include <beeline/draw/timing_figure.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/path/blend.h>
#include <beeline/planning/move_along.h>
#include <beeline/trajectory/limit_usage.h>

#include <tests/draw/page.h>

namespace beeline {
using namespace internal;
namespace {

using testing::expect_within_page;

struct LinesOf {
  Arm arm;
  PathMotion motion;
  FollowedPath path;
};

LinesOf panda_lines(double rate = 0) {
  Arm arm = built_in("panda");
  const Configuration q = (Configuration(7) << 0, -0.785, 0, -2.356, 0, 1.571, 0.785).finished();
  const Pose tool = forward_kinematics(arm, q);
  const std::vector<Pose> waypoints{Eigen::Translation3d(0, 0.2, -0.1) * tool,
                                    tool * Eigen::AngleAxisd(0.3, Vector3::UnitZ()),
                                    tool * Eigen::AngleAxisd(0.1, Vector3::UnitX())};
  PathMotion motion = move_in_lines(arm, q, waypoints, {.rate = rate});
  FollowedPath path{motion.path, motion.path_parameters, Task::spatial(), Deviation{1e-4, 1e-4}};
  return {arm, motion, path};
}

// The section that leads back within the limits is off the path.
TEST(PathTrace, BeginsAfterTheRecovery) {
  const Arm arm = built_in("panda");
  Configuration start = middle_configuration(arm);
  start[3] = arm.limits(3).upper + 0.05;
  Configuration goal = nearest_within_limits(arm, start);
  goal[1] += 0.05;
  goal[3] -= 0.1;
  const Pose to = forward_kinematics(arm, goal);
  const PathMotion motion = move_in_lines(arm, start, {to}, {.recover = 0.1});
  ASSERT_TRUE(motion && motion.recovery) << motion.reason;
  const FollowedPath path{motion.path, motion.path_parameters, Task::spatial(),
                          Deviation{1e-4, 1e-4}};
  const PathTrace trace = trace_path(arm, motion.trajectory, path);
  for (const PathTrace::Point& point : trace.points) {
    EXPECT_LE(point.deviation.position, motion.deviation.bound.position);
    EXPECT_LE(point.deviation.orientation, motion.deviation.bound.orientation);
  }
  EXPECT_EQ(trace.steps.size(), motion.trajectory.size() - 1 - motion.recovery->sample);
}

TEST(PathTrace, AgreesWithTheDeviationReported) {
  for (const double rate : {0.0, 200.0}) {
    const auto [arm, motion, path] = panda_lines(rate);
    ASSERT_EQ(motion.status, MotionStatus::reached);
    const PathTrace trace = trace_path(arm, motion.trajectory, path);
    ASSERT_EQ(trace.steps.size(), motion.trajectory.size() - 1);
    Deviation measured, bound;
    for (const PathTrace::Point& point : trace.points) {
      measured.position = std::max(measured.position, point.deviation.position);
      measured.orientation = std::max(measured.orientation, point.deviation.orientation);
      EXPECT_NEAR(point.deviation_vector.norm(), point.deviation.position, 1e-12);
      EXPECT_GE(point.arc_length, 0);
      EXPECT_LE(point.arc_length, trace.segment_ends.back() + 1e-12);
      if (point.step == 0) continue;
      const Deviation& proved = trace.steps[point.step - 1].bound;
      EXPECT_LE(point.deviation.position, proved.position + 1e-15);
      EXPECT_LE(point.deviation.orientation, proved.orientation + 1e-12);
    }
    for (const PathTrace::Step& step : trace.steps) {
      bound.position = std::max(bound.position, step.bound.position);
      bound.orientation = std::max(bound.orientation, step.bound.orientation);
    }
    EXPECT_NEAR(bound.position, motion.deviation.bound.position, 1e-12);
    EXPECT_NEAR(bound.orientation, motion.deviation.bound.orientation, 1e-12);
    EXPECT_GE(measured.position, motion.deviation.sampled.position - 1e-12);
    EXPECT_TRUE(trace.has_pure_rotation);  // the last line only turns
  }
}

TEST(PathTrace, ExaggeratesToWhatShows) {
  for (const double rate : {0.0, 200.0}) {
    const auto [arm, motion, path] = panda_lines(rate);
    const PathTrace trace = trace_path(arm, motion.trajectory, path);
    const double factor = exaggeration(trace);
    EXPECT_EQ(factor, round_step(factor));
    double most = 0;
    for (const PathTrace::Point& point : trace.points) {
      most = std::max(most, point.deviation_vector.norm());
    }
    EXPECT_GT(factor * most, 0.005);
    EXPECT_LT(factor * most, 0.05);
    const Figure figure = exaggerated_figure(arm, trace, path, factor);
    EXPECT_NE(figure.columns[0][0].caption.find("×\u00a0"), std::string::npos);
    expect_within_page(timing_figure(arm, motion.trajectory, {.path = path}), "panda");
  }
}

TEST(PathTrace, IsSeenFromWhereItIsWide) {
  const auto [arm, motion, path] = panda_lines();
  const PathTrace trace = trace_path(arm, motion.trajectory, path);
  const Panel panel = exaggerated_figure(arm, trace, path, exaggeration(trace)).columns[0][0];
  const auto& trail = std::get<Polyline>(panel.drawing.items[1].shape).points;
  const auto length = [&](const View& view) {
    double sum = 0;
    for (std::size_t i = 1; i < trail.size(); ++i) {
      sum += (view.topRows<2>() * (trail[i] - trail[i - 1])).norm();
    }
    return sum;
  };
  for (double azimuth = -3; azimuth < 3; azimuth += 0.1) {
    EXPECT_GT(1.12 * length(panel.view), length(oblique_view(azimuth, 0.44)));
  }
}

TEST(PathTrace, PassesThroughEveryStop) {
  for (const double rate : {0.0, 200.0, 2000.0}) {
    const auto [arm, motion, path] = panda_lines(rate);
    const PathTrace trace = trace_path(arm, motion.trajectory, path);
    const Figure figure = exaggerated_figure(arm, trace, path, exaggeration(trace));
    const auto& trail = std::get<Polyline>(figure.columns[0][0].drawing.items[1].shape);
    for (const Segment& segment : path.path.segments) {
      double nearest = 1;
      for (const Vector3& p : trail.points) {
        nearest = std::min(nearest, (p - pose_at(segment, 1).translation()).norm());
      }
      EXPECT_LT(nearest, 5e-4);  // of 0.2 m: less than the line's width
    }
  }
}

std::vector<std::string> numbers_above(const Picture& picture) {
  std::vector<std::string> numbers;
  for (const PaperMark& mark : picture.marks) {
    const auto* text = std::get_if<PaperText>(&mark);
    if (text != nullptr && text->colour == amber && !text->halo) numbers.push_back(text->text);
  }
  return numbers;
}

TEST(PathTrace, NumbersTheGivenWaypoints) {
  const Arm arm = built_in("rrr");
  const Configuration start = Eigen::Vector3d(0.3, 1.2, 0.4);
  const Pose tool = forward_kinematics(arm, start);
  const std::vector<Pose> poses{Eigen::Translation3d(0.5, 0.5, 0) * tool,
                                Eigen::Translation3d(1, -0.3, 0) * tool,
                                Eigen::Translation3d(0.2, -1, 0) * tool};
  std::vector<Pose> all = poses;
  all.insert(all.begin(), tool);
  const Route routes[] = {route_of(lines_through(all), PathKind::line),
                          route_of(blended_lines(all, Deviation{0.05, 0.25})),
                          route_of(path_through(all, PathKind::spline), PathKind::spline)};
  for (const Route& route : routes) {
    for (const bool extra : {true, false}) {  // the start is or is not one of the waypoints
      const PathMotion motion = move_along(arm, start, route);
      ASSERT_EQ(motion.status, MotionStatus::reached) << motion.reason;
      const std::vector<Pose>& waypoints = extra ? poses : all;
      const FollowedPath path{motion.path, motion.path_parameters, Task::planar(), std::nullopt,
                              waypoints};
      const PlacedWaypoints placed = placed_waypoints(path);
      ASSERT_EQ(placed.poses.size(), waypoints.size());
      for (std::size_t w = 0; w < waypoints.size(); ++w) {
        const double s = placed.path_parameters[w];
        const Vector3 off = pose_at(path.path, s).translation() - waypoints[w].translation();
        EXPECT_LT(off.norm(), 0.0501);
        const std::optional<double> t = time_at(motion.trajectory, path, s);
        ASSERT_TRUE(t.has_value());
        const Configuration q = sample(motion.trajectory, *t).position;
        const Vector3 at = forward_kinematics(arm, q).translation();
        EXPECT_LT((at - waypoints[w].translation()).norm(), 0.1);
      }
      const Picture picture = timing_figure(arm, motion.trajectory, {.path = path});
      std::vector<std::string> numbers;
      for (int column = 0; column < 2; ++column) {
        for (std::size_t w = 0; w < waypoints.size(); ++w) numbers.push_back(std::to_string(w + 1));
      }
      EXPECT_EQ(numbers_above(picture), numbers);
    }
  }
}

TEST(PathTrace, OfManySamplesIsASmallPictureThatKeepsTheExtremes) {
  const auto [arm, motion, path] = panda_lines(20'000);
  const PathTrace trace = trace_path(arm, motion.trajectory, path);
  ASSERT_GT(trace.steps.size(), 10'000u);
  double most = 0;
  for (const PathTrace::Point& point : trace.points)
    most = std::max(most, point.deviation_vector.norm());
  const Figure figure = exaggerated_figure(arm, trace, path, 1e9);
  const auto& trail = std::get<Polyline>(figure.columns[0][0].drawing.items[1].shape);
  EXPECT_LT(trail.points.size(), 3000u);
  double farthest = 0;
  for (const Vector3& p : trail.points) {
    double off = 1e300;
    for (std::size_t i = 1; i < trace.polyline.size(); ++i) {
      const Vector3 way = trace.polyline[i] - trace.polyline[i - 1];
      const double length = std::max(way.squaredNorm(), 1e-12);
      const double t = std::clamp(way.dot(p - trace.polyline[i - 1]) / length, 0.0, 1.0);
      off = std::min(off, (p - trace.polyline[i - 1] - t * way).norm());
    }
    farthest = std::max(farthest, off);
  }
  EXPECT_NEAR(farthest, 1e9 * most, 0.01 * 1e9 * most);
}

TEST(PathTrace, HasNothingToExaggerateOnLinesOfRounding) {
  const Arm arm = built_in("gantry");
  const std::vector<Pose> waypoints{Pose(Eigen::Translation3d(1, 0.5, 0)),
                                    Pose(Eigen::Translation3d(1, 0.5, 0))};
  const Task task = Task::position();
  const PathMotion motion = move_in_lines(arm, Configuration::Zero(2), waypoints, {.task = task});
  ASSERT_EQ(motion.status, MotionStatus::reached) << motion.reason;
  const FollowedPath path{motion.path, motion.path_parameters, task};
  const PathTrace trace = trace_path(arm, motion.trajectory, path);
  EXPECT_EQ(exaggeration(trace), 1);
  EXPECT_EQ(deviation_charts(trace, path).size(), 1u);  // orientation is not asked for
  expect_within_page(timing_figure(arm, motion.trajectory, {.path = path}), "gantry");
}

}  // namespace
}  // namespace beeline
