#include <gtest/gtest.h>
#include <numbers>

#include <beeline/io/text/arm.h>
#include <beeline/model/catalog.h>

#include <tests/io/text/limits_samples.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline {
namespace {

using Texts = std::vector<std::string>;

JointLimits from_yaml(const std::string& text, const Arm& arm = built_in("panda")) {
  return joint_limits_from_text(text, "l.yaml", arm);
}

/// Of joint1 with these lines.
LimitOverrides joint1(const std::string& lines) {
  return from_yaml("joint_limits:\n  joint1: {" + lines + "}").joints.at("joint1");
}

Arm ur() {
  std::vector<Joint> joints = built_in("ur5").joints();
  const char* names[] = {"shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint",
                         "wrist_1_joint",      "wrist_2_joint",       "wrist_3_joint"};
  for (std::size_t i = 0; i < joints.size(); ++i) {
    joints[i].name = names[i];
    joints[i].limits.acceleration = 40;
  }
  return {"ur", joints};
}

TEST(JointLimits, OfMoveItReplaceWhatTheFileSays) {
  const JointLimits file = from_yaml(testing::panda_limits);
  ASSERT_EQ(file.joints.size(), 3u);
  const Arm panda = built_in("panda"), arm = with_limits(panda, file.joints);
  EXPECT_EQ(arm.limits(0).velocity, 2);
  EXPECT_EQ(arm.limits(0).acceleration, 3.75);
  EXPECT_EQ(arm.limits(0).jerk, Limits::none);
  EXPECT_EQ(arm.limits(0).upper, panda.limits(0).upper);
  EXPECT_EQ(arm.limits(1).velocity, 1.5);
  EXPECT_EQ(arm.limits(1).acceleration, 3.75);
  EXPECT_EQ(arm.limits(2).acceleration, Limits::none);
  EXPECT_EQ(arm.limits(2).jerk, panda.limits(2).jerk);
  EXPECT_EQ(arm.limits(2).lower, panda.limits(2).lower);
  EXPECT_EQ(arm.limits(2).upper, 2.5);
  EXPECT_EQ(arm.limits(3).velocity, panda.limits(3).velocity);
  EXPECT_EQ(
      file.notes,
      (Texts{"l.yaml: default_velocity_scaling_factor 0.1 is not applied; set a speed scale "
             "instead",
             "l.yaml: default_acceleration_scaling_factor 0.1 is not applied; set a speed scale "
             "instead",
             "l.yaml: arm panda does not have hand_joint1, hand_joint2",
             "l.yaml: has_jerk_limits is false, so no limit is known: joint1, joint2",
             "l.yaml: has_acceleration_limits is false, so no limit is known and max_acceleration "
             "is ignored: joint3"}));
}

TEST(JointLimits, OfUniversalRobotsAreInDegrees) {
  const JointLimits file = from_yaml(testing::ur_limits, ur());
  const Arm arm = with_limits(ur(), file.joints);
  constexpr double pi = std::numbers::pi;
  EXPECT_DOUBLE_EQ(arm.limits(0).lower, -2 * pi);
  EXPECT_DOUBLE_EQ(arm.limits(0).upper, 2 * pi);
  EXPECT_DOUBLE_EQ(arm.limits(0).velocity, pi);
  EXPECT_EQ(arm.limits(0).acceleration, Limits::none);
  EXPECT_DOUBLE_EQ(arm.limits(2).upper, pi);
  EXPECT_EQ(arm.limits(2).acceleration, 8);
  EXPECT_EQ(arm.limits(5).lower, -Limits::none);
  EXPECT_EQ(arm.limits(5).upper, Limits::none);
  EXPECT_DOUBLE_EQ(arm.limits(5).velocity, 2 * pi);
  EXPECT_EQ(file.notes,
            (Texts{"l.yaml: has_acceleration_limits is false, so no limit is known: "
                   "shoulder_pan_joint",
                   "l.yaml: has_position_limits is false, so there are none: wrist_3_joint"}));
}

TEST(JointLimits, MayBeNestedAsParametersOfNodes) {
  const JointLimits file = from_yaml(testing::ros_limits);
  EXPECT_EQ(file.joints.at("joint1").velocity, 1);
  EXPECT_EQ(file.joints.at("joint2").lower, -1);
  EXPECT_EQ(file.joints.at("joint2").jerk, 1000);
  EXPECT_FALSE(file.joints.at("joint2").velocity);
  EXPECT_EQ(file.notes.size(), 1u);
}

TEST(JointLimits, MayHaveTheKeysOfUrdf) {
  const std::string text = R"(joint1:
  limit:
    lower:   -2.7
    upper:    2.5
    velocity: 2.62
    effort:  87.0
joint2: {limit: {velocity: !degrees 180}}
gripper_joint1: {limit: {velocity: 1}}
)";
  const JointLimits file = from_yaml(text);
  EXPECT_EQ(file.joints.at("joint1").lower, -2.7);
  EXPECT_EQ(file.joints.at("joint1").upper, 2.5);
  EXPECT_EQ(file.joints.at("joint1").velocity, 2.62);
  EXPECT_EQ(file.joints.at("joint2").velocity, std::numbers::pi);
  EXPECT_EQ(file.notes, (Texts{"l.yaml: arm panda does not have gripper_joint1"}));
  EXPECT_REFUSED(from_yaml("joint1:\n limit:\n  velocity: x"),
                 "l.yaml:3: joint1.limit.velocity: \"x\" is not a limit");
  EXPECT_REFUSED(from_yaml("joint1: {limit: {max: 1}}"), "joint1.limit: unknown key \"max\"");
  EXPECT_REFUSED(from_yaml("joint1: {limit: {lower: 2, upper: 1}}"), "lower limit 2 exceeds");
}

