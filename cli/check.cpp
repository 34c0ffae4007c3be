#include <fmt/format.h>
#include <memory>

#include <beeline/certificate/verify.h>
#include <beeline/draw/figure.h>
#include <beeline/draw/timing_figure.h>
#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/kinematics/forward.h>
#include <beeline/trajectory/limit_usage.h>

#include "arm_argument.h"
#include "budget_argument.h"
#include "command/streams.h"
#include "fault_report.h"
#include "format.h"
#include "json_reason.h"
#include "motion_report.h"
#include "path_argument.h"
#include "pose_argument.h"
#include "program_argument.h"
#include "recording_argument.h"
#include "recover_argument.h"
#include "result_files.h"
#include "scene_argument.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct CheckArguments {
  ArmArgument arm;
  LimitsArgument limits;
  std::string file, through, plot;
  RecordingArgument recording;
  UnitArgument unit;
  TaskArgument task;
  WorkArgument work;
  PathArgument path;
  VerifyOptions verify;
  RecoverArgument recover;
  SceneArgument scene;
  BudgetArgument budget;
};

/// What was found about a file.
struct CheckedMotion {
  Verification verification;
  std::vector<Pose> waypoints = {};  ///< of a file of poses
  std::size_t count = 0;             ///< of waypoints or moves
  bool program = false;
  bool has_path = true;  ///< false: without --through
  LimitUsage limits = {};
  std::optional<ClearanceReport> clearance = std::nullopt;
  Program moves = {};  ///< of a program

  /// The program with the moves that are in the trajectory.
  FollowedProgram followed(const std::string& file) const {
    return {moves, file, verification.arrivals};
  }
  /// Whether parts are attached at waypoints of which some are not in the trajectory.
  bool has_unknown_parts() const {
    return !moves.attachments.empty() && verification.arrivals.size() < moves.moves.size();
  }

  bool passed() const { return verification && (!clearance || clearance->proof); }
};

/// Plots the motion with its limits, and its deviation from the path up to the last sample on it.
void write_check_plot(const CheckArguments& arguments, const Arm& arm, const Trajectory& trajectory,
                      const CheckedMotion& checked, const CheckedScene* scene,
                      const VerifyOptions& options) {
  const Deviation tolerance{options.tolerance, options.orientation_tolerance};
  const Verification& verification = checked.verification;
  TimingFigureOptions plot;
  if (checked.program) {
    for (const std::size_t k : verification.arrivals) {
      plot.waypoint_times.push_back(trajectory.times[k]);
    }
  } else if (checked.has_path) {
    plot.path = FollowedPath{verification.path, verification.path_parameters, *options.task,
                             tolerance, checked.waypoints};
  }
  if (scene != nullptr && checked.moves.attachments.empty()) {
    plot.clearance = clearance_over_time(scene->model, trajectory, arguments.budget.next());
  } else if (scene != nullptr && !checked.has_unknown_parts()) {
    plot.clearance = clearance_over_time(scene->model, trajectory, checked.moves,
                                         verification.arrivals, arguments.budget.next());
  }
  const Picture picture = timing_figure(arm, trajectory, plot);
  write_file(arguments.plot, render(picture, format_of(arguments.plot)));
}

std::string status_of(const CheckedMotion& checked) {
  if (checked.verification.fault != Fault::none) return "failed";
  if (!checked.verification) return name(checked.verification.ending);
  return checked.passed() ? "passed" : name(checked.clearance->proof.status);
}

/// The sentence of a reason, with the options that give a limit that is assumed.
std::string fault_text(const Reason& reason) {
  const ReasonValue* const assumed = reason.find(ReasonField::assumed);
  const ReasonValue* const quantity = reason.find(ReasonField::quantity);
  if (assumed == nullptr || quantity == nullptr || !std::get<bool>(*assumed)) {
    return sentence(reason);
  }
  return sentence(reason) + " (--limits, --" + std::get<std::string>(*quantity) + ")";
}

std::string reason_text(const CheckedMotion& checked) {
  const std::string fault = fault_text(checked.verification.reason);
  if (!checked.clearance || checked.clearance->proof) return fault;
  if (checked.clearance->proof.reason == checked.verification.reason) return fault;
  return (fault.empty() ? "" : fault + "; ") + checked.clearance->reason_text();
}

/// What was not checked without --through, and the options that check it.
std::string not_checked_text(const CheckedMotion& checked) {
  return std::string("not checked   the tool's path: --through FILE gives its poses") +
         (checked.clearance ? "" : "; collisions: --scene FILE gives obstacles, --self the arm") +
         "\n";
}

