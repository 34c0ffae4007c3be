#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <set>

#include <beeline/draw/canvas.h>
#include <beeline/draw/internal/deviation_charts.h>
#include <beeline/draw/internal/joint_charts.h>
#include <beeline/draw/internal/projection.h>
#include <beeline/draw/timing_figure.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>

#include <tests/draw/page.h>
#include <tests/random_arm.h>
#include <tests/refusal.h>

namespace beeline {
using namespace internal;
namespace {

using testing::expect_within_page;
using testing::Random;

Trajectory wave(Random& random, const Arm& arm, int samples, bool known) {
  Trajectory motion = at_rest(arm, random.configuration(arm));
  const Configuration middle = motion.positions[0], way = random.configuration(arm);
  motion.velocities.clear();
  motion.accelerations.clear();
  motion.positions.clear();
  motion.times.clear();
  for (int k = 0; k < samples; ++k) {
    const double t = 0.02 * k;
    motion.times.push_back(t);
    motion.positions.push_back(middle + 0.1 * std::sin(t) * way);
    if (!known) continue;
    motion.velocities.push_back(0.1 * std::cos(t) * way);
    motion.accelerations.push_back(-0.1 * std::sin(t) * way);
  }
  return motion;
}

Arm limited(const Arm& arm, Random& random) {
  std::vector<Joint> joints = arm.joints();
  for (Joint& joint : joints) {
    if (random.integer(0, 1) == 1) joint.limits.velocity = random.uniform(0.1, 3);
    if (random.integer(0, 1) == 1) joint.limits.acceleration = random.uniform(0.1, 9);
    if (random.integer(0, 3) == 0) joint.limits.lower = -Limits::none;
  }
  return {arm.name(), joints, arm.tool(), arm.base()};
}

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

TEST(JointCharts, GivesEveryJointACurveByItsOwnLimitOrInItsUnit) {
  Random random;
  for (int trial = 0; trial < 60; ++trial) {
    const Arm arm = limited(testing::random_arm(random, random.integer(1, 10)), random);
    const bool known = random.integer(0, 1) == 1;
    const Trajectory motion = wave(random, arm, 50, known);
    const std::vector<Chart> charts = joint_charts(arm, motion);
    ASSERT_EQ(charts.size(), 3u);
    for (const Chart& chart : charts) ASSERT_EQ(chart.curves.size(), std::size_t(arm.dof()));
    for (int k = 0; k < arm.dof(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      const Curve& position = charts[0].curves[i];
      const Curve& velocity = charts[1].curves[i];
      const Limits& limits = arm.limits(i);
      const bool ranged = std::isfinite(limits.upper - limits.lower);
      for (std::size_t s = 0; s < motion.size(); ++s) {
        const double q = motion.positions[s][k];
        const double share = (q - limits.lower) / (limits.upper - limits.lower) * 200 - 100;
        EXPECT_NEAR(position.y[s], ranged ? share : q, 1e-9);
      }
      if (!known) continue;
      const bool held = std::isfinite(limits.velocity);
      for (std::size_t s = 0; s < motion.size(); ++s) {
        const double v = motion.velocities[s][k];
        EXPECT_NEAR(velocity.y[s], held ? 100 * v / limits.velocity : v, 1e-9);
      }
    }
  }
}

TEST(JointCharts, TakesDifferencesForWhatIsNotKnown) {
  Random random;
  const Arm arm = built_in("rrr");
  const Trajectory known = wave(random, arm, 400, true);
  Trajectory bare = known;
  bare.velocities.clear();
  bare.accelerations.clear();
  const std::vector<Chart> with = joint_charts(arm, known), without = joint_charts(arm, bare);
  for (std::size_t kind = 1; kind < 3; ++kind) {
    EXPECT_NE(without[kind].heading.find("by differences"), std::string::npos);
    for (std::size_t k = 0; k < 3; ++k) {
      const Curve &a = with[kind].curves[k], &b = without[kind].curves[k];
      for (std::size_t s = 2; s + 3 < a.y.size(); ++s) EXPECT_NEAR(b.y[2 * s], a.y[s], 0.02);
    }
  }
  const Curve speed = tool_speed_chart(arm, known).curves[0];
  const Curve steps = tool_speed_chart(arm, bare).curves[0];
  for (std::size_t s = 0; s + 1 < speed.y.size(); ++s) {  // but where it turns back within a step
    const double before = speed.y[s], after = speed.y[s + 1];
    EXPECT_LT(steps.y[2 * s], std::max(before, after) + 0.01);
    if (std::min(before, after) > 0.1) {
      EXPECT_NEAR(steps.y[2 * s], (before + after) / 2, 0.01);
    }
  }
}

TEST(JointCharts, TellsThirtyJointsApart) {
  Random random;
  const Arm arm = testing::random_arm(random, 30);
  std::set<std::tuple<double, double, double, std::vector<double>>> looks;
  for (int k = 0; k < 30; ++k) {
    const Curve curve = joint_curve(arm, k);
    EXPECT_EQ(curve.name, arm.joint_of(k).name);
    looks.insert({curve.colour.red, curve.colour.green, curve.colour.blue, curve.dashes});
  }
  EXPECT_EQ(looks.size(), 30u);
}

TEST(TimingFigure, ClipsNothingOfArmsWithOneToThirtyJoints) {
  Random random;
  for (const int joints : {1, 2, 3, 7, 10, 30}) {
    for (const int samples : {1, 2, 3, 200}) {
      for (const bool known : {false, true}) {
        const Arm arm = limited(testing::random_arm(random, joints), random);
        const Drawing drawing = timing_figure(arm, wave(random, arm, samples, known));
        expect_within_page(drawing, std::to_string(joints) + " joints");
        EXPECT_GT(render(drawing, Format::svg).size(), 1000u);
        std::set<std::string> texts;
        for (const PaperMark& mark : drawing.marks) {
          if (const auto* text = std::get_if<PaperText>(&mark)) texts.insert(text->text);
        }
        for (const std::string& name : arm.joint_names()) EXPECT_TRUE(texts.contains(name));
      }
    }
  }
}

TEST(TimingFigure, StandsExtremeValuesOrRefusesThem) {
  const Arm arm = built_in("gantry");
  for (const double size : {1e-300, 1e-20, 1e-6, 1e6, 1e12, 1e40, 1e160, 1e300}) {
    for (const double dt : {1e-200, 1e-9, 1.0, 1e9}) {
      Trajectory motion = at_rest(arm, Configuration::Zero(2));
      motion.velocities.clear();
      motion.accelerations.clear();
      motion.times.push_back(dt);
      motion.positions.push_back(Configuration::Constant(2, size));
      motion.times.push_back(3 * dt);
      motion.positions.push_back(Configuration::Zero(2));
      try {
        expect_within_page(timing_figure(arm, motion), "extreme");
      } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("finite"), std::string::npos) << error.what();
        EXPECT_TRUE(size > 1e100 || dt < 1e-100) << size << " " << dt;
      }
    }
  }
}

TEST(TimingFigure, DrawsAHundredThousandSamplesInAFewHundredKilobytes) {
  Random random;
  const Arm arm = built_in("panda");
  const Trajectory motion = wave(random, arm, 100'000, true);
  EXPECT_LT(render(timing_figure(arm, motion), Format::svg).size(), 1'500'000u);
}

TEST(TimingFigure, RefusesWhatDoesNotFit) {
  const Arm arm = built_in("rrr");
  EXPECT_REFUSED(timing_figure(arm, Trajectory{arm.joint_names(), {}, {}, {}, {}}), "samples");
  EXPECT_REFUSED(timing_figure(arm, at_rest(built_in("panda"), Configuration::Zero(7))), "joint");
  const ToolPath still = lines_through(std::vector{Pose::Identity(), Pose::Identity()});
  const FollowedPath path{still, {0, 5}, Task::planar()};
  EXPECT_REFUSED(timing_figure(arm, at_rest(arm, Configuration::Zero(3)), {.path = path}),
                 "path parameters");
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

TEST(PathTrace, OfManySamplesIsASmallPictureThatKeepsTheExtremes) {
  const auto [arm, motion, path] = panda_lines(20'000);
  const PathTrace trace = trace_path(arm, motion.trajectory, path);
  ASSERT_GT(trace.steps.size(), 10'000u);
  double most = 0;
  for (const PathTrace::Point& point : trace.points)
    most = std::max(most, point.deviation_vector.norm());
  const Figure figure = exaggerated_figure(arm, trace, path, 1e9);
  const auto& trail = std::get<Polyline>(figure.columns[0][0].scene.items[1].shape);
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
