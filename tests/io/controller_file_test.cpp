#include <cmath>
#include <gtest/gtest.h>

#include <beeline/io/internal/setpoints.h>
#include <beeline/io/internal/trajectory_json.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/trajectory_file.h>
#include <beeline/model/catalog.h>
#include <beeline/trajectory/limit_usage.h>

#include <tests/degrees.h>
#include <tests/io/random_trajectory.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::deg;

TEST(ControllerFile, FormsHaveNames) {
  for (const std::string& form : controller_form_names()) {
    EXPECT_EQ(name(controller_form_named(form)), form);
    EXPECT_FALSE(controller_file_endings(controller_form_named(form)).empty());
  }
  EXPECT_REFUSED(controller_form_named("rapit"), "did you mean \"rapid\"?");
}

TEST(ControllerFile, IsReadInRadiansAndSecondsWhateverItsCommentsName) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  const Trajectory trajectory =
      testing::in_nanoseconds(testing::random_trajectory(random, arm.joint_names()));
  for (const ControllerForm form : {ControllerForm::csv, ControllerForm::ros2}) {
    const ControllerFile file = controller_file(
        arm, trajectory, form,
        {.rate = form == ControllerForm::csv ? std::optional(100.) : std::nullopt,
         .remarks = {"Clearance of the motion of angles in degrees.csv", "May touch: units=mm",
                     "Repeat this proof: beeline export --angle-unit deg "
                     "--time-unit ms data_deg.csv"},
         .ignore_limits = true});
    const std::string path = form == ControllerForm::csv ? "a.csv" : "a.yaml";
    const Recording read = parse_recording(file.text, path, arm);
    EXPECT_TRUE(read.notes.empty()) << file.text.substr(0, 600);
    const Trajectory without = parse_trajectory(file.text, path);
    ASSERT_EQ(read.trajectory.size(), file.samples);
    EXPECT_EQ(read.trajectory.times.back(), without.times.back());
    EXPECT_EQ(read.trajectory.positions.back(), without.positions.back());
    EXPECT_NEAR(read.trajectory.times.back(), file.duration, 1e-9);
    // Who converts the numbers and says so below is believed.
    const std::size_t last = file.text.find("data_deg.csv\n");
    std::string converted = file.text;
    converted.insert(last + std::string("data_deg.csv\n").size(), "# units: deg\n");
    const Recording degrees = parse_recording(converted, path, arm);
    EXPECT_NEAR(degrees.trajectory.positions.back()[0], read.trajectory.positions.back()[0] * deg,
                1e-12);
  }
}

TEST(ControllerFile, RosMessagesReadBackToTheLastBit) {
  testing::Random random;
  const Arm arm = built_in("puma560");
  for (int i = 0; i < testing::cases(600); ++i) {
    Trajectory trajectory =
        testing::in_nanoseconds(testing::random_trajectory(random, arm.joint_names()));
    if (trajectory.velocities.empty()) trajectory.accelerations.clear();
    const ControllerFile file = controller_file(arm, trajectory, ControllerForm::ros2,
                                                {.comments = false, .ignore_limits = true});
    const Trajectory read = internal::trajectory_from_json(file.text, "a");
    ASSERT_TRUE(testing::same(read, internal::from_time_zero(trajectory))) << i;
    EXPECT_EQ(file.samples, trajectory.size());
    EXPECT_EQ(file.duration, read.times.back());
    EXPECT_TRUE(file);
  }
}

TEST(ControllerFile, EveryFormStatesItsProof) {
  const Arm arm = built_in("ur5");
  const Trajectory still = at_rest(arm, Configuration::Zero(6));
  for (const std::string& form : controller_form_names()) {
    const ControllerFile file =
        controller_file(arm, still, controller_form_named(form), {.rate = 100});
    EXPECT_NE(file.text.find(file.proof), std::string::npos) << form;
    EXPECT_NE(file.text.find(file.note), std::string::npos) << form;
    EXPECT_FALSE(file.not_proved.empty()) << form;
    for (const std::string& text : file.not_proved) {
      EXPECT_NE(file.text.find("Not proved: " + text), std::string::npos) << form;
    }
    EXPECT_EQ(file.samples, 1u);
  }
}

