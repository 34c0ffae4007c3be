#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <sstream>

#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>
#include <beeline/trajectory/trajectory.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

Trajectory random_trajectory(testing::Random& random, const Arm& arm, int samples) {
  Trajectory trajectory{arm.joint_names(), {}, {}, {}, {}};
  double t = random.uniform(-5, 5);
  for (int k = 0; k < samples; ++k) {
    trajectory.times.push_back(t += random.uniform(1e-3, 1));
    trajectory.positions.push_back(random.configuration(arm));
    trajectory.velocities.push_back(random.configuration(arm));
    trajectory.accelerations.push_back(random.configuration(arm));
  }
  return trajectory;
}

std::string printed(const Trajectory& trajectory) {
  std::ostringstream text;
  text << trajectory;
  return text.str();
}

TEST(Trajectory, IsPrintedAsJointsSamplesAndDuration) {
  const Arm arm = built_in("panda");
  testing::Random random;
  Trajectory trajectory = random_trajectory(random, arm, 43);
  const std::string duration = number(trajectory.times.back() - trajectory.times.front());
  EXPECT_EQ(printed(trajectory), "7 joints, 43 samples, " + duration + " s, quintic");
  trajectory.accelerations.clear();
  EXPECT_EQ(printed(trajectory), "7 joints, 43 samples, " + duration + " s, cubic");
  EXPECT_EQ(printed({{"j"}, {2}, {Configuration::Zero(1)}, {}, {}}),
            "1 joint, 1 sample, 0 s, linear");
  EXPECT_EQ(printed({}), "0 joints, 0 samples");
}

TEST(AtRest, IsOneStillSampleAtTimeZero) {
  const Arm arm = built_in("panda");
  testing::Random random;
  const Configuration q = random.configuration(arm);
  const Trajectory trajectory = at_rest(arm, q);
  EXPECT_NO_THROW(check_trajectory(trajectory));
  EXPECT_EQ(trajectory.size(), 1);
  EXPECT_EQ(trajectory.times.front(), 0);
  EXPECT_EQ(trajectory.joint_names, arm.joint_names());
  EXPECT_EQ(trajectory.positions.front(), q);
  EXPECT_TRUE(trajectory.velocities.front().isZero(0));
  EXPECT_REFUSED(at_rest(arm, Configuration::Zero(6)), "7 joint values");
}

TEST(CheckTrajectory, NamesWhatIsWrongAndWhere) {
  testing::Random random;
  const Trajectory good = random_trajectory(random, built_in("rrr"), 5);
  EXPECT_NO_THROW(check_trajectory(good));
  EXPECT_NO_THROW(check_trajectory({}));
  const auto spoilt = [&good](auto&& spoil) {
    Trajectory bad = good;
    spoil(bad);
    return testing::refusal([&bad] { check_trajectory(bad); });
  };
  const auto says = [](const std::string& message, const std::string& part) {
    return message.find(part) != std::string::npos ? "" : "not \"" + part + "\" but: " + message;
  };
  EXPECT_EQ("", says(spoilt([](Trajectory& t) { t.positions.pop_back(); }), "4 positions"));
  EXPECT_EQ("", says(spoilt([](Trajectory& t) { t.velocities.pop_back(); }), "4 velocities"));
  EXPECT_EQ("", says(spoilt([](Trajectory& t) { t.accelerations.pop_back(); }), "4 acceler"));
  EXPECT_EQ("", says(spoilt([](Trajectory& t) { t.positions[2].resize(2); }), "sample 3"));
  EXPECT_EQ("", says(spoilt([](Trajectory& t) { t.positions[1][2] = NAN; }), "sample 2"));
  EXPECT_EQ("", says(spoilt([](Trajectory& t) { t.velocities[4][0] = INFINITY; }), "sample 5"));
  EXPECT_EQ("", says(spoilt([](Trajectory& t) { t.times[3] = t.times[2]; }), "sample 4"));
  EXPECT_EQ("", says(spoilt([](Trajectory& t) { t.times[1] = t.times[0] - 1; }), "sample 2"));
  EXPECT_EQ("", says(spoilt([](Trajectory& t) { t.times[0] = NAN; }), "sample 1"));
  EXPECT_EQ("", says(spoilt([](Trajectory& t) { t.times[4] = INFINITY; }), "sample 5"));
  EXPECT_EQ("", says(spoilt([](Trajectory& t) { t.joint_names[2] = t.joint_names[0]; }), "joint1"));
}

