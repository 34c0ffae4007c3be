#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/io/internal/controller_form.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/trajectory/internal/sample_rate.h>

namespace beeline::internal {
namespace {

/// Whether all times are doubles nearest to whole nanoseconds, as ROS holds them.
bool in_whole_nanoseconds(const Trajectory& trajectory) {
  return std::all_of(trajectory.times.begin(), trajectory.times.end(),
                     [](double time) { return std::round(time * 1e9) / 1e9 == time; });
}

std::string polynomials(const Trajectory& trajectory) {
  if (trajectory.velocities.empty()) return "straight lines";
  return trajectory.accelerations.empty() ? "cubic polynomials" : "quintic polynomials";
}

std::string ros2_proof(const Trajectory& samples, bool resampled) {
  const std::string plays =
      "a joint_trajectory_controller with its default interpolation method plays the " +
      polynomials(samples) + " between these points";
  if (resampled) {
    return "the samples; " + plays +
           ", which differ from the trajectory's; `beeline check` of a .json export proves them";
  }
  if (!in_whole_nanoseconds(samples)) {
    return "all except the rounding of times to nanoseconds; " + plays +
           "; `beeline check` of a .json export proves them";
  }
  return "all; " + plays + ", the same motion as the trajectory";
}

}  // namespace

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

std::string proof_in_form(ControllerForm form, const Trajectory& samples, bool resampled) {
  switch (form) {
    case ControllerForm::ros2:
      return ros2_proof(samples, resampled);
    case ControllerForm::urscript:
      return "the setpoints; the controller interpolates and filters them (lookahead_time, gain), "
             "and follows with a delay";
    case ControllerForm::rapid:
      return "only the positions of the samples; the controller plans the motion between "
             "them again and rounds those at which it does not stop (zone z1)";
    case ControllerForm::krl:
      return "only the positions of the samples; the controller plans the motion between "
             "them again, at 10 % speed, and rounds those with C_PTP";
    case ControllerForm::csv:
      return "the setpoints; the motion between them is the controller's";
  }
  return "";
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
