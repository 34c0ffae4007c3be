#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <tuple>

#include <beeline/control/replay.h>
#include <beeline/error.h>
#include <beeline/io/text/numbers.h>

#include "arm_argument.h"
#include "budget_argument.h"
#include "command/streams.h"
#include "format.h"
#include "json_reason.h"
#include "motion_report.h"
#include "recording_argument.h"
#include "result_files.h"
#include "sampling_argument.h"
#include "scene_argument.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct ReplayArguments {
  ArmArgument arm;
  LimitsArgument limits;
  std::string file;
  RecordingArgument recording;
  UnitArgument unit;
  std::string from, speed_at, measured;
  std::optional<double> rate;
  ReplayOptions replay;
  SceneArgument scene;
  BudgetArgument budget;
  ResultFiles files;
};

/// "2:0.5,4:0,6:1": times and the speeds from then on.
std::vector<SpeedChange> speed_changes(const std::string& text) {
  std::vector<SpeedChange> changes;
  for (const std::string& change : items_of(text, ',')) {
    const std::size_t colon = change.find(':');
    if (colon == std::string::npos) {
      throw Error("--speed-at takes TIME:SPEED pairs, such as 2:0.5,4:0,6:1, not " + change);
    }
    changes.push_back({parse_number(change.substr(0, colon), "--speed-at, time"),
                       parse_number(change.substr(colon + 1), "--speed-at, speed")});
  }
  return changes;
}

ReplayOptions replay_options(const ReplayArguments& arguments, const Arm& arm) {
  ReplayOptions options = arguments.replay;
  options.no_unwrap = arguments.recording.no_unwrap;
  if (arguments.rate) options.rate = *arguments.rate;
  if (!arguments.speed_at.empty()) options.speed_at = speed_changes(arguments.speed_at);
  if (!arguments.from.empty()) {
    options.start = arguments.arm.configuration(arm, arguments.from, "--from", arguments.unit);
  }
  return options;
}

Json replay_document(const Replay& played, double limit_tolerance) {
  const bool reached(played);
  const LimitFraction& velocity = played.limits.velocity;
  Json document{{"status", name(played.status)},
                {"samples", played.trajectory.size()},
                {"duration", reached ? Json(played.trajectory.times.back()) : Json()},
                {"lead_in", played.lead_in},
                {"slowdown", played.slowdown},
                {"velocity_fraction",
                 velocity.joint.empty() || velocity.assumed ? Json() : Json(velocity.fraction)},
                {"unwrapped", json_unwrapped(played.unwrapped)}};
  document.add(json_reason(played.reason));
  document.add("limit_tolerance", limit_tolerance);
  if (reached) document.add("limits", json_limits(played.limits));
  return document;
}

/// Warns of limits that the recording itself exceeds: known ones, and assumed ones of velocity and
/// acceleration, as check does.
void warn_of_limits(const LimitUsage& limits, double limit_tolerance) {
  const double slack = std::max(1e-6, limit_tolerance);  // as check has
  const std::tuple<const char*, const LimitFraction*, double> kinds[] = {
      {"velocity", &limits.velocity, 1.0},
      {"acceleration", &limits.acceleration, 1.0 / 2},
      {"jerk", &limits.jerk, 1.0 / 3}};
  for (const auto& [kind, use, root] : kinds) {
    if (use->joint.empty() || !(use->fraction > 1 + slack)) continue;
    if (use->assumed && use == &limits.jerk) continue;
    warn(
        fmt::format("the recording exceeds the {}{} limit of joint {} at {} s, {} times{}; {} % of "
                    "this speed keeps it",
                    use->assumed ? "assumed " : "", kind, use->joint, shown(use->time),
                    number_apart(use->fraction, 1), use->exact ? "" : " by divided differences",
                    shown(std::floor(1000 * std::pow(use->fraction, -root)) / 10)));
  }
}

std::string replay_text(const Replay& played, double limit_tolerance) {
  constexpr double little = 1.0005;
  std::string text =
      fmt::format("played        {} in {} s, of which {} s lead-in\n",
                  counted(static_cast<std::int64_t>(played.trajectory.size()), "sample"),
                  shown(played.trajectory.times.back()), shown(played.lead_in));
  if (played.slowdown > little) {
    text += fmt::format("slowed down   by {} % for whole periods and limits between samples\n",
                        shown(std::round(1000 * (played.slowdown - 1)) / 10));
  }
  return text + limits_text(played.limits) + limit_tolerance_text(limit_tolerance);
}