std::vector<std::string> checks_of(const CheckedMotion& checked) {
  std::vector<std::string> checks = {"limits"};
  if (checked.has_path) checks.emplace_back("path");
  if (checked.clearance) checks.emplace_back("clearance");
  return checks;
}

Json check_document(const CheckArguments& arguments, const Arm& arm, const Trajectory& trajectory,
                    const CheckedMotion& checked) {
  const Verification& verification = checked.verification;
  const bool faulty = verification.fault != Fault::none;
  const bool proved = checked.has_path && verification.ending == Ending::complete;
  const bool by_clearance = verification && checked.clearance && !checked.clearance->proof;
  const bool has_pair = by_clearance && checked.clearance->proof.pair.clearance > 0;
  Json document{{"status", status_of(checked)},
                {"fault", faulty ? Json(name(verification.fault)) : Json()},
                {"sample", faulty ? Json(verification.sample + 1) : Json()},
                {"time", faulty     ? Json(verification.time)
                         : has_pair ? Json(checked.clearance->proof.time)
                                    : Json()},
                {"duration", trajectory.duration()}};
  document.add("faults", json_faults(verification));
  document.add("checked", checks_of(checked));
  const LimitUsage& limits = checked.limits;
  document.add("limits", limits.ending == Ending::complete ? json_limits(limits) : Json());
  document.add("limit_tolerance", arguments.verify.limit_tolerance);
  document.add("recovery", json_recovery(arm, verification.recovery, arguments.unit));
  document.add(deviation_members(proved ? std::optional(verification.deviation) : std::nullopt,
                                 arguments.unit));
  document.add("samples", trajectory.size());
  document.add(json_reason(by_clearance ? checked.clearance->proof.reason : verification.reason));
  Json arrivals = Json::list();
  for (const std::size_t arrival : verification.arrivals) arrivals.append(arrival + 1);
  if (!verification.arrivals.empty()) document.add("arrivals", arrivals);
  if (checked.clearance) document.add("clearance", checked.clearance->document());
  if (!arguments.plot.empty()) document.add("plot", arguments.plot);
  return document;
}

std::string check_text(const CheckArguments& arguments, const Arm& arm,
                       const Trajectory& trajectory, const CheckedMotion& checked) {
  const Verification& verification = checked.verification;
  std::string text = fmt::format("{}: {} in {} s", status_of(checked),
                                 counted(static_cast<std::int64_t>(trajectory.size()), "sample"),
                                 shown(trajectory.duration()));
  if (checked.has_path) {
    text += " through " + counted(static_cast<std::int64_t>(checked.count),
                                  checked.program ? "move" : "waypoint");
  }
  text += "\n";
  if (verification.fault != Fault::none) {
    text += faults_text(verification);
  } else if (verification && checked.has_path) {
    text += deviation_text(verification.deviation, trajectory.interpolation(), arguments.unit,
                           verification.recovery);
  }
  text += recovery_text(arm, verification.recovery, arguments.unit);
  if (checked.limits.ending == Ending::complete) {
    text += position_text(checked.limits) + limits_text(checked.limits);
  }
  text += limit_tolerance_text(arguments.verify.limit_tolerance);
  if (checked.clearance) text += checked.clearance->text();
  if (!checked.has_path) text += not_checked_text(checked);
  if (checked.has_unknown_parts()) {
    text +=
        "not checked   the clearance: parts are attached at waypoints that are not in the motion\n";
  }
  if (!arguments.plot.empty() && verification.ending == Ending::complete) {
    text += fmt::format("plot          {}\n", arguments.plot);
  }
  return text;
}

CheckedMotion check_through(const CheckArguments& arguments, const Arm& arm,
                            const Trajectory& trajectory, const VerifyOptions& options,
                            bool has_scene) {
  const std::string text = read_file(arguments.through);
  const auto recovery = accepted_recovery(arm, trajectory, options.recover);
  const Pose begin = forward_kinematics(arm, trajectory.positions[begin_of_path(recovery)]);
  if (is_program(text)) {
    const Program program = program_from(
        text, arguments.through, arm,
        {arguments.arm, arguments.task, arguments.work, arguments.unit}, arguments.path, begin);
    check_scene_of(program, arguments.through, has_scene);
    if (!program.attachments.empty() && (options.moving.start || options.moving.end)) {
      throw Error(std::string(options.moving.start ? "--moving-start" : "--moving-end") +
                  " does not go together with a program that attaches parts, at rest");
    }
    const Verification verification = at_rows(
        program, arguments.through, [&] { return verify(arm, trajectory, program, options); });
    return {.verification = verification,
            .count = program.moves.size(),
            .program = true,
            .moves = program};
  }
  const PoseList waypoints =
      waypoints_from(text, arguments.through, arm, arguments.task, arguments.work, arguments.unit);
  const Route route = arguments.path.from(begin, waypoints.poses, *options.task);
  return {verify(arm, trajectory, route, options), waypoints.poses, waypoints.poses.size()};
}

