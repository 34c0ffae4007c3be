#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <set>

#include <beeline/draw/figure.h>
#include <beeline/draw/internal/joint_charts.h>
#include <beeline/draw/timing_figure.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/model/catalog.h>

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

/// The value of a curve at x, between its points.
double value_at(const Curve& curve, double x) {
  const auto later = std::upper_bound(curve.x.begin(), curve.x.end(), x);
  if (later == curve.x.end()) return curve.y.back();
  const auto i = static_cast<std::size_t>(later - curve.x.begin());
  if (i == 0) return curve.y.front();
  const double t = (x - curve.x[i - 1]) / (curve.x[i] - curve.x[i - 1]);
  return curve.y[i - 1] + t * (curve.y[i] - curve.y[i - 1]);
}

/// The unit of a joint's curve: a hundredth of its limit, or 1 without one.
double scale_of(const Limits& limits, std::size_t order) {
  const double half = order == 0   ? (limits.upper - limits.lower) / 2
                      : order == 1 ? limits.velocity
                                   : limits.acceleration;
  return std::isfinite(half) ? half / 100 : 1;
}

double middle_of(const Limits& limits, std::size_t order) {
  const bool ranged = order == 0 && std::isfinite(limits.upper - limits.lower);
  return ranged ? (limits.upper + limits.lower) / 2 : 0;
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
        EXPECT_NEAR(value_at(position, motion.times[s]), ranged ? share : q, 1e-9);
      }
      if (!known) continue;
      const bool held = std::isfinite(limits.velocity);
      for (std::size_t s = 0; s < motion.size(); ++s) {
        const double v = motion.velocities[s][k];
        EXPECT_NEAR(value_at(velocity, motion.times[s]), held ? 100 * v / limits.velocity : v,
                    1e-9);
      }
    }
  }
}

TEST(JointCharts, FollowThePolynomialsBetweenTheSamples) {
  Random random;
  for (int trial = 0; trial < 40; ++trial) {
    const Arm arm = testing::random_arm(random, random.integer(1, 4));
    Trajectory motion = wave(random, arm, random.integer(2, 8), true);
    for (Configuration& a : motion.accelerations) a = 50 * random.configuration(arm);
    if (trial % 2 == 0) motion.accelerations.clear();
    Arm bare(arm.name(), arm.joints(), arm.tool(), arm.base());
    const std::vector<Chart> charts = joint_charts(bare, motion);
    const Chart speed = tool_speed_chart(bare, motion);
    ASSERT_EQ(charts.size(), 3u);
    for (int n = 0; n < 50; ++n) {
      const double t = random.uniform(0, motion.times.back());
      const TrajectoryState state = sample(motion, t);
      for (int k = 0; k < arm.dof(); ++k) {
        const auto i = static_cast<std::size_t>(k);
        const double values[] = {state.position[k], state.velocity[k], state.acceleration[k]};
        for (std::size_t order = 0; order < 3; ++order) {
          const Curve& curve = charts[order].curves[i];
          const auto [low, high] = std::minmax_element(curve.y.begin(), curve.y.end());
          const double unit = scale_of(bare.limits(i), order);
          const double value = (values[order] - middle_of(bare.limits(i), order)) / unit;
          EXPECT_NEAR(value_at(curve, t), value, 0.02 * (*high - *low) + 1e-9);
          EXPECT_LT(value, *high + 1e-6 * (1 + std::abs(*high)));  // no peak is cut off
          EXPECT_GT(value, *low - 1e-6 * (1 + std::abs(*low)));
        }
      }
      const double v = (jacobian(bare, state.position).topRows<3>() * state.velocity).norm();
      const double most = *std::max_element(speed.curves[0].y.begin(), speed.curves[0].y.end());
      EXPECT_NEAR(value_at(speed.curves[0], t), v, 0.15 * most + 1e-9);
    }
  }
}

TEST(JointCharts, OfAMillionSamplesAreShortButKeepASpike) {
  const Arm arm = built_in("gantry");
  Trajectory motion{arm.joint_names(), {}, {}, {}, {}};
  for (int k = 0; k < 1'000'000; ++k) {
    motion.times.push_back(1e-3 * k);
    motion.positions.emplace_back(Eigen::Vector2d(std::sin(1e-5 * k), 0));
  }
  motion.positions[765'432].y() = 0.25;
  const std::vector<Chart> charts = joint_charts(arm, motion);
  const double peaks[] = {0.25, 250};  // m, m/s
  for (std::size_t order = 0; order < 2; ++order) {
    const Curve& curve = charts[order].curves[1];
    EXPECT_LT(curve.x.size(), 20'000u);
    const double unit = scale_of(arm.limits(1), order);
    const double middle = middle_of(arm.limits(1), order);
    EXPECT_NEAR(*std::max_element(curve.y.begin(), curve.y.end()), (peaks[order] - middle) / unit,
                1e-6 * peaks[order] / unit);
  }
}

TEST(JointCharts, TakesDifferencesForAccelerationsOfLinearMotions) {
  Random random;
  const Arm arm = built_in("rrr");
  const Trajectory known = wave(random, arm, 400, true);
  Trajectory bare = known;
  bare.velocities.clear();
  bare.accelerations.clear();
  const std::vector<Chart> with = joint_charts(arm, known), without = joint_charts(arm, bare);
  EXPECT_EQ(without[1].heading, "joint velocities");
  EXPECT_NE(without[2].heading.find("by differences"), std::string::npos);
  for (std::size_t kind = 1; kind < 3; ++kind) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t s = 3; s + 3 < known.size(); ++s) {
        const double t = known.times[s];
        EXPECT_NEAR(value_at(without[kind].curves[k], t), value_at(with[kind].curves[k], t), 0.02);
      }
    }
  }
}

TEST(JointCharts, OfATrajectoryAloneAreThoseOfAnArmWithoutLimits) {
  Random random;
  const Arm arm = testing::random_arm(random, 4);
  std::vector<Joint> joints = arm.joints();
  for (Joint& joint : joints) joint.limits = {};
  const Arm bare(arm.name(), joints);
  for (const bool known : {false, true}) {
    const Trajectory motion = wave(random, arm, 20, known);
    const std::vector<Chart> alone = joint_charts(motion), with_arm = joint_charts(bare, motion);
    ASSERT_EQ(alone.size(), with_arm.size());
    for (std::size_t i = 0; i < alone.size(); ++i) {
      EXPECT_EQ(alone[i].heading, with_arm[i].heading);
      for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(alone[i].curves[k].x, with_arm[i].curves[k].x);
        EXPECT_EQ(alone[i].curves[k].y, with_arm[i].curves[k].y);
      }
    }
    EXPECT_GT(timing_figure(motion).width, 0);
  }
  EXPECT_THROW(timing_figure(Trajectory{{"a"}, {}, {}, {}, {}}), Error);
}

TEST(JointCharts, TellsThirtyJointsApart) {
  Random random;
  const Arm arm = testing::random_arm(random, 30);
  std::set<std::tuple<double, double, double, std::vector<double>>> looks;
  for (int k = 0; k < 30; ++k) {
    const Curve curve = joint_curve(arm.joint_of(k).name, k);
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
        const Picture picture = timing_figure(arm, wave(random, arm, samples, known));
        expect_within_page(picture, std::to_string(joints) + " joints");
        EXPECT_GT(render(picture, Format::svg).size(), 1000u);
        std::set<std::string> texts;
        for (const PaperMark& mark : picture.marks) {
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

}  // namespace
}  // namespace beeline