Answer replay_file(const ReplayArguments& arguments) {
  std::vector<std::string> inputs = arguments.scene.inputs();
  inputs.insert(inputs.end(), {arguments.file, arguments.measured});
  arguments.files.check(arguments.arm.inputs(inputs));
  const Arm arm = arguments.limits.set_on(arguments.arm.read(arguments.unit), arguments.unit);
  const std::optional<CheckedScene> scene = arguments.scene.read(arguments.arm, arm);
  ReplayOptions options = replay_options(arguments, arm);
  const bool compares = !arguments.measured.empty();
  const Recording read = arguments.recording.read(arguments.file, arm, arguments.unit,
                                                  {.joint_map = !compares, .time_unit = !compares});
  const Trajectory& recording = read.trajectory;
  std::optional<Trajectory> measured;
  if (compares) {
    measured = arguments.recording
                   .read_unwrapped(arguments.measured, arm, arguments.unit,
                                   {.joint_map = !read.mapped, .time_unit = !read.in_time_unit})
                   .trajectory;
  }
  options.budget = arguments.budget.next();
  Replay played = replay(arm, recording, options);
  warn_of_unwrapped(arguments.file, played.unwrapped);
  std::optional<ClearanceReport> clearance;
  if (scene && played) {
    clearance = arguments.scene.prove(*scene, played.trajectory, arguments.budget.next());
    played.status = clearance->refusal();
    if (!clearance->proof) played.reason = clearance->proof.reason;
    arguments.files.draw_refusal(*clearance);
  }
  const bool reached(played);
  if (reached) {
    arguments.files.write(arm, played.trajectory, {}, {}, std::nullopt,
                          scene ? &scene->model : nullptr);
  }
  Answer answer{
      .text = fmt::format("{}: {} on {}\n", name(played.status),
                          counted(static_cast<std::int64_t>(recording.size()), "recorded sample"),
                          arm.name()),
      .document = replay_document(played, options.limit_tolerance),
      .yes = reached,
      .reason = clearance && !reached ? clearance->reason_text() : sentence(played.reason)};
  if (clearance) answer.document.add("clearance", clearance->document());
  if (reached) answer.text += replay_text(played, options.limit_tolerance);
  if (clearance) answer.text += clearance->text();
  if (!reached) return answer;
  warn_of_limits(played.limits, options.limit_tolerance);
  if (measured) {
    const TrajectoryDifference tracking = difference(arm, played.trajectory, *measured);
    answer.text += fmt::format("tracking      {} against what is played\n", arguments.measured) +
                   difference_text(arm, tracking, arguments.unit);
    answer.document.add("tracking", difference_members(arm, tracking, arguments.unit));
  }
  answer.text += arguments.files.text();
  arguments.files.add_to(answer.document);
  return answer;
}

std::vector<Option> playing_options(ReplayArguments& arguments) {
  ReplayOptions& replay = arguments.replay;
  return {
      joint_values_option(
          "--from",
          "Joint values at which the arm is; it first moves to the first sample (the lead-in).",
          &arguments.from),
      Option("--speed K",
             "Playback speed: velocities x K, accelerations x K^2, jerks x K^3; at 0.5 the motion "
             "takes twice the recorded time, and so does the lead-in, which is never sped up.",
             &replay.speed, {.range = above_zero}),
      Option("--speed-at T:K,...",
             "Playback speeds from 0 (pause) to 1 and the times at which they begin, lead-in "
             "included: 2:0.5,4:0,6:1 is half speed from 2 s on, a pause at 4 s, full speed from 6 "
             "s on. The speed changes gradually; a recording that starts moving starts at speed 0.",
             &arguments.speed_at, {.excludes = "--speed"}),
      Option("--ramp SECONDS", "Time in which the playback speed changes by 1.", &replay.ramp,
             {.range = above_zero, .needs = "--speed-at"}),
      rate_option(&arguments.rate,
                  " of the output, from the first to the last. Default: the recorded samples; with "
                  "--speed-at " +
                      number(default_replay_rate) + "."),
      limit_tolerance_option(&replay.limit_tolerance),
      Option("--measured FILE",
             "A measured trajectory, to report the tracking error as `beeline diff` does.",
             &arguments.measured)};
}

}  // namespace

Verb replay_verb() {
  const auto arguments = std::make_shared<ReplayArguments>();
  return {
      .name = "replay",
      .summary = "Play a recorded trajectory on an arm, checked against its limits",
      .description =
          "Checks a recording against the arm's limits and resamples it. The samples hold the "
          "limits of position, velocity, acceleration and jerk at all times where the recording "
          "does: it is slowed down where a rate needs it. Where the recording stops, the replay "
          "does too, and dwells are never shorter. Prints a status, the number of samples, the "
          "duration and the lead-in in seconds, and the largest fraction of each limit. With "
          "--scene "
          "or --self the motion, lead-in included, must keep a clearance, see `beeline help "
          "check`; "
          "otherwise nothing is written. " +
          std::string(recording_units),
      .arguments = {arguments->arm.argument(),
                    file_argument("FILE", "A recorded trajectory, .csv, .json or .yaml.",
                                  &arguments->file)},
      .options = joined({playing_options(*arguments),
                         arguments->recording.options(),
                         arguments->unit.options(),
                         arguments->scene.options(),
                         arguments->files.options(),
                         arguments->arm.options(),
                         arguments->limits.rate_options(),
                         {arguments->budget.time_limit_option()}}),
      .examples = {{"Record a motion, then play it at half speed",
                    "beeline move panda --from 0,-0.8,0,-2.4,0,1.6,0.8 --to 0.5,0,0,-2,0,2,0 "
                    "--method quickest --out move.csv\n"
                    "beeline replay panda move.csv --speed 0.5 --out slow.csv"},
                   {"Half speed, a pause from 1 s to 2 s, then full speed",
                    "beeline replay panda move.csv --speed-at 0:0.5,1:0,2:1 --out paused.csv"},
                   {"The tracking error of a measured trajectory",
                    "beeline replay panda move.csv --measured slow.csv"}},
      .run = [arguments] { return replay_file(*arguments); }};
}

}  // namespace beeline::command