TEST(JointLimits, MayHaveAllJointsWithOnePrefix) {
  const Arm arm = built_in("rrr");
  const std::string left = "a_joint1: {max_jerk: 1}, a_joint2: {max_jerk: 2}, a_joint3: {}";
  const JointLimits file = from_yaml("joint_limits: {" + left + ", a_finger: {}}", arm);
  EXPECT_EQ(file.joints.size(), 3u);
  EXPECT_EQ(file.joints.at("joint2").jerk, 2);
  EXPECT_EQ(file.notes, (Texts{"l.yaml: the prefix a_ of joint names is left out",
                               "l.yaml: arm rrr does not have a_finger"}));
  EXPECT_REFUSED(
      from_yaml("joint_limits: {" + left + ", b_joint1: {}, b_joint2: {}, b_joint3: {}}", arm),
      "has no joint of arm rrr");
  EXPECT_EQ(from_yaml("joint_limits: {" + left + ", joint1: {}}", arm).joints.size(), 1u);
}

TEST(JointLimits, MayBeJson) {
  const Arm arm = built_in("rrr");
  const std::string text = R"({"joint1": {"velocity": 2, "lower": -1}, "joint3": {"jerk": 5}})";
  for (const char* path : {"l.json", "l", "/dev/stdin"}) {
    const JointLimits file = joint_limits_from_text("\n " + text, path, arm);
    EXPECT_EQ(file.joints.at("joint1").velocity, 2);
    EXPECT_EQ(file.joints.at("joint1").lower, -1);
    EXPECT_FALSE(file.joints.at("joint1").upper);
    EXPECT_EQ(file.joints.at("joint3").jerk, 5);
    EXPECT_TRUE(file.notes.empty());
  }
  const auto json = [&](const std::string& words) {
    return joint_limits_from_text(words, "l.json", arm);
  };
  EXPECT_REFUSED(json("{\n\"joint4\": {}}"), "l.json:2: unknown key \"joint4\"");
  EXPECT_REFUSED(json("{\"joint1\":\n{\"max_velocity\": 1}}"), "l.json:2: joint1: unknown key");
  EXPECT_REFUSED(json("{\"joint1\": {\"jerk\": -1}}"), "joint1.jerk must be at least 1e-09");
  EXPECT_REFUSED(json("{\"joint1\": {\"jerk\": \"3\"}}"), "must be a number, not text");
  EXPECT_REFUSED(json("{\"joint1\": {\"lower\": 3, \"upper\": 2}}"), "lower 3 exceeds upper 2");
  EXPECT_REFUSED(json("[1]"), "must be an object, not a list");
}

TEST(JointLimits, AreReadFromAFile) {
  const testing::TemporaryFolder folder;
  const std::string path = folder.write("limits.yml", testing::panda_limits);
  EXPECT_EQ(read_joint_limits(path, built_in("panda")).joints.size(), 3u);
  EXPECT_REFUSED(read_joint_limits(folder.file("none.yaml"), built_in("panda")), "none.yaml");
}

TEST(JointLimits, ReadNumbersAndTruthsOfYaml) {
  EXPECT_EQ(joint1("max_velocity: 3").velocity, 3);
  EXPECT_EQ(joint1("max_velocity: +.5e1").velocity, 5);
  EXPECT_EQ(joint1("max_velocity: !!float 3").velocity, 3);
  EXPECT_EQ(joint1("max_velocity: 3, has_velocity_limits: TRUE").velocity, 3);
  EXPECT_EQ(joint1("max_velocity: 3, has_velocity_limits: off").velocity, Limits::none);
  EXPECT_EQ(joint1("max_acceleration: 3, max_deceleration: -2").acceleration, 2);
  EXPECT_EQ(joint1("max_acceleration: 3, max_deceleration: 4").acceleration, 3);
  EXPECT_EQ(joint1("max_deceleration: 4").acceleration, 4);
  EXPECT_EQ(joint1("max_velocity: 3, min_velocity: -2").velocity, 2);
  EXPECT_EQ(joint1("max_acceleration: 3, min_acceleration: -4, max_deceleration: 5").acceleration,
            3);
  EXPECT_EQ(from_yaml("v: &v 1.25\njoint_limits: {joint1: {max_velocity: *v}}")
                .joints.at("joint1")
                .velocity,
            1.25);
  EXPECT_EQ(joint1("max_acceleration: 3, max_deceleration: 0, has_deceleration_limits: false")
                .acceleration,
            3);
  EXPECT_EQ(from_yaml("joint_limits:\n joint1:\n  has_velocity_limits: true").notes.front(),
            "l.yaml: has_velocity_limits is true without max_velocity, so the arm's own limit "
            "stays: joint1");
}

