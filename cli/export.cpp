#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>

#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/trajectory_file.h>
#include <beeline/kinematics/forward.h>

#include "arm_argument.h"
#include "budget_argument.h"
#include "format.h"
#include "json_reason.h"
#include "motion_report.h"
#include "program_argument.h"
#include "recording_argument.h"
#include "recover_argument.h"
#include "result_files.h"
#include "sampling_argument.h"
#include "scene_argument.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct ExportArguments {
  ArmArgument arm;
  LimitsArgument limits;
  UnitArgument unit;
  RecordingArgument recording;
  WorkArgument work;
  PathArgument path;
  std::string file, form, out, from;
  std::optional<double> rate, tool_speed;
  bool ignore_limits = false;
  double limit_tolerance = 0;
  RecoverArgument recover;
  SceneArgument scene;
  BudgetArgument budget;
  std::shared_ptr<std::string> command_line = std::make_shared<std::string>();
};

/// What is exported, and whether its motion keeps its limits and its clearance.
struct Exported {
  std::optional<ControllerFile> file = {};
  MotionStatus status = MotionStatus::reached;
  Reason reason = {};
  std::optional<ClearanceReport> clearance = std::nullopt;
};

/// Refuses a file name whose ending is not one of the form's.
void check_ending(ControllerForm form, const std::string& out) {
  const std::vector<std::string> endings = controller_file_endings(form);
  if (std::find(endings.begin(), endings.end(), extension(out)) != endings.end()) return;
  throw Error(fmt::format("--out: {} files end in .{}, not {}", name(form),
                          fmt::join(endings, ", ."), out));
}

ControllerFileOptions file_options(const ExportArguments& arguments, const Arm& arm) {
  ControllerFileOptions options{.rate = arguments.rate,
                                .ignore_limits = arguments.ignore_limits,
                                .limit_tolerance = arguments.limit_tolerance,
                                .recover = arguments.recover.read(arm, arguments.unit)};
  options.program_name = std::filesystem::path(arguments.out).stem().string();
  options.comments = extension(arguments.out) != "json";
  if (!arguments.work.text.empty()) options.work = arguments.work.read(arm, arguments.unit).pose;
  return options;
}

/// Whether the file, which is no pipe, is a program.
bool holds_program(const std::string& path) {
  constexpr std::size_t begin = 65536;  // the header is there, after comments
  InputFile file(path);
  return file.size() && is_program(file.peek(begin));
}

/// Throws Error for options that only programs have.
void check_trajectory_options(const ExportArguments& arguments) {
  const std::pair<const char*, bool> given[] = {{"--from", !arguments.from.empty()},
                                                {"--work", !arguments.work.text.empty()},
                                                {"--blend", arguments.path.blend.has_value()},
                                                {"--tool-speed", arguments.tool_speed.has_value()}};
  for (const auto& [option, used] : given) {
    if (used) throw Error(option + (" is for programs; " + arguments.file + " is a trajectory"));
  }
}

/// The comments of a file on the clearance that is proved for its motion.
std::vector<std::string> remarks_on(const ExportArguments& arguments,
                                    const ClearanceReport& clearance, const std::string& motion) {
  const SceneArgument& scene = arguments.scene;
  std::vector<std::string> others;
  if (!scene.scenes.empty()) others.push_back("from the obstacles of " + listed(scene.scenes));
  if (!scene.no_self) others.emplace_back("between the links");
  const std::string proved =
      clearance.checks_nothing()
          ? "nothing was checked, as no pair of bodies counts"
          : fmt::format("proved {} for {}; {}", clearance.when(), motion, clearance.guarantee());
  std::vector<std::string> remarks{
      fmt::format("Clearance of {} m{} {}: {}", number(clearance.clearance),
                  clearance.scene->obstacles_have_clearances ? ", or an obstacle's own," : "",
                  fmt::join(others, " and "), proved)};
  std::vector<SceneLine> lines = clearance.recovery();
  for (SceneLine& line : clearance.conditions()) lines.push_back(std::move(line));
  for (SceneLine& line : lines) {
    line.label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(line.label[0])));
    remarks.push_back(line.label + ": " + line.text);
  }
  remarks.push_back("Repeat this proof: " + *arguments.command_line);
  return remarks;
}

