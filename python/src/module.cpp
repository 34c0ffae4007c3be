#include <beeline/error.h>

#include "bindings.h"
#include "interruption.h"
#include "numpy_arrays.h"
#include "warning_category.h"

#include <nanobind/stl/string.h>

namespace beeline::python {
namespace {

/// What `from beeline._core import *` imports: every public name.
nb::list public_names(const nb::module_& module) {
  nb::list names;
  for (const auto& [name, value] : nb::borrow<nb::dict>(PyModule_GetDict(module.ptr()))) {
    if (!nb::cast<std::string>(name).starts_with('_')) names.append(name);
  }
  names.attr("sort")();
  return names;
}

}  // namespace

NB_MODULE(_core, module) {
  import_numpy();
  nb::exception<Error> error(module, "Error", PyExc_ValueError);
  error.attr("__doc__") =
      "Invalid input. The message names the culprit, its value, and the accepted range or choices.";
  nb::exception<FileError> file_error(module, "FileError", error);
  file_error.attr("__doc__") =
      "Invalid input in a file. The message begins with its path and line.";
  module.attr("ModelWarning") = model_warning();
  module.attr("InputWarning") = input_warning();
  module.attr("__version__") = BEELINE_VERSION;
  bind_poses(module);
  bind_arms(module);
  bind_random_configurations(module);
  bind_kinematics(module);
  bind_derivatives(module);
  bind_tasks(module);
  bind_inverse(module);
  bind_trajectories(module);
  bind_paths(module);
  bind_joint_paths(module);
  bind_timing(module);
  bind_certificates(module);
  bind_collisions(module);
  bind_distances(module);
  bind_planning(module);
  bind_pose_lists(module);
  bind_programs(module);
  bind_clearances(module);
  bind_free_paths(module);
  bind_controller_files(module);
  bind_control(module);
  bind_pids(module);
  bind_servos(module);
  bind_players(module);
  bind_trackers(module);
  bind_formulas(module);
  bind_doctor(module);
  bind_reach(module);
  bind_pictures(module);
  bind_command_line(module);
  bind_exit(module);  // after the exceptions: the last translator is asked first
  module.attr("__all__") = public_names(module);
}

}  // namespace beeline::python