TEST(JointLimits, NoLimitHasManySpellings) {
  for (const std::string number : {".inf", "inf", ".Inf", "1e999", "1e16", "3.4e38", "1.8e308"}) {
    const LimitOverrides limits = joint1("max_velocity: " + number + ", min_position: -" + number +
                                         ", max_position: " + number + ", max_jerk: " + number);
    EXPECT_EQ(limits.velocity, Limits::none) << number;
    EXPECT_EQ(limits.jerk, Limits::none) << number;
    EXPECT_EQ(limits.lower, -Limits::none) << number;
    EXPECT_EQ(limits.upper, Limits::none) << number;
  }
}

TEST(JointLimits, RefuseBadValuesWithLineAndKey) {
  const auto refused_for = [](const std::string& value, const std::string& why) {
    EXPECT_REFUSED(from_yaml("joint_limits:\n  joint1:\n    max_velocity: " + value),
                   "l.yaml:3: joint_limits.joint1.max_velocity" + why);
  };
  refused_for("-1", " must be at least 1e-09, not -1");
  refused_for("0", " must be at least 1e-09, not 0");
  refused_for(".nan", ": \".nan\" is not a limit; a limit is a number, or inf for none");
  refused_for("-NaN", ": \"-NaN\" is not a limit");
  refused_for("-.inf", " must be at least 1e-09, not -inf");
  refused_for("fast", ": \"fast\" is not a limit; a limit is a number, or inf for none");
  refused_for("0x10", ": \"0x10\" is not a number");
  refused_for("\"2.5\"", " must be a number, not text in quotes");
  refused_for("[1, 2]", " must be a number, not a list or a map");
  refused_for("", ": a number is missing");
  refused_for("!inches 3", " has the unknown tag \"!inches\"; known are !degrees, !radians");
  EXPECT_REFUSED(joint1("has_velocity_limits: 1"), "has_velocity_limits must be true or false");
  EXPECT_REFUSED(joint1("has_velocity_limits: \"true\""), "must be true or false");
  EXPECT_REFUSED(joint1("max_velocty: 1"), "joint_limits.joint1: unknown key \"max_velocty\"");
  EXPECT_REFUSED(joint1("max_velocty: 1"), "did you mean \"max_velocity\"");
  EXPECT_REFUSED(joint1("min_position: 2, max_position: 1"),
                 "min_position 2 exceeds max_position 1");
  EXPECT_REFUSED(joint1("min_position: 3"), "l.yaml: joint 1 (joint1): lower limit 3 exceeds");
  EXPECT_REFUSED(joint1("max_deceleration: 0"), "max_deceleration must not be 0");
  const Arm slide = arm_from_joint_string("P:1");
  EXPECT_REFUSED(from_yaml("joint_limits: {joint1: {max_velocity: !degrees 3}}", slide),
                 "max_velocity is in degrees, but the joint is prismatic");
}

TEST(JointLimits, RefuseOtherLayouts) {
  EXPECT_REFUSED(from_yaml(""), "l.yaml: has no key joint_limits");
  EXPECT_REFUSED(from_yaml("joint1: {max_velocity: 2}"), "has no key joint_limits");
  EXPECT_REFUSED(from_yaml("joint_limits: [1]"), "l.yaml:1: joint_limits must be a map of joints");
  EXPECT_REFUSED(from_yaml("joint_limits:\n"), "joint_limits must be a map of joints");
  EXPECT_REFUSED(from_yaml("joint_limits: {joint1: [2]}"), "joint1 must be a map such as");
  EXPECT_REFUSED(from_yaml("joint_limits: {a: {}}\nb:\n  joint_limits: {}"),
                 "l.yaml:3: joint_limits is given twice, here and in line 1");
  EXPECT_REFUSED(from_yaml("joint_limits: {left_joint1: {max_velocity: 2}}"),
                 "has no joint of arm panda (joint1, joint2,");
  EXPECT_REFUSED(from_yaml("joint_limits: {left_joint1: {}}"), "its joints are left_joint1");
}

}  // namespace
}  // namespace beeline