/// Proves that the motion of a file keeps its clearance, and adds that to the comments.
void prove_clearance_of(Exported& exported, const ExportArguments& arguments,
                        const CheckedScene& scene, const Trajectory& trajectory,
                        const std::string& motion, ControllerFileOptions& options,
                        const FollowedProgram* followed = nullptr) {
  const Budget budget = arguments.budget.next();
  exported.clearance = followed != nullptr
                           ? arguments.scene.prove(scene, trajectory, *followed, budget)
                           : arguments.scene.prove(scene, trajectory, budget);
  if (exported.clearance->proof) {
    options.remarks = remarks_on(arguments, *exported.clearance, motion);
    return;
  }
  exported.status = exported.clearance->refusal();
  exported.reason = exported.clearance->proof.reason;
}

/// A message of ROS is proved as it is played; of other forms the motion is proved from which their
/// samples are taken.
Exported trajectory_export(const ExportArguments& arguments, const Arm& arm,
                           const CheckedScene* scene, ControllerForm form) {
  check_trajectory_options(arguments);
  const Trajectory trajectory =
      arguments.recording.read_unwrapped(arguments.file, arm, arguments.unit).trajectory;
  ControllerFileOptions options = file_options(arguments, arm);
  Exported exported{.file = controller_file(arm, trajectory, form, options)};
  if (!*exported.file) {
    return {.status = MotionStatus::outside_limits, .reason = exported.file->reason};
  }
  if (scene == nullptr) return exported;
  if (form == ControllerForm::ros2) {
    const Trajectory played = parse_recording(exported.file->text, arguments.out, arm).trajectory;
    prove_clearance_of(exported, arguments, *scene, played, "the motion of this message", options);
  } else {
    prove_clearance_of(exported, arguments, *scene, trajectory,
                       "the motion of " + arguments.file + ", from which these samples are taken",
                       options);
  }
  exported.file.reset();
  if (exported.clearance->proof) exported.file = controller_file(arm, trajectory, form, options);
  return exported;
}

Exported program_export(const ExportArguments& arguments, const Arm& arm, const CheckedScene* scene,
                        ControllerForm form) {
  const TaskArgument spatial{"spatial"};
  std::optional<Configuration> start;
  if (!arguments.from.empty()) {
    start = arguments.arm.configuration(arm, arguments.from, "--from", arguments.unit);
  }
  const Program program =
      program_from(read_file(arguments.file), arguments.file, arm,
                   {arguments.arm, spatial, arguments.work, arguments.unit}, arguments.path,
                   start ? std::optional(forward_kinematics(arm, *start)) : std::nullopt);
  check_scene_to_plan(program, arguments.file, scene != nullptr);
  PathMotionOptions options{.task = spatial.read(arm), .budget = arguments.budget.next()};
  if (arguments.tool_speed) options.tool_speed = *arguments.tool_speed;
  const bool recovers = arguments.recover.given(), ignores = arguments.ignore_limits;
  const bool leads_out = arguments.scene.recover_clearance.value_or(0) > 0;
  if (ignores || arguments.limit_tolerance > 0 || recovers || leads_out) {
    throw Error(std::string(ignores                         ? "--ignore-limits"
                            : arguments.limit_tolerance > 0 ? "--limit-tolerance"
                            : recovers                      ? "--recover"
                                                            : "--recover-clearance") +
                " is for trajectories; " + arguments.file +
                " is a program, which is planned within the limits");
  }
  return at_rows(program, arguments.file, [&] {
    check_controller_form(arm, program, form);
    const ProgramMotion motion =
        move_program(arm, start, program, options, scene != nullptr ? &scene->model : nullptr);
    Exported exported{.status = motion.status, .reason = motion.reason};
    ControllerFileOptions file = file_options(arguments, arm);
    if (motion && scene != nullptr) {
      FollowedProgram followed{.program = program, .file = arguments.file};
      for (const PlannedMove& move : motion.moves) followed.arrivals.push_back(move.end);
      prove_clearance_of(exported, arguments, *scene, motion.trajectory, "the planned motion", file,
                         &followed);
    }
    if (exported.status == MotionStatus::reached) {
      exported.file = controller_file(arm, program, motion, form, file);
    }
    return exported;
  });
}

