#include <gtest/gtest.h>
#include <numbers>

#include <beeline/io/internal/recorded_units.h>
#include <beeline/model/catalog.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// A motion between two configurations within the limits.
Trajectory random_motion(testing::Random& random, const Arm& arm) {
  Trajectory motion{arm.joint_names(), {}, {}, {}, {}};
  const Configuration a = random.configuration(arm), b = random.configuration(arm);
  for (int k = 0; k < 50; ++k) {
    motion.times.push_back(k);
    motion.positions.push_back(a + (b - a) * k / 50);
    motion.velocities.push_back((b - a) / 50);
  }
  return motion;
}

Trajectory scaled(Trajectory motion, const Arm& arm, JointKind of, double factor) {
  for (auto* column : {&motion.positions, &motion.velocities}) {
    for (Configuration& q : *column) {
      for (int k = 0; k < arm.dof(); ++k) {
        if (kind(arm.joint_of(k)) == of) q[k] *= factor;
      }
    }
  }
  return motion;
}

TEST(RecordedUnits, DegreesAreRecognisedAndRadiansAreNot) {
  testing::Random random;
  for (const char* name : {"panda", "ur5e", "scara", "kr6_r900"}) {
    const Arm arm = built_in(name);
    int recognised = 0;
    for (int i = 0; i < 50; ++i) {
      const Trajectory motion = random_motion(random, arm);
      ASSERT_FALSE(evidence_of_degrees(arm, motion, {})) << name;
      Trajectory recorded = scaled(motion, arm, JointKind::revolute, 1 / degree);
      const auto evidence = evidence_of_degrees(arm, recorded, {});
      recognised += evidence.has_value();
      recorded = matched_to(arm, recorded, {.angle_unit = degree});
      for (std::size_t k = 0; k < motion.size(); ++k) {
        ASSERT_LT((recorded.positions[k] - motion.positions[k]).norm(), 1e-12);
        ASSERT_LT((recorded.velocities[k] - motion.velocities[k]).norm(), 1e-12);
      }
    }
    EXPECT_EQ(recognised, 50) << name;
  }
}

TEST(RecordedUnits, AnglesWithAUnitInTheJointMapDoNotCount) {
  testing::Random random;
  const Arm arm = built_in("ur5e");
  JointMap map;
  for (const std::string& name : arm.joint_names()) map.push_back({.name = name, .unit = 1});
  Trajectory recorded = scaled(random_motion(random, arm), arm, JointKind::revolute, 1 / degree);
  EXPECT_FALSE(evidence_of_degrees(arm, recorded, map));
  const Trajectory read = matched_to(arm, recorded, {.joint_map = map, .angle_unit = degree});
  EXPECT_EQ(read.positions, recorded.positions);
}

/// ur5e, or another arm, without the limits of positions, and with 3 rad/s.
Arm without_position_limits(const Arm& arm) {
  std::vector<Joint> joints = arm.joints();
  for (Joint& joint : joints) joint.limits = {.velocity = 3};
  return {arm.name(), joints};
}

TEST(RecordedUnits, DegreesOfJointsWithoutLimitsAreRecognised) {
  testing::Random random;
  const Arm arm = built_in("ur5e"), free = without_position_limits(arm);
  int recognised = 0;
  for (int i = 0; i < 50; ++i) {
    const Configuration a = random.configuration(arm) / 2, b = random.configuration(arm) / 2;
    Trajectory motion{free.joint_names(), {}, {}, {}, {}};
    for (int k = 0; k <= 20; ++k) {
      motion.times.push_back(0.2 * k);
      motion.positions.push_back(a + (b - a) * k / 20);
    }
    EXPECT_FALSE(evidence_of_revolutions(free, motion, {}, true));
    const Trajectory recorded = scaled(motion, free, JointKind::revolute, 1 / degree);
    EXPECT_FALSE(evidence_of_degrees(free, recorded, {})) << "its limits are not known";
    const auto evidence = evidence_of_revolutions(free, recorded, {}, true);
    recognised += evidence.has_value();
    if (!evidence) continue;
    EXPECT_GT(std::abs(evidence->value), 4 * std::numbers::pi);
    JointMap map;
    for (const std::string& name : free.joint_names())
      map.push_back({.name = name, .unit = degree});
    EXPECT_FALSE(evidence_of_revolutions(free, recorded, map, true));
  }
  EXPECT_GT(recognised, 45);
}

TEST(RecordedUnits, ASpindleIsNotTakenForDegrees) {
  const Arm arm = without_position_limits(built_in("rrr"));
  Trajectory motion{arm.joint_names(), {}, {}, {}, {}};
  for (int k = 0; k < 100; ++k) {  // from 0, within 3 rad/s, to 297 rad
    motion.times.push_back(k);
    motion.positions.push_back(Configuration::Constant(3, 2.99 * k));
  }
  EXPECT_FALSE(evidence_of_revolutions(arm, motion, {}, true));
  motion.times.back() += 1;
  motion.positions.back().setConstant(400);
  EXPECT_FALSE(evidence_of_revolutions(arm, motion, {}, true))
      << "more than a revolution in degrees";
  Trajectory wrapped{arm.joint_names(), {0, 0.1}, {}, {}, {}};
  wrapped.positions = {Configuration::Constant(3, 3.1), Configuration::Constant(3, -3.1)};
  EXPECT_FALSE(evidence_of_revolutions(arm, wrapped, {}, true));
}

TEST(RecordedUnits, MillimetresAreRecognised) {
  testing::Random random;
  const Arm arm = built_in("scara");
  for (int i = 0; i < 50; ++i) {
    const Trajectory motion = random_motion(random, arm);
    EXPECT_FALSE(evidence_of_millimetres(arm, motion, {}));
    const auto evidence =
        evidence_of_millimetres(arm, scaled(motion, arm, JointKind::prismatic, 1000), {});
    ASSERT_TRUE(evidence);
    EXPECT_EQ(evidence->coordinate, 3);
  }
}

TEST(RecordedUnits, MillisecondsAreRecognisedByTheSlowness) {
  testing::Random random;
  const Arm arm = built_in("panda");
  for (int i = 0; i < 50; ++i) {
    Trajectory motion = random_motion(random, arm);
    for (double& time : motion.times) time *= 0.05;
    EXPECT_FALSE(evidence_of_milliseconds(arm, motion));
    for (double& time : motion.times) time *= 1000;
    EXPECT_NEAR(evidence_of_milliseconds(arm, motion).value_or(0), 50, 1e-9);
    for (Configuration& q : motion.positions) q = motion.positions.front();
    EXPECT_FALSE(evidence_of_milliseconds(arm, motion)) << "at rest";
  }
}

}  // namespace
}  // namespace beeline::internal
