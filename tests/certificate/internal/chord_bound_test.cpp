#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/certificate/internal/chord_bound.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>

#include <tests/path/random_segment.h>
#include <tests/random.h>
#include <tests/random_arm.h>
#include <tests/refusal.h>
#include <tests/typical_arms.h>

namespace beeline::internal {
namespace {

using std::numbers::pi;
using testing::turn_between;

constexpr int points = 20;  // at which a motion is evaluated between its ends

/// The largest distances from the chord at equal fractions.
ChordBound sampled(const Arm& arm, const Configuration& q_a, const Configuration& q_b) {
  const Pose from = forward_kinematics(arm, q_a), to = forward_kinematics(arm, q_b);
  ChordBound seen;
  Pose before = from;
  for (int i = 1; i <= points; ++i) {
    const double t = double(i) / points;
    const Pose pose = forward_kinematics(arm, q_a + t * (q_b - q_a));
    const Pose chord = interpolate(from, to, t);
    seen.position = std::max(seen.position, (pose.translation() - chord.translation()).norm());
    seen.orientation = std::max(seen.orientation, turn_between(pose, chord));
    seen.path_length += (pose.translation() - before.translation()).norm();
    seen.rotation += turn_between(pose, before);
    before = pose;
  }
  return seen;
}

Configuration random_step(testing::Random& random, const Arm& arm, double size) {
  Configuration step(arm.dof());
  for (double& part : step) part = random.uniform(-size, size);
  if (random.integer(0, 3) == 0) step[random.integer(0, arm.dof() - 1)] = 0;
  return step;
}

void expect_bound(testing::Random& random, const Arm& arm, std::vector<double>& tightness) {
  const double size = std::pow(10, random.uniform(-3, 0));
  const Configuration q_a = random.configuration(arm);
  const Configuration q_b = q_a + random_step(random, arm, size);
  const ChordBound seen = sampled(arm, q_a, q_b);
  const ChordBound bound = chord_bound(arm, q_a, q_b);
  const double slack = 1e-12 * (1 + bound.path_length);
  ASSERT_LE(seen.position, bound.position + slack) << arm.name() << " step " << size;
  ASSERT_LE(seen.orientation, bound.orientation + 1e-12) << arm.name() << " step " << size;
  ASSERT_LE(seen.path_length, bound.path_length + slack) << arm.name();
  ASSERT_LE(seen.rotation, bound.rotation + 1e-12) << arm.name();
  if (size < 0.1 && bound.position > 0) tightness.push_back(seen.position / bound.position);
}

TEST(ChordBound, HoldsForArmsOfAllJointsWithAxesAnywhere) {
  testing::Random random;
  std::vector<double> tightness;
  for (int i = 0; i < 6000; ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 9), random.integer(0, 3));
    expect_bound(random, arm, tightness);
  }
  std::sort(tightness.begin(), tightness.end());
  EXPECT_GT(tightness[tightness.size() / 2], 0.9);
}

TEST(ChordBound, HoldsForBuiltInArmsAndIsNotWasteful) {
  testing::Random random;
  for (const std::string& name : testing::typical_arms) {
    const Arm arm = built_in(name);
    std::vector<double> tightness;
    for (int i = 0; i < 500; ++i) expect_bound(random, arm, tightness);
    if (tightness.empty()) continue;  // nothing rotates
    std::sort(tightness.begin(), tightness.end());
    EXPECT_GT(tightness[tightness.size() / 2], 0.1) << name;
  }
}

TEST(ChordBound, HoldsForComposites) {
  testing::Random random;
  std::vector<double> tightness;
  for (int i = 0; i < 1000; ++i) {
    std::vector<Joint> joints;
    for (int part = random.integer(1, 3); part > 0; --part) {
      const char letter = std::string("RPHSUCE")[random.integer(0, 6)];
      auto more = composite_joint(letter, "j" + std::to_string(part), 0.2);
      more.front().offset = random.pose();
      joints.insert(joints.end(), more.begin(), more.end());
    }
    expect_bound(random, Arm("composite", joints, random.pose()), tightness);
  }
}

// A single revolute joint moves the tool on an arc, whose sagitta is r (1 - cos(dq/2)) with the
// first term r dq^2 / 8.
TEST(ChordBound, IsTheRiseOfTheArcForOneJoint) {
  testing::Random random;
  for (int i = 0; i < 200; ++i) {
    const double radius = random.uniform(0.1, 10), step = random.uniform(1e-3, 0.2);
    const Arm arm("arc", {planar_link(composite_joint('R', "j").front(), radius)});
    const Configuration q = random.configuration(arm);
    const ChordBound bound = chord_bound(arm, q, q + Configuration::Constant(1, step));
    const double rise = radius * (1 - std::cos(step / 2));
    ASSERT_GE(bound.position, rise);
    ASSERT_LE(bound.position, rise * (1 + step * step));
    ASSERT_NEAR(bound.path_length, radius * step, 1e-12);
    ASSERT_EQ(bound.orientation, 0);
  }
}

// Two joints at right angles: A = dq_1 dq_2, and the orientation deviates from the shortest
// rotation by A/8.
TEST(ChordBound, OfTheOrientationIsTightForAxesAtRightAngles) {
  std::vector<Joint> joints = composite_joint('U', "j");
  const Arm arm("universal", joints);
  for (const double step : {1e-3, 1e-2, 0.1}) {
    const Configuration q = Configuration::Zero(2);
    const Configuration q_b = Configuration::Constant(2, step);
    const ChordBound bound = chord_bound(arm, q, q_b);
    EXPECT_GT(sampled(arm, q, q_b).orientation / bound.orientation, 0.98);
  }
}

TEST(ChordBound, OfTheOrientationIsAtMostPi) {
  testing::Random random;
  for (int i = 0; i < 500; ++i) {
    const Arm arm = testing::random_arm(random, random.integer(2, 6));
    const Configuration q_a = random.configuration(arm);
    const Configuration q_b = q_a + random_step(random, arm, 3);
    const ChordBound bound = chord_bound(arm, q_a, q_b);
    ASSERT_LE(bound.orientation, pi);
    if (bound.rotation >= pi) {
      ASSERT_EQ(bound.orientation, pi);
    }
    ASSERT_LE(sampled(arm, q_a, q_b).orientation, bound.orientation + 1e-12);
  }
}

TEST(ChordBound, RefusesConfigurationsThatDoNotFit) {
  const Arm arm = built_in("rrr");
  const Configuration q = Configuration::Zero(3);
  EXPECT_REFUSED(chord_bound(arm, q, Configuration::Zero(2)), "3 joint values");
  EXPECT_REFUSED(chord_bound(arm, Configuration::Zero(4), q), "3 joint values");
  EXPECT_REFUSED(chord_bound(arm, q, Configuration::Constant(3, NAN)), "finite");
}

}  // namespace
}  // namespace beeline::internal
