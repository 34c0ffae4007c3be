#include <algorithm>
#include <fmt/core.h>

#include <beeline/inverse/solve.h>
#include <beeline/read/pose_list.h>

#include "output.h"
#include "verb.h"

using namespace beeline;

namespace {

struct Arguments {
  ArmArgument arm;
  UnitArgument unit;
  TaskArgument task;
  std::string pose, seed;
  InverseOptions options;
  bool json = false;
};

Exit inverse(const Arguments& arguments) {
  const Arm arm = arguments.arm.read();
  const WrittenPose goal = parse_pose(arguments.pose, arguments.unit.angle_unit());
  InverseOptions options = arguments.options;
  options.task = arguments.task.read(arm);
  check_pose_form(arm, goal, arguments.task, "--pose");
  if (!arguments.seed.empty()) {
    options.seed = arguments.unit.configuration(arm, arguments.seed, "--seed");
  }
  const InverseResult result = inverse_kinematics(arm, goal.pose, options);
  const bool solved = result.status == InverseStatus::solved;
  if (arguments.json) {
    OrderedJson solutions = OrderedJson::array();
    for (const Configuration& q : result.solutions) {
      solutions.push_back(json_vector(arguments.unit.shown(arm, q)));
    }
    print_json({{"status", name(result.status)},
                {"solutions", solutions},
                {"residual", json_number(result.residual)},
                {"reason", result.reason},
                {"method", result.method},
                {"iterations", result.iterations},
                {"restarts", result.restarts}});
  } else {
    fmt::print("{}: {} solution{} by {}, residual {}\n", name(result.status),
               result.solutions.size(), result.solutions.size() == 1 ? "" : "s", result.method,
               shown(result.residual));
    for (const Configuration& q : result.solutions) {
      fmt::print("  {}\n", shown(arguments.unit.shown(arm, q)));
    }
  }
  if (solved && result.residual > options.tolerance) {
    fmt::print(stderr,
               "beeline: warning: rounding at this arm's size limits the error to {} m or rad\n",
               shown(result.residual));
  }
  if (!solved) fmt::print(stderr, "beeline: {}\n", result.reason);
  return solved ? Exit::yes : Exit::no;
}

}  // namespace

Run declare_ik(CLI::App& verb) {
  static Arguments arguments;
  InverseOptions& options = arguments.options;
  arguments.arm.declare(verb);
  verb.add_option("--pose", arguments.pose,
                  "x,y,theta (planar arms), x,y,z,roll,pitch,yaw or x,y,z,qw,qx,qy,qz")
      ->required();
  verb.add_option("--seed", arguments.seed, "Joint values to be near to (default: the middle)");
  arguments.unit.declare(verb);
  arguments.task.declare(verb);
  verb.add_flag("--all", options.all, "Every solution found, nearest to the seed first");
  verb.add_flag("--ignore-limits", options.ignore_limits, "Joint limits do not count");
  verb.add_option("--tolerance", options.tolerance, "Largest error, metres and radians")
      ->capture_default_str();
  verb.add_option("--iterations", options.iterations, "Most steps of the numerical solver in a try")
      ->capture_default_str();
  verb.add_option("--restarts", options.restarts, "Most tries from random configurations")
      ->capture_default_str();
  verb.add_option("--random-seed", options.random_seed, "The same seed gives the same answer")
      ->capture_default_str();
  verb.add_flag("--json", arguments.json, "Print JSON");
  verb.footer(
      "Examples:\n"
      "  beeline ik rrr --pose 4.459,5.226,0 --all --degrees\n"
      "  beeline ik panda --pose 0.4,0.1,0.5,3.14159,0,0 --json");
  return [] { return inverse(arguments); };
}
