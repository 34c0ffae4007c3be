#include <gtest/gtest.h>

#include <beeline/io/internal/setpoints.h>
#include <beeline/io/internal/trajectory_json.h>
#include <beeline/io/trajectory_file.h>
#include <beeline/model/catalog.h>

#include <tests/io/random_trajectory.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

TEST(ControllerFile, FormsHaveNames) {
  for (const std::string& form : controller_form_names()) {
    EXPECT_EQ(name(controller_form_named(form)), form);
    EXPECT_FALSE(controller_file_endings(controller_form_named(form)).empty());
  }
  EXPECT_REFUSED(controller_form_named("rapit"), "did you mean \"rapid\"?");
}

TEST(ControllerFile, RosMessagesReadBackToTheLastBit) {
  testing::Random random;
  const Arm arm = built_in("puma560");
  for (int i = 0; i < 200; ++i) {
    Trajectory trajectory =
        testing::in_nanoseconds(testing::random_trajectory(random, arm.joint_names()));
    if (trajectory.velocities.empty()) trajectory.accelerations.clear();
    const ControllerFile file =
        controller_file(arm, trajectory, ControllerForm::ros2, {.comments = false});
    const Trajectory read = internal::trajectory_from_json(file.text, "a");
    ASSERT_TRUE(testing::same(read, internal::from_time_zero(trajectory))) << i;
    EXPECT_EQ(file.samples, trajectory.size());
    EXPECT_EQ(file.duration, read.times.back());
    EXPECT_TRUE(file.proof.starts_with("all; ")) << file.proof;
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
    EXPECT_EQ(file.samples, 1u);
  }
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
