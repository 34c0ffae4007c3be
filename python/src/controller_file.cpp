#include <algorithm>

#include <beeline/io/text/file.h>
#include <beeline/io/trajectory_file.h>

#include "bindings.h"
#include "program_fields.h"

namespace beeline::python {

template <>
struct Fields<ControllerFileOptions>
    : Members<&ControllerFileOptions::rate, &ControllerFileOptions::program_name,
              &ControllerFileOptions::work, &ControllerFileOptions::remarks,
              &ControllerFileOptions::comments, &ControllerFileOptions::ignore_limits,
              &ControllerFileOptions::limit_tolerance, &ControllerFileOptions::recover> {};

template <>
struct Fields<ControllerFile>
    : Members<&ControllerFile::text, &ControllerFile::proof, &ControllerFile::not_proved,
              &ControllerFile::note, &ControllerFile::samples, &ControllerFile::duration,
              &ControllerFile::reason> {};

namespace {

void bind_controller_file(nb::module_& m) {
  Signature of_trajectory("controller_file", "ControllerFile",
                          "Returns the trajectory in the form that a controller takes, from time 0 "
                          "at its first sample. Raises Error for a trajectory that does not fit "
                          "the arm or that the form cannot hold. One that exceeds limits of the "
                          "arm is refused: the file is false, and its reason says why.");
  of_trajectory.overloaded()
      .summary_has_motions()
      .takes_arm()
      .takes("trajectory", "Trajectory", "Its joints are matched by name.")
      .choice<ControllerForm>("form", "")
      .options<ControllerFileOptions>();
  define(
      m,
      [](const Arm& arm, const Trajectory& trajectory, nb::handle form,
         const nb::kwargs& keywords) {
        return controller_file(arm, trajectory, Value<ControllerForm>::from(form, "form"),
                               options<ControllerFileOptions>(keywords));
      },
      of_trajectory, nb::arg("arm"), nb::arg("trajectory"), nb::arg("form"), nb::arg("keywords"));
  Signature of_program(
      "controller_file", "ControllerFile",
      "Returns a planned program as moves for a controller, which plans all motions again.");
  of_program.takes_arm()
      .takes("program", "Program", "Program.")
      .takes("motion", "ProgramMotion", "What move_program() returned for it.")
      .choice<ControllerForm>("form", "")
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
        if (!self) throw Error("nothing is saved: " + sentence(self.reason));
        write_file(path_from(path, "path"), self.text);
      },
      save, nb::arg("path"));
  Signature endings("controller_file_endings", "list[str]",
                    "Returns the endings of the form's files; the first is the default.");
  endings.choice<ControllerForm>("form", "");
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
