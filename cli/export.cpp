#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

#include <beeline/error.h>
#include <beeline/read/internal/file.h>
#include <beeline/record/trajectory_file.h>

#include "arm_argument.h"
#include "format.h"
#include "input_files.h"
#include "result_files.h"
#include "verbs.h"

using namespace beeline;

namespace {

struct ExportArguments {
  ArmArgument arm;
  UnitArgument unit;
  std::string file, form, out;
  std::optional<double> rate;
  bool json = false;
};

/// Refuses a file name whose ending is not one of the form's.
void check_ending(ControllerForm form, const std::string& out) {
  const std::vector<std::string> endings = controller_file_endings(form);
  if (std::find(endings.begin(), endings.end(), internal::extension(out)) != endings.end()) return;
  throw Error(fmt::format("--out: {} files end in .{}, not {}", name(form),
                          fmt::format("{}", fmt::join(endings, ", .")), out));
}

ControllerFileOptions file_options(const ExportArguments& arguments) {
  ControllerFileOptions options{.rate = arguments.rate};
  options.program = std::filesystem::path(arguments.out).stem().string();
  options.comments = internal::extension(arguments.out) != "json";
  return options;
}

Answer export_file(const ExportArguments& arguments) {
  const ControllerForm form = controller_form_named(arguments.form);
  check_ending(form, arguments.out);
  refuse_overwriting(arguments.out, {arguments.arm.text, arguments.arm.srdf, arguments.arm.limits,
                                     arguments.file});
  const Arm arm = arguments.arm.read(arguments.unit);
  const Trajectory trajectory = read_recording(arguments.file, arm);
  const ControllerFile file = controller_file(arm, trajectory, form, file_options(arguments));
  internal::write_file(arguments.out, file.text);
  Answer answer{.text = fmt::format("exported      {} in {} s, as {}\nproof holds   for {}\n",
                                    counted(static_cast<std::int64_t>(file.samples), "sample"),
                                    shown(file.duration), name(form), file.proof),
                .document = {{"status", "exported"},
                             {"form", name(form)},
                             {"samples", file.samples},
                             {"duration", file.duration},
                             {"proof", file.proof},
                             {"note", file.note},
                             {"out", arguments.out}},
                .text_on_stderr = true};
  if (!file.note.empty()) answer.text += fmt::format("note          {}\n", file.note);
  answer.text += fmt::format("file          {}\n", arguments.out);
  return answer;
}

std::vector<Option> export_options(ExportArguments& arguments) {
  return {{.name = "--as",
           .value = "FORM",
           .help = "The form: a ROS 2 message, a program of Universal Robots, ABB or KUKA, or "
                   "setpoints.",
           .target = &arguments.form,
           .required = true,
           .choices = controller_form_names()},
          {.name = "--out",
           .value = "FILE",
           .help = "The file: .yaml or .json (ros2), .script (urscript), .mod or .modx (rapid), "
                   ".src (krl), .csv. Programs of rapid and krl have its name.",
           .target = &arguments.out,
           .required = true,
           .completes = Completes::file},
          {.name = "--rate",
           .value = "HZ",
           .help = "Samples per second, of the motion that the trajectory's columns mean. Default: "
                   "the trajectory's own samples; for urscript 125, which CB3 and e-Series keep "
                   "(e-Series up to 500). csv requires it.",
           .target = &arguments.rate,
           .range = above_zero,
           .phrases = {"the rate", "need a rate"}}};
}

}  // namespace

Verb export_verb() {
  static ExportArguments arguments;
  return {
      .name = "export",
      .summary = "Write a trajectory in the form that a robot's controller takes",
      .description =
          "Writes a trajectory for a controller, from time 0 at its first sample, and prints on "
          "stderr what of a proof (`beeline check`) holds there; the file says it in comments.\n\n"
          "ros2: the message trajectory_msgs/JointTrajectory, which a joint_trajectory_controller "
          "plays as the trajectory's columns mean: everything proved holds. urscript: a program of "
          "servoj() setpoints, which the controller interpolates and filters. rapid: MoveAbsJ "
          "instructions; krl: PTP instructions: their controllers plan the motion between the "
          "samples again. csv: setpoints at a constant rate. Programs need an arm of six revolute "
          "joints in the controller's order, zeros and directions.\n\n"
          "With --rate the last sample is up to one period later than the trajectory's. Files are "
          "in radians and metres, those of "
          "rapid and krl in degrees; --degrees applies to --tcp and --mount.",
      .arguments = {arguments.arm.argument(),
                    trajectory_argument("FILE", "A trajectory of the arm, .csv or .json.",
                                        &arguments.file)},
      .options =
          joined({export_options(arguments), arguments.unit.options(), arguments.arm.options()}),
      .examples =
          {{"A motion of a UR5e for ROS 2, and as a program of its controller",
            "beeline move ur5e --from 0,-1.5,1.5,0,0,0 --to 0.5,-1,1,0,0.3,0 --method quickest "
            "--out move.csv\n"
            "beeline export ur5e move.csv --as ros2 --out move.yaml\n"
            "beeline export ur5e move.csv --as urscript --rate 500 --out move.script"},
           {"A sample every 0.1 s, as instructions of ABB",
            "beeline export ur5e move.csv --as rapid --rate 10 --out move.mod"}},
      .json = &arguments.json,
      .run = [] { return export_file(arguments); }};
}
