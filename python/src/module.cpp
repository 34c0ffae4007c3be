#include <beeline/error.h>

#include "bindings.h"
#include "numpy_arrays.h"

namespace beeline::python {

NB_MODULE(_core, module) {
  import_numpy();
  nb::exception<Error> error(module, "Error", PyExc_ValueError);
  error.attr("__doc__") =
      "Invalid input. The message names the culprit, its value, and the "
      "accepted range or choices.";
  nb::exception<FileError> file_error(module, "FileError", error);
  file_error.attr("__doc__") =
      "Invalid input in a file. The message begins with its path and line.";
  module.attr("__version__") = BEELINE_VERSION;
  bind_poses(module);
  bind_arms(module);
  bind_kinematics(module);
  bind_trajectories(module);
}

}  // namespace beeline::python
