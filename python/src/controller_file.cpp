#include <algorithm>

#include <beeline/io/text/file.h>
#include <beeline/io/trajectory_file.h>

#include "bindings.h"
#include "program_fields.h"

namespace beeline::python {

template <>
std::vector<ControllerForm> choices() {
  return {ControllerForm::ros2, ControllerForm::urscript, ControllerForm::rapid,
          ControllerForm::krl, ControllerForm::csv};
}

template <>
struct Fields<ControllerFileOptions> {
  using T = ControllerFileOptions;
  static constexpr const char* name = "ControllerFileOptions";
  static constexpr auto all() {
    return std::tuple(
        field("rate", &T::rate,
              "Setpoints per second; None: the trajectory's own samples; of urscript 125. csv "
              "requires it."),
        field("program_name", &T::program_name, "The name of a rapid or krl program."),
        field("work", &T::work,
              "The frame in which the poses of a program are written: its pose in the world "
              "(4, 4); None: the controller's root frame."),
        field("comments", &T::comments, "False for ros2 as JSON, which has none."));
  }
};

template <>
struct Fields<ControllerFile> {
  static constexpr const char* name = "ControllerFile";
  static constexpr const char* doc = "A motion in the form that a controller takes.";
  static constexpr auto all() {
    return std::tuple(
        field("text", &ControllerFile::text, "Content, with `proof` and `note` as comments."),
        field("proof", &ControllerFile::proof,
              "Which part of a proof about the trajectory holds for the controller."),
        field("note", &ControllerFile::note, "What the user must ensure; may be empty."),
        field("samples", &ControllerFile::samples, "Number of setpoints or moves."),
        field("duration", &ControllerFile::duration, "s."));
  }
};

namespace {

void bind_controller_file(nb::module_& m) {
  constexpr const char* form_doc =
      "`ros2`: trajectory_msgs/JointTrajectory as YAML or JSON; `urscript`: servoj() setpoints; "
      "`rapid`: MoveAbsJ instructions; `krl`: PTP instructions; `csv`: setpoints at a constant "
      "rate.";
  Signature of_trajectory("controller_file", "ControllerFile",
                          "Returns the trajectory in the form that a controller takes, from time 0 "
                          "at its first sample. Raises Error for a trajectory that does not fit "
                          "the arm or that the form cannot hold.");
  of_trajectory.summary_has_motions()
      .takes("arm", "Arm", "The arm.")
      .takes("trajectory", "Trajectory", "Its joints are matched by name.")
      .takes("form", Value<ControllerForm>::type(), form_doc)
      .options<ControllerFileOptions>();
  define(
      m,
      [](const Arm& arm, const Trajectory& trajectory, nb::handle form,
         const nb::kwargs& keywords) {
        return controller_file(arm, trajectory, Value<ControllerForm>::from(form, "form"),
                               options<ControllerFileOptions>(keywords));
      },
      of_trajectory, nb::arg("arm"), nb::arg("trajectory"), nb::arg("form"), nb::arg("keywords"));
  Signature of_program("controller_file", "ControllerFile",
                       "Returns a planned program as moves for a controller, which plans all "
                       "motions again.");
  of_program.takes("arm", "Arm", "The arm.")
      .takes("program", "Program", "Program.")
      .takes("motion", "ProgramMotion", "What move_program() returned for it.")
      .takes("form", Value<ControllerForm>::type(), form_doc)
      .options<ControllerFileOptions>();
  define(
      m,
      [](const Arm& arm, const Program& program, const ProgramMotion& motion, nb::handle form,
         const nb::kwargs& keywords) {
        return controller_file(arm, program, motion, Value<ControllerForm>::from(form, "form"),
                               options<ControllerFileOptions>(keywords));
      },
      of_program, nb::arg("arm"), nb::arg("program"), nb::arg("motion"), nb::arg("form"),
      nb::arg("keywords"));
}

}  // namespace

void bind_controller_files(nb::module_& m) {
  nb::class_<ControllerFile> file = bind_record<ControllerFile>(m);
  Signature save("save", "None", "Writes the text to a file, which is replaced as a whole.");
  save.takes("self").takes("path", path_like, "Path.");
  define(
      file,
      [](const ControllerFile& self, nb::handle path) {
        write_file(path_from(path, "path"), self.text);
      },
      save, nb::arg("path"));
  Signature endings("controller_file_endings", "list[str]",
                    "Returns the endings of the form's files; the first is the default.");
  endings.takes("form", Value<ControllerForm>::type(), "Form.");
  define(
      m,
      [](nb::handle form) {
        return Value<std::vector<std::string>>::to(
            controller_file_endings(Value<ControllerForm>::from(form, "form")));
      },
      endings, nb::arg("form"));
  bind_controller_file(m);
}

}  // namespace beeline::python
