#include <fmt/core.h>

#include <beeline/control/replay.h>

#include "results.h"
#include "verb.h"

using namespace beeline;

namespace {

struct Arguments {
  std::string recording;
  ArmArgument arm;
  UnitArgument unit;
  std::string from;
  ReplayOptions options;
  ResultFiles files;
  bool json = false;
};

Exit play(const Arguments& arguments) {
  arguments.files.check({arguments.arm.text, arguments.recording});
  const Arm arm = arguments.arm.read();
  const Trajectory recording = read_recording(arguments.recording, arm);
  ReplayOptions options = arguments.options;
  if (!arguments.from.empty()) {
    options.start = arguments.unit.configuration(arm, arguments.from, "--from");
  }
  const Replay played = replay(arm, recording, options);
  const bool reached = played.status == MotionStatus::reached;
  if (reached) arguments.files.write(arm, played.trajectory, {});
  const double duration = reached ? played.trajectory.times.back() : 0;
  if (arguments.json) {
    OrderedJson document{
        {"status", name(played.status)},
        {"samples", played.trajectory.size()},
        {"duration", duration},
        {"lead_in", played.lead_in},
        {"fastest", played.fastest > 0 ? json_number(played.fastest) : OrderedJson(nullptr)},
        {"reason", played.reason}};
    if (reached) arguments.files.add_to(document);
    print_json(document);
  } else {
    fmt::print("{}: {} recorded samples on {}\n", name(played.status), recording.size(),
               arm.name());
    if (reached) {
      fmt::print("played        {} samples in {} s, of which {} s lead-in\n",
                 played.trajectory.size(), shown(duration), shown(played.lead_in));
      if (played.fastest > 0) {
        fmt::print("fastest       {} % of a joint's velocity limit\n", shown(100 * played.fastest));
      }
      arguments.files.print();
    }
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
  verb.add_option("--rate", options.rate, "Samples a second")->capture_default_str();
  arguments.files.declare(verb);
  verb.add_flag("--json", arguments.json, "Print JSON");
  verb.footer(
      "The recording's own values are radians and metres; --degrees is for --from.\n"
      "Examples:\n"
      "  beeline replay move.csv rrr --rate 50 --out played.csv\n"
      "  beeline replay move.csv panda --from 0,-0.8,0,-2.4,0,1.6,0.8 --speed 0.5");
  return [] { return play(arguments); };
}