/// Warns of values that other verbs would unwrap: what is proved is the file as it is.
void warn_of_wraps(const std::string& path, const Arm& arm, const Trajectory& trajectory) {
  for (const UnwrappedJoint& joint : unwrapped(arm, trajectory).joints) {
    warn(
        fmt::format("{}: the values of joint {} wrap at {} s, and the file is checked as it is; "
                    "`beeline replay --out` unwraps them",
                    path, joint.joint, number(joint.first_time)));
  }
}

void check_arguments(const CheckArguments& arguments) {
  if (arguments.plot.empty()) return;
  format_of(arguments.plot);
  std::vector<std::string> inputs = arguments.scene.inputs();
  inputs.insert(inputs.end(), {arguments.file, arguments.through});
  refuse_overwriting(arguments.plot, arguments.arm.inputs(inputs));
}

CheckedMotion checked_motion(const CheckArguments& arguments, const Arm& arm,
                             const Trajectory& trajectory, const CheckedScene* scene,
                             VerifyOptions& options) {
  options.budget = arguments.budget.next();
  CheckedMotion checked =
      arguments.through.empty()
          ? CheckedMotion{.verification = verify(arm, trajectory, options), .has_path = false}
          : check_through(arguments, arm, trajectory, options, scene != nullptr);
  checked.limits = limit_usage(arm, trajectory, arguments.budget.next());
  if (scene == nullptr || checked.has_unknown_parts()) return checked;
  const Budget budget = arguments.budget.next();
  const bool is_followed = checked.program && checked.verification.arrivals.size() == checked.count;
  checked.clearance =
      is_followed
          ? arguments.scene.prove(*scene, trajectory, checked.followed(arguments.through), budget)
      : checked.program ? arguments.scene.prove_from(std::nullopt, *scene, trajectory, budget)
                        : arguments.scene.prove(*scene, trajectory, budget);
  return checked;
}

Answer check_file(const CheckArguments& arguments) {
  check_arguments(arguments);
  const Arm arm = arguments.limits.set_on(arguments.arm.read(arguments.unit), arguments.unit);
  const std::optional<CheckedScene> scene = arguments.scene.read(arguments.arm, arm);
  const Trajectory trajectory =
      arguments.recording.read(arguments.file, arm, arguments.unit).trajectory;
  warn_of_wraps(arguments.file, arm, trajectory);
  VerifyOptions options = arguments.verify;
  options.task = arguments.task.read(arm);
  options.recover = arguments.recover.read(arm, arguments.unit);
  if (trajectory.size() == 0) throw FileError(arguments.file, 0, "has no samples");
  const CheckedMotion checked =
      checked_motion(arguments, arm, trajectory, scene ? &*scene : nullptr, options);
  if (!arguments.plot.empty() && checked.verification.ending == Ending::complete) {
    write_check_plot(arguments, arm, trajectory, checked, scene ? &*scene : nullptr, options);
  }
  return {.text = check_text(arguments, arm, trajectory, checked),
          .document = check_document(arguments, arm, trajectory, checked),
          .yes = checked.passed(),
          .reason = reason_text(checked)};
}

std::vector<Option> proof_options(CheckArguments& arguments) {
  VerifyOptions& options = arguments.verify;
  return joined(
      {path_tolerance_options(&options.tolerance, &options.orientation_tolerance,
                              {.range = above_zero}),
       {limit_tolerance_option(&options.limit_tolerance),
        Option("--moving-start",
               "The joints may move at the first sample; by default they start from rest.",
               &options.moving.start),
        Option("--moving-end",
               "The joints may move at the last sample; by default they come to rest.",
               &options.moving.end),
        arguments.recover.option(
            "Accept a motion that starts slightly outside the position limits: the excess of each "
            "joint must fall until it is within them, and it must stay there. The path begins "
            "there.")}});
}

Option check_through_option(std::string* target) {
  Option through = through_option(
      "The poses that the tool must pass after its first one. Without it the path is not checked.",
      target);
  through.required = false;
  return through;
}

