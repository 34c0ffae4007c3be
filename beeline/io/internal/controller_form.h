#pragma once

#include <beeline/io/trajectory_file.h>

namespace beeline::internal {

/// Properties of a form that do not depend on the trajectory.
struct FormDescription {
  ControllerForm form;
  std::vector<std::string> endings;
  bool six_axes;  ///< of a program for an arm of six revolute joints
};

const std::vector<FormDescription>& controller_forms();

/// Throws Error unless the form can hold a motion of this arm, and at this rate.
void check_arm_in(const FormDescription& form, const Arm& arm);
void check_rate_in(const FormDescription& form, const std::optional<double>& rate);

/// Returns ControllerFile::note.
std::string note_on_form(const FormDescription& form, const Trajectory& samples);

}  // namespace beeline::internal