/// The trajectory without the columns that the interpolation does not use.
Trajectory with_interpolation(Trajectory trajectory, Interpolation interpolation) {
  if (interpolation != Interpolation::quintic) trajectory.accelerations.clear();
  if (interpolation == Interpolation::linear) trajectory.velocities.clear();
  return trajectory;
}

constexpr Interpolation interpolations[] = {Interpolation::linear, Interpolation::cubic,
                                            Interpolation::quintic};

TEST(Interpolation, IsThatOfTheColumns) {
  testing::Random random;
  const Trajectory trajectory = random_trajectory(random, built_in("rrr"), 3);
  for (const Interpolation kind : interpolations) {
    EXPECT_EQ(with_interpolation(trajectory, kind).interpolation(), kind);
    EXPECT_EQ(interpolation_named(name(kind)), kind);
  }
  EXPECT_REFUSED(interpolation_named("spline"), "linear, cubic, quintic");
  Trajectory bad = trajectory;
  bad.velocities.clear();
  EXPECT_REFUSED(check_trajectory(bad), "accelerations without velocities");
}

TEST(Sample, MeetsTheColumnsAtEverySampleFromBothSidesAndIsStillOutside) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  for (int i = 0; i < 100; ++i) {
    const Trajectory whole = random_trajectory(random, arm, random.integer(2, 9));
    for (const Interpolation kind : interpolations) {
      const Trajectory trajectory = with_interpolation(whole, kind);
      const auto& [names, times, q, v, a] = trajectory;
      for (std::size_t k = 0; k < q.size(); ++k) {
        for (const Side side : {Side::before, Side::after}) {
          const bool outside = side == Side::before ? k == 0 : k + 1 == q.size();
          const TrajectoryState state = sample(trajectory, times[k], side);
          ASSERT_LT((state.position - q[k]).norm(), 1e-12);
          if (outside) {
            ASSERT_EQ(state.velocity.norm(), 0);
          }
          if (!outside && !v.empty()) {
            ASSERT_LT((state.velocity - v[k]).norm(), 1e-9);
          }
          if (!outside && !a.empty()) {
            ASSERT_LT((state.acceleration - a[k]).norm(), 1e-6);
          }
        }
      }
      for (const double t : {double(times.front() - 1), -double(INFINITY)}) {
        ASSERT_EQ(sample(trajectory, t).position, q.front());
        ASSERT_EQ(sample(trajectory, t).velocity.norm(), 0);
      }
      for (const double t : {double(times.back() + 1), double(INFINITY)}) {
        ASSERT_EQ(sample(trajectory, t).position, q.back());
      }
    }
  }
  EXPECT_REFUSED(sample(at_rest(arm, Configuration::Zero(6)), NAN), "NaN");
  EXPECT_REFUSED(sample({}, 0), "no samples");
}

// Each derivative is the finite difference of the one before; the highest one of the polynomial is
// constant, so the next is zero.
TEST(Sample, IsAPolynomialBetweenSamples) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  for (int i = 0; i < 100; ++i) {
    const Trajectory whole = random_trajectory(random, arm, 3);
    for (const Interpolation kind : interpolations) {
      const Trajectory trajectory = with_interpolation(whole, kind);
      const double h = trajectory.times[1] - trajectory.times[0], dt = 1e-5 * h;
      const double t = trajectory.times[0] + random.uniform(0.1, 0.9) * h;
      const TrajectoryState before = sample(trajectory, t - dt), here = sample(trajectory, t);
      const TrajectoryState after = sample(trajectory, t + dt);
      const auto expect_derivative = [&](const Configuration& a, const Configuration& b,
                                         const Configuration& derivative) {
        ASSERT_LT(((b - a) / (2 * dt) - derivative).norm(), 1e-4 * (1 + derivative.norm()) / h);
      };
      expect_derivative(before.position, after.position, here.velocity);
      expect_derivative(before.velocity, after.velocity, here.acceleration);
      expect_derivative(before.acceleration, after.acceleration, here.jerk);
      if (kind == Interpolation::linear) {
        ASSERT_EQ(here.acceleration.norm(), 0);
      }
    }
  }
}