std::vector<Example> check_examples() {
  return {{"Plan a motion, then check the file that was written",
           "printf 'x,y,theta\\n4.5,5.2,0\\n2,6,45\\n' > planar.csv\n"
           "beeline line rrr --from 0,90,0 --degrees --through planar.csv --out move.csv\n"
           "beeline check rrr move.csv --degrees --through planar.csv"},
          {"A smaller tolerance, a plot of the deviation, and JSON",
           "beeline check rrr move.csv --degrees --through planar.csv --tolerance 2e-4 "
           "--plot check.svg --json"},
          {"An arm with a sphere at its tool, beside a post: both as files",
           "printf '{\"name\": \"arm\", \"joint_string\": \"RRR:3.5,3.5,2\", \"shapes\": "
           "[{\"joint\": \"joint3\", \"shapes\": [{\"sphere\": {\"radius\": 0.3}}]}]}' > "
           "arm.json\n"
           "printf '{\"obstacles\": [{\"name\": \"post\", \"shapes\": [{\"cylinder\": "
           "{\"radius\": 0.2, \"length\": 2}, \"pose\": {\"xyz\": [-4, 0, 0]}}]}]}' > "
           "scene.json\n"
           "beeline check arm.json move.csv --scene scene.json --clearance 0.01"},
          {"A cell as a URDF file, with a mesh of a package: its hull is the obstacle",
           "mkdir -p parts\n"
           "printf 'v -5 0 0\\nv -4 0 0\\nv -5 1 0\\nf 1 2 3\\n' > parts/plate.obj\n"
           "printf '<robot name=\"cell\"><link name=\"plate\"><collision><geometry><mesh "
           "filename=\"package://cell/plate.obj\"/></geometry></collision></link>"
           "</robot>' > cell.urdf\n"
           "beeline check arm.json move.csv --scene cell.urdf --package cell=parts"}};
}

}  // namespace

Verb check_verb() {
  const auto arguments = std::make_shared<CheckArguments>();
  return {
      .name = "check",
      .summary =
          "Prove that a trajectory follows its path, respects the joint limits, hits nothing",
      .description =
          "Proves from a trajectory file alone, whoever made it, that the tool moves in straight "
          "lines (or on the path of --path, --blend) through the poses and that the joints respect "
          "their limits of position, velocity, acceleration and jerk, for the motion that the "
          "file's columns mean: linear between the samples, cubic with velocities, quintic with "
          "accelerations too. Limits of velocity and acceleration that are not known are assumed "
          "and reported as assumed; --limits, --velocity and --acceleration give them. Prints "
          "passed with the measured and the proved deviation in metres and radians, or failed with "
          "every kind of fault, the place of the first of each and the worst; then the exit code "
          "is "
          "1. A program (see `beeline "
          "help line`) is proved move by move: its waypoints in order, lines, arcs, splines and "
          "blends as paths, speeds, dwells at rest; joint moves within the limits, and their "
          "blends "
          "within the distance of the waypoint that they have.\n\n"
          "With --scene the arm must also keep a clearance from obstacles and from itself, with "
          "--self from itself, at all times. Prints the distance that "
          "is proved at all times and the closest pair; or collides, with the first time that was "
          "found, the pair, the place and the depth; or not_decided, where a distance equals the "
          "clearance to the resolution. Without --through only the limits and the clearance are "
          "checked, and the answer says what is not. Shapes of the links are the <collision> "
          "elements of a URDF file, or \"shapes\" of an arm file. Meshes of a URDF file "
          "are taken as their convex hulls, and the report says so: a motion that is proved keeps "
          "its "
          "clearance from the meshes too, and one that collides may pass through a hollow of a "
          "mesh.\n\n" +
          std::string(recording_units),
      .arguments = {arguments->arm.argument(),
                    file_argument("FILE", "The trajectory to check, .csv, .json or .yaml.",
                                  &arguments->file)},
      .options = joined({{check_through_option(&arguments->through), arguments->work.option()},
                         arguments->recording.reading_options(),
                         arguments->unit.options(),
                         arguments->task.options(),
                         arguments->path.options(),
                         proof_options(*arguments),
                         arguments->scene.options(),
                         {plot_option(&arguments->plot)},
                         arguments->arm.options(),
                         arguments->limits.options(),
                         {arguments->budget.time_limit_option()}}),
      .examples = check_examples(),
      .run = [arguments] { return check_file(*arguments); }};
}

}  // namespace beeline::command
