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
#include "format.h"
#include "json_reason.h"
#include "motion_report.h"
#include "path_argument.h"
#include "pose_argument.h"
#include "program_argument.h"
#include "recording_argument.h"
#include "result_files.h"
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
  BudgetArgument budget;
};

/// Plots the motion with its limits, and its deviation from the path up to the last sample on it.
/// What a file is checked against.
struct CheckedMotion {
  Verification verification;
  std::vector<Pose> waypoints = {};  ///< of a file of poses
  std::size_t count = 0;             ///< of waypoints or moves
  bool program = false;
};

void write_check_plot(const CheckArguments& arguments, const Arm& arm, const Trajectory& trajectory,
                      const CheckedMotion& checked, const VerifyOptions& options) {
  const Deviation tolerance{options.tolerance, options.orientation_tolerance};
  const Verification& verification = checked.verification;
  TimingFigureOptions plot;
  if (checked.program) {
    for (const std::size_t k : verification.arrivals) {
      plot.waypoint_times.push_back(trajectory.times[k]);
    }
  } else {
    plot.path = FollowedPath{verification.path, verification.path_parameters, *options.task,
                             tolerance, checked.waypoints};
  }
  const Picture picture = timing_figure(arm, trajectory, plot);
  write_file(arguments.plot, render(picture, format_of(arguments.plot)));
}

std::string status_of(const Verification& verification) {
  if (verification) return "passed";
  return verification.fault == Fault::none ? name(verification.ending) : "failed";
}

Json check_document(const CheckArguments& arguments, const Trajectory& trajectory,
                    const Verification& verification, const LimitUsage& limits) {
  const bool faulty = verification.fault != Fault::none;
  const bool complete = verification.ending == Ending::complete;
  Json document{{"status", status_of(verification)},
                {"fault", faulty ? Json(name(verification.fault)) : Json()},
                {"sample", faulty ? Json(verification.sample + 1) : Json()},
                {"time", faulty ? Json(verification.time) : Json()},
                {"duration", trajectory.times.back()}};
  document.add("limits", limits.ending == Ending::complete ? json_limits(limits) : Json());
  document.add("limit_tolerance", arguments.verify.limit_tolerance);
  document.add(deviation_members(complete ? std::optional(verification.deviation) : std::nullopt,
                                 arguments.unit));
  document.add("samples", trajectory.size());
  document.add(json_reason(verification.reason));
  Json arrivals = Json::list();
  for (const std::size_t arrival : verification.arrivals) arrivals.append(arrival + 1);
  if (!verification.arrivals.empty()) document.add("arrivals", arrivals);
  if (!arguments.plot.empty()) document.add("plot", arguments.plot);
  return document;
}

std::string check_text(const CheckArguments& arguments, const Trajectory& trajectory,
                       const Verification& verification, const LimitUsage& limits,
                       const std::string& waypoints) {
  std::string text = fmt::format("{}: {} in {} s through {}\n", status_of(verification),
                                 counted(static_cast<std::int64_t>(trajectory.size()), "sample"),
                                 shown(trajectory.times.back()), waypoints);
  if (verification.fault != Fault::none) {
    text += fmt::format("fault         {}\n", name(verification.fault));
  } else if (verification) {
    text += deviation_text(verification.deviation, trajectory.interpolation(), arguments.unit);
  }
  if (limits.ending == Ending::complete) text += limits_text(limits);
  text += limit_tolerance_text(arguments.verify.limit_tolerance);
  if (!arguments.plot.empty() && verification.ending == Ending::complete) {
    text += fmt::format("plot          {}\n", arguments.plot);
  }
  return text;
}