Answer failed_export(const Exported& exported) {
  Answer answer{.text = name(exported.status) + ": nothing is exported\n",
                .document = {{"status", name(exported.status)}},
                .yes = false,
                .reason = sentence(exported.reason)};
  answer.document.add(json_reason(exported.reason));
  if (!exported.clearance) return answer;
  answer.text += exported.clearance->text();
  answer.document.add("clearance", exported.clearance->document());
  answer.reason = exported.clearance->reason_text();
  return answer;
}

Answer export_file(const ExportArguments& arguments) {
  const ControllerForm form = controller_form_named(arguments.form);
  check_ending(form, arguments.out);
  std::vector<std::string> inputs = arguments.scene.inputs();
  inputs.push_back(arguments.file);
  refuse_overwriting(arguments.out, arguments.arm.inputs(inputs));
  const Arm arm = arguments.limits.set_on(arguments.arm.read(arguments.unit), arguments.unit);
  check_controller_form(arm, form);
  const std::optional<CheckedScene> scene = arguments.scene.read(arguments.arm, arm);
  const bool program = holds_program(arguments.file);
  const Exported exported = (program ? program_export : trajectory_export)(
      arguments, arm, scene ? &*scene : nullptr, form);
  if (!exported.file) return failed_export(exported);
  const ControllerFile& file = *exported.file;
  write_file(arguments.out, file.text);
  std::string text =
      fmt::format("exported      {} in {} s, as {}\nguaranteed    {}\n",
                  counted(static_cast<std::int64_t>(file.samples), program ? "move" : "sample"),
                  shown(file.duration), name(form), file.proof);
  for (const std::string& limits : file.not_proved) text += "not proved    " + limits + "\n";
  Answer answer{.text = std::move(text),
                .document = {{"status", "exported"},
                             {"form", name(form)},
                             {program ? "moves" : "samples", file.samples},
                             {"duration", file.duration},
                             {"proof", file.proof},
                             {"not_proved", file.not_proved},
                             {"note", file.note},
                             {"out", arguments.out}},
                .text_on_stderr = true};
  if (!file.note.empty()) answer.text += fmt::format("note          {}\n", file.note);
  if (exported.clearance) {
    answer.text += exported.clearance->text();
    answer.document.add("clearance", exported.clearance->document());
  }
  answer.text += fmt::format("file          {}\n", arguments.out);
  return answer;
}

/// Options of the plan of a program.
std::vector<Option> program_options(ExportArguments& arguments) {
  return {joint_values_option(
              "--from", "Joint values at the start of a program. Default: its first waypoint.",
              &arguments.from, {"start"}),
          arguments.work.option(), arguments.path.options()[1],
          tool_speed_option(&arguments.tool_speed, "; of a program, in moves without a speed"),
          arguments.budget.time_limit_option()};
}

std::vector<Option> export_options(ExportArguments& arguments) {
  return {
      Option("--as FORM",
             "The form: a ROS 2 message, a program of Universal Robots, ABB or KUKA, or setpoints.",
             &arguments.form, {.required = true, .choices = controller_form_names()}),
      Option("--out FILE",
             "The file: .yaml or .json (ros2), .script (urscript), .mod or .modx (rapid), .src "
             "(krl), .csv. Programs of rapid and krl have its name.",
             &arguments.out, {.required = true}),
      rate_option(&arguments.rate,
                  fmt::format(", of the motion that the trajectory's columns mean. Default: the "
                              "trajectory's own samples; for urscript {}, which CB3 and e-Series "
                              "keep (e-Series up to 500). csv requires it.",
                              default_urscript_rate)),
      Option("--ignore-limits",
             "Write a trajectory that exceeds limits of the arm too; the file says which.",
             &arguments.ignore_limits),
      limit_tolerance_option(&arguments.limit_tolerance),
      arguments.recover.option(
          "Accept a trajectory that starts slightly outside the position limits and returns, as "
          "`beeline check` does; the file says until when.")};
}

