#include <gtest/gtest.h>

#include <beeline/model/catalog.h>
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

TEST(Sample, IsLinearBetweenSamplesAndStillOutside) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  for (int i = 0; i < 200; ++i) {
    const Trajectory trajectory = random_trajectory(random, arm, random.integer(2, 9));
    const auto& q = trajectory.positions;
    const auto& times = trajectory.times;
    for (std::size_t k = 0; k < q.size(); ++k) ASSERT_EQ(sample(trajectory, times[k]), q[k]);
    for (std::size_t k = 1; k < q.size(); ++k) {
      const double share = random.uniform(0, 1);
      const double t = times[k - 1] + share * (times[k] - times[k - 1]);
      const Configuration expected = (1 - share) * q[k - 1] + share * q[k];
      ASSERT_LT((sample(trajectory, t) - expected).norm(), 1e-10);
    }
    ASSERT_EQ(sample(trajectory, times.front() - 1), q.front());
    ASSERT_EQ(sample(trajectory, times.back() + 1), q.back());
    ASSERT_EQ(sample(trajectory, -INFINITY), q.front());
    ASSERT_EQ(sample(trajectory, INFINITY), q.back());
  }
  EXPECT_REFUSED(sample(at_rest(arm, Configuration::Zero(6)), NAN), "NaN");
  EXPECT_REFUSED(sample({}, 0), "no samples");
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

}  // namespace
}  // namespace beeline
