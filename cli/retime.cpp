#include <fmt/format.h>
#include <memory>

#include <beeline/error.h>
#include <beeline/timing/retime.h>

#include "arm_argument.h"
#include "budget_argument.h"
#include "profile_argument.h"
#include "recording_argument.h"
#include "recover_argument.h"
#include "result_files.h"
#include "retimed_answer.h"
#include "sampling_argument.h"
#include "scene_argument.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct RetimeArguments {
  ArmArgument arm;
  UnitArgument unit;
  LimitsArgument limits;
  std::string file;
  RecordingArgument recording;
  ProfileArgument profile;
  InterpolationArgument interpolation;
  RetimeOptions retime;
  RecoverArgument recover;
  std::optional<double> tool_speed, rate;
  SceneArgument scene;
  BudgetArgument budget;
  ResultFiles files;
};

/// A trajectory, or a path: the positions of a .csv file without times, which retime() ignores.
Recording read_input(const RetimeArguments& arguments, const Arm& arm) {
  Recording input = arguments.recording.read(arguments.file, arm, arguments.unit, {.times = false});
  try {
    check_moves(input.trajectory);
  } catch (const Error& error) {
    throw FileError(arguments.file, 0, error.what());
  }
  return input;
}

RetimeOptions retime_options(const RetimeArguments& arguments) {
  RetimeOptions options = arguments.retime;
  options.profile = arguments.profile.read();
  options.interpolation = arguments.interpolation.read();
  if (arguments.rate) options.rate = *arguments.rate;
  if (arguments.tool_speed) options.tool_speed = *arguments.tool_speed;
  return options;
}

Answer retime_file(const RetimeArguments& arguments) {
  std::vector<std::string> inputs = arguments.scene.inputs();
  inputs.push_back(arguments.file);
  arguments.files.check(arguments.arm.inputs(inputs));
  RetimeOptions options = retime_options(arguments);
  const Arm arm = arguments.limits.set_on(arguments.arm.read(arguments.unit), arguments.unit);
  const std::optional<CheckedScene> scene = arguments.scene.read(arguments.arm, arm);
  const Recording input = read_input(arguments, arm);
  options.no_unwrap = arguments.recording.no_unwrap || !input.has_times;
  options.recover = arguments.recover.read(arm, arguments.unit);
  options.budget = arguments.budget.next();
  const Retimed retimed = retime(arm, input.trajectory, options);
  warn_of_unwrapped(arguments.file, retimed.unwrapped);
  const std::vector<double>& before = input.trajectory.times;
  const std::optional<double> duration_before =
      input.has_times ? std::optional(before.back() - before.front()) : std::nullopt;
  return RetimedResult{arguments.scene, scene, arguments.budget, arguments.files, arguments.unit}
      .answer(arm, retimed, duration_before);
}

std::vector<Option> timing_options(RetimeArguments& arguments) {
  return {
      joint_blend_option(&arguments.retime.joint_blend,
                         "the path is the cubic spline through the positions."),
      arguments.profile.option(),
      arguments.interpolation.option(),
      tool_speed_option(&arguments.tool_speed),
      duration_option(
          &arguments.retime.duration,
          ": the quickest one is slowed down to it (`beeline replay --rate` samples it)", "--rate"),
      max_samples_option(&arguments.retime.max_samples,
                         fmt::format("--rate makes more samples, or the file has more and more "
                                     "than {}. 1000000 take about a minute and 2.5 GB.",
                                     default_max_samples)),
      arguments.recover.option(
          "Accept a first position slightly outside the position limits: a first section leads to "
          "the nearest configuration within them, where the path then begins."),
      rate_option(&arguments.rate, ". Default: every sample of the file, and more between.")};
}

}  // namespace

Verb retime_verb() {
  const auto arguments = std::make_shared<RetimeArguments>();
  return {
      .name = "retime",
      .summary = "Retime a trajectory: minimum time within the joint limits",
      .description =
          "Computes new times for a trajectory, from rest to rest. The geometric path is the cubic "
          "spline through its positions or, with --joint-blend, straight joint motions from "
          "position to position that "
          "pass these in blends; its times and velocities are ignored, except that stops "
          "(a repeated position or a zero velocity) remain. Prints the number of samples, the new "
          "and the previous duration in seconds, the largest fraction of each limit that is used, "
          "and the largest tool speed in m/s. Limits that are not known are assumed, and reported "
          "as assumed. With --scene or --self the motion must keep a clearance, see `beeline help "
          "check`; otherwise nothing is written. " +
          std::string(recording_units),
      .arguments = {arguments->arm.argument(),
                    file_argument("FILE",
                                  "The trajectory, .csv, .json or .yaml. A .csv file without "
                                  "a column of times is a path.",
                                  &arguments->file)},
      .options = joined({timing_options(*arguments), arguments->recording.options(),
                         arguments->unit.options(), arguments->scene.options(),
                         arguments->files.options(), arguments->arm.options(),
                         arguments->limits.options(), arguments->budget.options()}),
      .examples =
          {{"Record a motion under feedback control, then retime it",
            "beeline move panda --from 0,-0.8,0,-2.4,0,1.6,0.8 --to 0.5,0,0,-2,0,2,0 --out "
            "move.csv\n"
            "beeline retime panda move.csv --out quick.csv"},
           {"Waypoints without times, at half the speed limits, sampled at 100 Hz",
            "printf 'joint1,joint2,joint3\\n0,1,0\\n0.5,0.8,-0.3\\n1,0,0.2\\n' > waypoints.csv\n"
            "beeline retime rrr waypoints.csv --speed 0.5 --rate 100 --out timed.csv"}},
      .run = [arguments] { return retime_file(*arguments); }};
}

}  // namespace beeline::command