TEST(MatchedTo, BringsTheColumnsIntoTheArmsOrder) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Trajectory trajectory = random_trajectory(random, arm, 10);
  const std::vector<Eigen::Index> order{3, 0, 6, 1, 5, 2, 4};
  Trajectory shuffled = trajectory;
  for (std::size_t k = 0; k < order.size(); ++k) {
    shuffled.joint_names[k] = trajectory.joint_names[order[k]];
  }
  for (auto* column : {&shuffled.positions, &shuffled.velocities, &shuffled.accelerations}) {
    for (Configuration& q : *column) q = Configuration(q(order));
  }
  ASSERT_NE(shuffled.positions, trajectory.positions);
  const Trajectory back = matched_to(arm, shuffled);
  EXPECT_EQ(back.joint_names, trajectory.joint_names);
  EXPECT_EQ(back.times, trajectory.times);
  EXPECT_EQ(back.positions, trajectory.positions);
  EXPECT_EQ(back.velocities, trajectory.velocities);
  EXPECT_EQ(back.accelerations, trajectory.accelerations);
  shuffled.velocities.clear();
  shuffled.accelerations.clear();
  EXPECT_TRUE(matched_to(arm, shuffled).velocities.empty());
}

TEST(MatchedTo, NamesTheJointsThatAreMissingAndUnknown) {
  testing::Random random;
  const Arm arm = built_in("rrr");
  Trajectory trajectory = random_trajectory(random, arm, 3);
  trajectory.joint_names[1] = "elbow";
  EXPECT_REFUSED(matched_to(arm, trajectory), "lacks joint2");
  EXPECT_REFUSED(matched_to(arm, trajectory), "no elbow");
  const Trajectory longer = random_trajectory(random, built_in("puma560"), 3);
  EXPECT_REFUSED(matched_to(arm, longer), "no joint4, joint5, joint6");
  trajectory = random_trajectory(random, arm, 3);
  trajectory.positions[1].resize(1);
  EXPECT_REFUSED(matched_to(arm, trajectory), "sample 2");
  trajectory = random_trajectory(random, arm, 3);
  trajectory.joint_names.push_back("joint1");
  EXPECT_REFUSED(matched_to(arm, trajectory), "joint1");
}

/// The trajectory with other names.
Trajectory renamed(Trajectory trajectory, const std::vector<std::string>& names) {
  trajectory.joint_names = names;
  return trajectory;
}

/// The first list of names.
std::vector<std::string> joint_names_for_ros(const std::string& arm) {
  for (const BuiltInArm& about : built_in_arms()) {
    if (about.name == arm) return about.joint_names.at(0);
  }
  return {};
}

TEST(MatchedTo, KnowsTheNamesOfDescriptionsForRos) {
  testing::Random random;
  for (const BuiltInArm& about : built_in_arms()) {
    const Arm arm = built_in(about.name);
    const Trajectory trajectory = random_trajectory(random, arm, 3);
    for (const std::vector<std::string>& names : about.joint_names) {
      ASSERT_EQ(static_cast<int>(names.size()), arm.dof()) << about.name;
      const Trajectory found = matched_to(arm, renamed(trajectory, names));
      EXPECT_EQ(found.positions, trajectory.positions) << about.name;
      EXPECT_EQ(found.joint_names, arm.joint_names());
      std::vector<std::string> prefixed = names;
      for (std::string& name : prefixed) name = "left_" + name;
      EXPECT_EQ(matched_to(arm, renamed(trajectory, prefixed)).positions, trajectory.positions);
    }
  }
  // Another arm of the same name has its own names only.
  std::vector<Joint> joints = built_in("ur5e").joints();
  joints.front().name = "base";
  const Trajectory six = random_trajectory(random, built_in("ur5e"), 3);
  EXPECT_REFUSED(matched_to(Arm("ur5e", joints), renamed(six, joint_names_for_ros("ur5e"))),
                 "lacks base");
}