constexpr const char* export_description =
    "Writes a trajectory for a controller, from time 0 at its first sample, and prints on "
    "stderr which guarantees hold on the controller and what is not proved; comments in the "
    "file say the same. Samples outside the position limits are refused; a ros2 message also "
    "where it exceeds limits of velocity, acceleration or jerk that the arm has, and the exit "
    "code is 1. Limits that the arm does not have are named, not assumed.\n\n"
    "ros2: the message trajectory_msgs/JointTrajectory, which a joint_trajectory_controller "
    "plays as the trajectory's columns mean, so the limits hold at all times. urscript: a program "
    "of servoj() setpoints, which the controller interpolates and filters. rapid: MoveAbsJ "
    "instructions; krl: PTP instructions: their controllers plan the motion between the "
    "samples again. csv: setpoints at a constant rate. Programs need an arm of six revolute "
    "joints in the controller's order, zeros and directions.\n\n"
    "A program, a .csv file with a column motion (see `beeline help line`), is planned and "
    "certified, then written as moves of urscript (movej, movel, movec), rapid (MoveAbsJ, "
    "MoveL, MoveC) or krl (PTP, LIN, CIRC, SPLINE): the order and the waypoints are exact, "
    "and the controller plans the motions between them again. Poses are in the controller's "
    "root frame (the base of Universal Robots, wobj0 of ABB, $ROBROOT of KUKA), which "
    "--mount moves with the arm; with --work they are in that frame, which the file states "
    "in the root frame. The file sets the tool of --tcp (set_tcp, tooldata, $TOOL), not its "
    "load. Built-in arms of these makers know their root frame; of others the world of the "
    "arm's description is assumed: a .json arm states another as controller_base, a URDF "
    "file as its link base.\n\n"
    "With --scene or --self the motion must keep a clearance, see `beeline help check`; "
    "otherwise nothing is written, and the status is collides or not_decided. A ros2 message "
    "is proved as it is played, of other forms the motion from which their setpoints are "
    "taken, of a program the planned motion. Comments in the file name the scenes, the "
    "clearance, the pairs that may touch, held joints, links without shapes, and the command "
    "that repeats the proof.\n\n"
    "With --rate the last sample is up to one period later than the trajectory's. Files are "
    "in radians and metres, files of rapid and krl in degrees; --degrees applies to --tcp "
    "and --mount, and to recordings with an angle more than a revolution outside its limits "
    "in radians.";

}  // namespace

Verb export_verb() {
  const auto arguments = std::make_shared<ExportArguments>();
  return {.name = "export",
          .summary = "Write a trajectory or a program in the form that a robot's controller takes",
          .description = export_description,
          .arguments = {arguments->arm.argument(),
                        file_argument(
                            "FILE",
                            "A trajectory of the arm, .csv, .json or .yaml, or a program, .csv.",
                            &arguments->file)},
          .options = joined({export_options(*arguments), program_options(*arguments),
                             arguments->recording.options(), arguments->unit.options(),
                             arguments->scene.options(), arguments->arm.options(),
                             arguments->limits.options()}),
          .examples =
              {{"A motion of a UR5e for ROS 2, and as a program of its controller",
                "beeline move ur5e --from 0,-1.5,1.5,0,0,0 --to 0.5,-1,1,0,0.3,0 --method quickest "
                "--out move.csv\n"
                "beeline export ur5e move.csv --as ros2 --out move.yaml\n"
                "beeline export ur5e move.csv --as urscript --rate 500 --out move.script"},
               {"A sample every 0.1 s, as instructions of ABB",
                "beeline export ur5e move.csv --as rapid --rate 10 --out move.mod"},
               {"A pick as a program of Universal Robots: down to a pose, 0.5 s there, and back",
                "printf "
                "'motion,relative,x,y,z,roll,pitch,yaw,speed,dwell\\njoint,next,0,0,-0.1,0,0,0,,\\n"
                "line,,-0.4,-0.3,0.2,180,0,0,0.1,0.5\\nline,previous,0,0,-0.1,0,0,0,0.25,\\n' > "
                "pick.csv\n"
                "beeline export ur5e pick.csv --from 30,-60,80,-110,-90,0 --degrees --as urscript "
                "--out pick.script"}},
          .command_line = arguments->command_line,
          .run = [arguments] { return export_file(*arguments); }};
}

}  // namespace beeline::command