CheckedMotion check_through(const CheckArguments& arguments, const Arm& arm,
                            const Trajectory& trajectory, const VerifyOptions& options) {
  const std::string text = read_file(arguments.through);
  if (is_program(text)) {
    const Program program =
        program_from(text, arguments.through, arm,
                     {arguments.arm, arguments.task, arguments.work, arguments.unit},
                     arguments.path, forward_kinematics(arm, trajectory.positions.front()));
    const Verification verification = at_rows(
        program, arguments.through, [&] { return verify(arm, trajectory, program, options); });
    return {verification, {}, program.moves.size(), true};
  }
  const PoseList waypoints =
      waypoints_from(text, arguments.through, arm, arguments.task, arguments.work, arguments.unit);
  const Pose begin = forward_kinematics(arm, trajectory.positions.front());
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

Answer check_file(const CheckArguments& arguments) {
  if (!arguments.plot.empty()) {
    format_of(arguments.plot);
    refuse_overwriting(arguments.plot, arguments.arm.inputs({arguments.file, arguments.through}));
  }
  const Arm arm = arguments.limits.set_on(arguments.arm.read(arguments.unit), arguments.unit);
  const Trajectory trajectory =
      arguments.recording.read(arguments.file, arm, arguments.unit).trajectory;
  warn_of_wraps(arguments.file, arm, trajectory);
  VerifyOptions options = arguments.verify;
  options.task = arguments.task.read(arm);
  if (trajectory.size() == 0) throw FileError(arguments.file, 0, "has no samples");
  options.budget = arguments.budget.next();
  const CheckedMotion checked = check_through(arguments, arm, trajectory, options);
  const Verification& verification = checked.verification;
  const LimitUsage limits = limit_usage(arm, trajectory, arguments.budget.next());
  const bool complete = verification.ending == Ending::complete;
  if (!arguments.plot.empty() && complete) {
    write_check_plot(arguments, arm, trajectory, checked, options);
  }
  return {.text = check_text(arguments, trajectory, verification, limits,
                             counted(static_cast<std::int64_t>(checked.count),
                                     checked.program ? "move" : "waypoint")),
          .document = check_document(arguments, trajectory, verification, limits),
          .yes = static_cast<bool>(verification),
          .reason = sentence(verification.reason)};
}

std::vector<Option> proof_options(VerifyOptions& options) {
  return {
      Option("--tolerance METRES", "Largest distance of the tool origin from the path.",
             &options.tolerance, {.range = above_zero}),
      Option("--orientation-tolerance RAD", "Largest angle from the path's orientation, radians.",
             &options.orientation_tolerance, {.range = above_zero}),
      limit_tolerance_option(&options.limit_tolerance),
      Option("--moving-start",
             "The joints may move at the first sample; by default they start from rest.",
             &options.moving.start),
      Option("--moving-end",
             "The joints may move at the last sample; by default they come to rest.",
             &options.moving.end)};
}

}  // namespace

Verb check_verb() {
  const auto arguments = std::make_shared<CheckArguments>();
  return {
      .name = "check",
      .summary = "Prove that a trajectory follows its path and respects the joint limits",
      .description =
          "Proves from a trajectory file alone, whoever made it, that the tool moves in straight "
          "lines (or on the path of --path, --blend) through the poses and that the joints respect "
          "their limits of position, velocity, acceleration and jerk, for the motion that the "
          "file's columns mean: linear between the samples, cubic with velocities, quintic with "
          "accelerations too. Limits of velocity and acceleration that are not known are assumed "
          "and reported as assumed; --limits, --velocity and --acceleration give them. Prints "
          "passed with the measured and the proved deviation in metres and radians, or failed with "
          "the first fault, its sample and time; then the exit code is 1. A program (see `beeline "
          "help line`) is proved move by move: its waypoints in order, lines, arcs, splines and "
          "blends as paths, speeds, dwells at rest; joint moves within the limits. " +
          std::string(recording_units),
      .arguments = {arguments->arm.argument(),
                    file_argument("FILE", "The trajectory to check, .csv, .json or .yaml.",
                                  &arguments->file)},
      .options = joined({{through_option("The poses that the tool must pass after its first one.",
                                         &arguments->through),
                          arguments->work.option()},
                         arguments->recording.reading_options(),
                         arguments->unit.options(),
                         arguments->task.options(),
                         arguments->path.options(),
                         proof_options(arguments->verify),
                         {plot_option(&arguments->plot)},
                         arguments->arm.options(),
                         arguments->limits.options(),
                         {arguments->budget.time_limit_option()}}),
      .examples = {{"Plan a motion, then check the file that was written",
                    "printf 'x,y,theta\\n4.5,5.2,0\\n2,6,45\\n' > planar.csv\n"
                    "beeline line rrr --from 0,90,0 --degrees --through planar.csv --out move.csv\n"
                    "beeline check rrr move.csv --degrees --through planar.csv"},
                   {"A smaller tolerance, a plot of the deviation, and JSON",
                    "beeline check rrr move.csv --degrees --through planar.csv --tolerance 2e-4 "
                    "--plot check.svg --json"}},
      .run = [arguments] { return check_file(*arguments); }};
}

}  // namespace beeline::command
