#include <algorithm>
#include <fmt/core.h>

#include <beeline/control/replay.h>
#include <beeline/error.h>
#include <beeline/read/numbers.h>

#include "difference_report.h"
#include "results.h"
#include "verb.h"

using namespace beeline;

namespace {

struct Arguments {
  std::string recording;
  ArmArgument arm;
  UnitArgument unit;
  std::string from, speed_at, measured;
  ReplayOptions options;
  const CLI::Option* ramp = nullptr;
  ResultFiles files;
  bool json = false;
};

/// "2:0.5,4:0,6:1": times and the speeds from then on.
std::vector<SpeedChange> speed_changes(const std::string& text) {
  std::vector<SpeedChange> changes;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string change = text.substr(begin, end - begin);
    const std::size_t colon = change.find(':');
    if (colon == std::string::npos) {
      throw Error("--speed-at takes times and speeds, such as 2:0.5,4:0,6:1, not " + change);
    }
    changes.push_back({parse_number(change.substr(0, colon), "--speed-at, time"),
                       parse_number(change.substr(colon + 1), "--speed-at, speed")});
    begin = end + 1;
  }
  return changes;
}

OrderedJson document(const Replay& played) {
  const bool reached = played.status == MotionStatus::reached;
  return {{"status", name(played.status)},
          {"samples", played.trajectory.size()},
          {"duration", reached ? played.trajectory.times.back() : 0},
          {"lead_in", played.lead_in},
          {"fastest", played.fastest > 0 ? json_number(played.fastest) : OrderedJson(nullptr)},
          {"reason", played.reason}};
}

void print(const Replay& played) {
  fmt::print("played        {} samples in {} s, of which {} s lead-in\n", played.trajectory.size(),
             shown(played.trajectory.times.back()), shown(played.lead_in));
  if (played.fastest > 0) {
    fmt::print("fastest       {} % of a joint's velocity limit\n", shown(100 * played.fastest));
  }
}

Exit play(const Arguments& arguments) {
  arguments.files.check({arguments.arm.text, arguments.recording, arguments.measured});
  ReplayOptions options = arguments.options;
  if (!arguments.speed_at.empty()) {
    options.speed_at = speed_changes(arguments.speed_at);
  } else if (arguments.ramp->count() > 0) {
    throw Error("--ramp goes with --speed-at alone; --speed-at 0:1 plays at one speed with it");
  }
  const Arm arm = arguments.arm.read();
  const Trajectory recording = read_recording(arguments.recording, arm);
  std::optional<Trajectory> measured;
  if (!arguments.measured.empty()) measured = read_recording(arguments.measured, arm);
  if (!arguments.from.empty()) {
    options.start = arguments.unit.configuration(arm, arguments.from, "--from");
  }
  const Replay played = replay(arm, recording, options);
  const bool reached = played.status == MotionStatus::reached;
  std::optional<TrajectoryDifference> tracking;
  if (reached && measured) tracking = difference(arm, played.trajectory, *measured);
  if (reached) arguments.files.write(arm, played.trajectory, {});
  if (arguments.json) {
    OrderedJson printed = document(played);
    if (tracking) printed["tracking"] = json_difference(arm, *tracking, arguments.unit);
    if (reached) arguments.files.add_to(printed);
    print_json(printed);
  } else {
    fmt::print("{}: {} recorded samples on {}\n", name(played.status), recording.size(),
               arm.name());
    if (reached) print(played);
    if (tracking) fmt::print("tracking      from what is played to {}\n", arguments.measured);
    if (tracking) print_difference(arm, *tracking, arguments.unit);
    if (reached) arguments.files.print();
  }
  if (!reached) fmt::print(stderr, "beeline: {}\n", played.reason);
  return reached ? Exit::yes : Exit::no;
}

}  // namespace

Run declare_replay(CLI::App& verb) {
  static Arguments arguments;
  ReplayOptions& options = arguments.options;
  verb.add_option("FILE", arguments.recording, "A recorded trajectory: .csv or .json")->required();
  arguments.arm.declare(verb);
  verb.add_option("--from", arguments.from, "Where the arm is: it first moves to the first sample");
  arguments.unit.declare(verb);
  verb.add_option("--speed", options.speed, "0.5 takes twice the recorded time")
      ->capture_default_str();
  verb.add_option("--speed-at", arguments.speed_at,
                  "Speeds while it runs, from 0, which pauses, to 1: 2:0.5,4:0,6:1 goes to half\n"
                  "the speed from 2 s on, pauses at 4 s, and goes on at 6 s");
  arguments.ramp =
      verb.add_option("--ramp", options.ramp, "Seconds in which --speed-at changes the speed by 1")
          ->capture_default_str();
  verb.add_option("--rate", options.rate, "Samples a second")->capture_default_str();
  verb.add_option("--measured", arguments.measured,
                  "What the arm did when it played this: tells its tracking error");
  arguments.files.declare(verb);
  verb.add_flag("--json", arguments.json, "Print JSON");
  verb.footer(
      "The times of --speed-at are those of --out: from the begin of playing, lead-in included.\n"
      "With it the speed also begins at zero and changes steadily, more slowly where joints need\n"
      "their accelerations; without it every recorded sample is played, at full speed at once.\n"
      "--measured is compared as beeline diff does, which compares any two recordings.\n"
      "The recording's own values are radians and metres; --degrees is for --from and angles "
      "told.\n"
      "Examples:\n"
      "  beeline replay move.csv rrr --rate 50 --out played.csv\n"
      "  beeline replay move.csv panda --from 0,-0.8,0,-2.4,0,1.6,0.8 --speed 0.5\n"
      "  beeline replay move.csv panda --speed-at 2:0.5,4:0,6:1 --out played.csv\n"
      "  beeline replay move.csv panda --speed-at 2:0.5,4:0,6:1 --measured measured.csv");
  return [] { return play(arguments); };
}