TEST(MatchedTo, TakesTheQuantitiesOfJointStates) {
  testing::Random random;
  const Arm arm = built_in("ur5e");
  const std::vector<std::string> ros = joint_names_for_ros("ur5e");
  Trajectory table{{}, {0, 1}, {Configuration(18), Configuration(18)}, {}, {}};
  for (const char* quantity : {"/velocity", "/position", "/effort"}) {
    for (int k = 5; k >= 0; --k) table.joint_names.push_back("/joint_states/" + ros[k] + quantity);
  }
  for (Configuration& q : table.positions) {
    for (double& value : q) value = random.uniform(-1, 1);
  }
  const Trajectory found = matched_to(arm, table);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(found.velocities[i], Configuration(table.positions[i].head(6).reverse()));
    EXPECT_EQ(found.positions[i], Configuration(table.positions[i].segment(6, 6).reverse()));
  }
  EXPECT_TRUE(found.accelerations.empty());
  table.joint_names[11] = "/joint_states/another/position";
  EXPECT_REFUSED(matched_to(arm, table), "does not fit arm ur5e");
}

TEST(MatchedTo, AppliesAJointMap) {
  testing::Random random;
  const Arm arm =
      Arm("three", {composite_joint('R', "r").front(), composite_joint('P', "p").front(),
                    composite_joint('R', "s").front()});
  const double degree = std::numbers::pi / 180;
  for (int i = 0; i < 100; ++i) {
    const Trajectory given = renamed(random_trajectory(random, arm, 4), {"x", "y", "z"});
    MatchOptions options{.joint_map = {{"z", -1, 30}, {"x", 1, 0, 1e-3}, {"y", -1, 0.5, 1}}};
    options.angle_unit = i % 2 == 0 ? 1 : degree;
    const Trajectory found = matched_to(arm, given, options);
    for (std::size_t k = 0; k < given.size(); ++k) {
      const Configuration &q = given.positions[k], &v = given.velocities[k];
      EXPECT_NEAR(found.positions[k][0], options.angle_unit * (30 - q[2]), 1e-12);
      EXPECT_NEAR(found.positions[k][1], q[0] / 1000, 1e-12);
      EXPECT_NEAR(found.positions[k][2], 0.5 - q[1], 1e-12);
      EXPECT_NEAR(found.velocities[k][0], -options.angle_unit * v[2], 1e-12);
      EXPECT_NEAR(found.velocities[k][1], v[0] / 1000, 1e-12);
      EXPECT_NEAR(found.accelerations[k][2], -given.accelerations[k][1], 1e-12);
    }
  }
  const Trajectory given = renamed(random_trajectory(random, arm, 4), {"x", "y", "z"});
  const auto mapped = [&](const JointMap& map) {
    return matched_to(arm, given, {.joint_map = map});
  };
  EXPECT_REFUSED(mapped({{"x"}, {"y"}}),
                 "the joint_map has 2 names; arm three needs 3, for r, p, s");
  EXPECT_REFUSED(mapped({{"x"}, {"y"}, {"zz"}}), "unknown joint of the joint_map \"zz\"");
  EXPECT_REFUSED(mapped({{"x"}, {"y"}, {"x"}}), "gives x to two joints");
  EXPECT_REFUSED(mapped({{"x", 2}, {"y"}, {"z"}}), "sign must be 1 or -1, not 2");
  EXPECT_REFUSED(mapped({{"x", 1, NAN}, {"y"}, {"z"}}), "offset must be finite");
  EXPECT_REFUSED(mapped({{"x", 1, 0, 0}, {"y"}, {"z"}}), "unit must be above 0");
}

}  // namespace
}  // namespace beeline