// verify() and the file agree, whatever the trajectory is: random polynomials between
// random samples of an arm with random limits.
TEST(ControllerFile, LimitsAreGuaranteedIfAndOnlyIfTheyAreProved) {
  testing::Random random;
  int refused = 0, guaranteed = 0;
  for (int i = 0; i < testing::cases(300); ++i) {
    const double scale = std::pow(10, random.uniform(0, 1));
    const bool has_velocity = random.integer(0, 1) == 0;
    const Arm arm = with_limits(arm_from_joint_string("RR:1,1"),
                                {{"joint1",
                                  {.lower = -1.0,
                                   .upper = 1.0,
                                   .velocity = has_velocity ? std::optional(scale) : std::nullopt}},
                                 {"joint2", {.lower = -1.0, .upper = 1.0, .velocity = scale}}});
    Trajectory trajectory{arm.joint_names(), {}, {}, {}, {}};
    const double size = random.uniform(0.5, 1.1);
    for (int k = 0; k < 4; ++k) {
      trajectory.times.push_back(k);
      trajectory.positions.push_back(
          Configuration{{random.uniform(-size, size), random.uniform(-size, size)}});
      trajectory.velocities.push_back(
          Configuration{{random.uniform(-1, 1), random.uniform(-1, 1)}});
    }
    const Arm known =
        has_velocity ? arm : with_limits(arm, {{"joint1", {.velocity = Limits::max_rate}}});
    const LimitUsage used = limit_usage(known, trajectory);
    const bool outside = used.position.fraction > 1, fast = used.velocity.fraction > 1 + 1e-6;
    const ControllerFile file = controller_file(arm, trajectory, ControllerForm::ros2);
    ASSERT_EQ(!file, outside || fast) << file.reason;
    EXPECT_EQ(file.text.empty(), outside || fast);
    const ControllerFile csv = controller_file(arm, trajectory, ControllerForm::csv, {.rate = 1});
    EXPECT_EQ(!csv, outside) << csv.reason;
    refused += file ? 0 : 1;
    if (!file) continue;
    const std::string limits =
        has_velocity ? "the limits of position and velocity at" : "the limits of position at";
    EXPECT_TRUE(file.proof.starts_with(limits)) << file.proof;
    ++guaranteed;
  }
  EXPECT_GT(refused, testing::cases(300) / 20);
  EXPECT_GT(guaranteed, testing::cases(300) / 20);
}

TEST(ControllerFile, LimitsThatAreIgnoredAreNamed) {
  const Arm arm = built_in("ur5");
  Trajectory trajectory = at_rest(arm, Configuration::Zero(6));
  trajectory.positions.front()[2] = 7;  // beyond 2 pi
  const ControllerFile refused = controller_file(arm, trajectory, ControllerForm::urscript);
  EXPECT_FALSE(refused);
  EXPECT_EQ(refused.reason.code, ReasonCode::outside_limits);
  EXPECT_EQ(refused.text, "");
  const ControllerFile file =
      controller_file(arm, trajectory, ControllerForm::urscript, {.ignore_limits = true});
  EXPECT_TRUE(file);
  EXPECT_TRUE(file.not_proved.front().starts_with("limits of position: ")) << file.text;
  EXPECT_EQ(file.proof.find("limits of position"), std::string::npos);
  EXPECT_REFUSED(
      controller_file(arm, trajectory, ControllerForm::urscript, {.limit_tolerance = 0.2}),
      "limit_tolerance");
}

TEST(ControllerFile, WhatAFormCannotHoldIsRefused) {
  const Arm ur5 = built_in("ur5"), panda = built_in("panda");
  const Trajectory still = at_rest(ur5, Configuration::Zero(6));
  EXPECT_REFUSED(
      controller_file(panda, at_rest(panda, Configuration::Zero(7)), ControllerForm::krl),
      "krl programs need six revolute joints; the arm has 7");
  EXPECT_REFUSED(controller_file(panda, still, ControllerForm::ros2), "joint7");
  EXPECT_REFUSED(controller_file(ur5, still, ControllerForm::csv),
                 "csv setpoints need the rate in samples per second");
  EXPECT_REFUSED(controller_file(ur5, still, ControllerForm::rapid, {.rate = 0.0}),
                 "must be 0.001 samples per second or above, not 0");
  EXPECT_REFUSED(controller_file(ur5, still, ControllerForm::rapid, {.program_name = "a b"}),
                 "\"a b\" cannot name a program of RAPID");
  EXPECT_REFUSED(
      controller_file(ur5, Trajectory{ur5.joint_names(), {}, {}, {}, {}}, ControllerForm::ros2),
      "the trajectory has no samples");
}

}  // namespace
}  // namespace beeline
