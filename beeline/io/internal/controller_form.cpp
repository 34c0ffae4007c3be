#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/io/internal/controller_form.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/trajectory/internal/sample_rate.h>

namespace beeline::internal {
const std::vector<FormDescription>& controller_forms() {
  static const std::vector<FormDescription> forms{
      {ControllerForm::ros2, {"yaml", "yml", "json"}, false},
      {ControllerForm::urscript, {"script"}, true},
      {ControllerForm::rapid, {"mod", "modx"}, true},
      {ControllerForm::krl, {"src"}, true},
      {ControllerForm::csv, {"csv"}, false}};
  return forms;
}

void check_arm_in(const FormDescription& form, const Arm& arm) {
  if (!form.six_axes) return;
  const std::string needed = name(form.form) + " programs need six revolute joints; ";
  for (const Joint& joint : arm.joints()) {
    const bool revolute = kind(joint) == JointKind::revolute;
    if (revolute && !joint.mimic) continue;
    throw Error(needed + "joint " + in_quotes(joint.name) +
                (revolute ? " follows " + in_quotes(joint.mimic->leader) : " is not revolute"));
  }
  if (arm.dof() != 6) throw Error(needed + "the arm has " + std::to_string(arm.dof()));
}

void check_rate_in(const FormDescription& form, const std::optional<double>& rate) {
  if (form.form == ControllerForm::csv && !rate) {
    throw Error("csv setpoints need the ", "rate", " in samples per second");
  }
  if (rate) check_rate(*rate);
  const double cycles = rate ? 500 / *rate : 4;
  if (form.form == ControllerForm::urscript &&
      !(cycles > 0.5 && std::abs(cycles - std::round(cycles)) <= 1e-9 * cycles)) {
    throw Error::of(
        "rate",
        "the rate of servoj setpoints must be 500 / n Hz, such as 500, 250, 125 or 100, not " +
            number(*rate) + ": each lasts n control cycles of 2 ms (CB3 series: 8 ms, 125 / n)");
  }
}

std::string note_on_form(const FormDescription& form, const Trajectory& samples) {
  if (form.form == ControllerForm::ros2) {
    const bool moves_at_end = !samples.velocities.empty() && !samples.velocities.back().isZero(0);
    return std::string("the arm must be at the first sample when the controller starts") +
           (moves_at_end ? "; it moves at the last sample, which the controller refuses unless its "
                           "parameter allow_nonzero_velocity_at_trajectory_end is true"
                         : "");
  }
  if (!form.six_axes) return "";
  return "joints " + listed(samples.joint_names) +
         " are the controller's axes 1 to 6: the zeros and directions must agree; the motion to "
         "the "
         "first sample is not part of the proof";
}

}  // namespace beeline::internal
