#include <fmt/core.h>

#include <beeline/error.h>
#include <beeline/trajectory/difference.h>

#include "difference_report.h"
#include "results.h"
#include "verb.h"

using namespace beeline;

namespace {

struct Arguments {
  std::string a, b;
  ArmArgument arm;
  UnitArgument unit;
  double tolerance = Limits::none;
  bool json = false;
};

Exit diff(const Arguments& arguments) {
  if (!(arguments.tolerance >= 0)) {
    throw Error("--tolerance must be zero or above, not " + number(arguments.tolerance));
  }
  const Arm arm = arguments.arm.read();
  const TrajectoryDifference apart =
      difference(arm, read_recording(arguments.a, arm), read_recording(arguments.b, arm));
  int worst = 0;
  for (int k = 1; k < arm.dof(); ++k) {
    const auto& joints = apart.joints;
    if (joints[k].largest > joints[worst].largest) worst = k;
  }
  const JointDifference& most = apart.joints[worst];
  const bool same = most.largest <= arguments.tolerance;
  if (arguments.json) {
    OrderedJson document{{"status", same ? "within" : "apart"}};
    document.update(json_difference(arm, apart, arguments.unit));
    print_json(document);
  } else {
    print_difference(arm, apart, arguments.unit);
  }
  if (same) return Exit::yes;
  fmt::print(stderr, "beeline: joint {} differs by {} at {} s; the tolerance is {}\n",
             arm.joint_of(worst).name, number(most.largest), number(most.time),
             number(arguments.tolerance));
  return Exit::no;
}

}  // namespace

Run declare_diff(CLI::App& verb) {
  static Arguments arguments;
  verb.add_option("A", arguments.a, "A recorded trajectory: .csv or .json")->required();
  verb.add_option("B", arguments.b, "Another one, of the same arm")->required();
  arguments.arm.declare(verb);
  arguments.unit.declare(verb);
  verb.add_option("--tolerance", arguments.tolerance,
                  "Exit with 1 when a joint differs by more, radians or metres");
  verb.add_flag("--json", arguments.json, "Print JSON");
  verb.footer(
      "Each recording counts from its own first sample; joints are linear between samples. With\n"
      "what was commanded and what was measured it tells the tracking error. What one lasts "
      "longer\n"
      "than the other is told, but not judged by --tolerance.\n"
      "Examples:\n"
      "  beeline diff commanded.csv measured.csv panda\n"
      "  beeline diff before.csv after.json robot.urdf --tolerance 1e-3 --json");
  return [] { return diff(arguments); };
}
