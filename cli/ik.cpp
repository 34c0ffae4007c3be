#include <algorithm>
#include <charconv>
#include <fmt/core.h>

#include <beeline/error.h>
#include <beeline/inverse/solve.h>
#include <beeline/read/numbers.h>
#include <beeline/read/pose_list.h>

#include "output.h"
#include "verb.h"

using namespace beeline;

namespace {

struct Arguments {
  ArmArgument arm;
  UnitArgument unit;
  TaskArgument task;
  std::string pose, seed, lock;
  std::string method = name(InverseMethod::automatic), redundancy = name(Redundancy::any);
  InverseOptions options;
  bool json = false;
};

/// CLI11 takes -1 for the largest number, and cuts off what is too large.
std::string whole_number(const std::string& text) {
  std::uint64_t value = 0;
  const char* const last = text.data() + text.size();
  const auto [end, fault] = std::from_chars(text.data(), last, value);
  if (text.empty() || (fault == std::errc() && end == last)) return "";
  return "needs a whole number from 0 to 18446744073709551615, not " + text;
}

/// --lock NAME or NAME=VALUE: the value goes into the seed, where the joint stays.
void apply_lock(const Arguments& arguments, const Arm& arm, InverseOptions& options) {
  const std::vector<std::string> names = arm.joint_names();
  auto joint = std::find(names.begin(), names.end(), arguments.lock);
  const std::size_t equals = arguments.lock.rfind('=');
  const bool has_value = joint == names.end() && equals != std::string::npos;
  const std::string asked = has_value ? arguments.lock.substr(0, equals) : arguments.lock;
  joint = std::find(names.begin(), names.end(), asked);
  if (joint == names.end()) throw unknown_name("joint", asked, names);
  const int k = static_cast<int>(joint - names.begin());
  options.lock = k;
  if (!has_value) return;
  if (!options.seed) options.seed = middle_configuration(arm);
  const double value = parse_number(arguments.lock.substr(equals + 1), "--lock " + asked);
  (*options.seed)[k] = arguments.unit.coordinate(arm, k, value);
}

InverseOptions options_for(const Arguments& arguments, const Arm& arm) {
  InverseOptions options = arguments.options;
  options.task = arguments.task.read(arm);
  options.method = inverse_method_named(arguments.method);
  options.redundancy = redundancy_named(arguments.redundancy);
  if (!arguments.seed.empty()) {
    options.seed = arguments.unit.configuration(arm, arguments.seed, "--seed");
  }
  if (!arguments.lock.empty()) apply_lock(arguments, arm, options);
  return options;
}

/// What the status is about: metres, or an angle in the caller's unit; no unit where it is the
/// larger of both.
struct Residual {
  double value = 0;
  std::string unit;
};

Residual residual_of(const UnitArgument& unit, const Arm& arm, const InverseResult& result) {
  switch (result.status) {
    case InverseStatus::unreachable:
      return {result.residual, " m"};
    case InverseStatus::orientation:
      return {unit.shown(result.residual), fmt::format(" {}", unit.name())};
    case InverseStatus::outside_limits: {
      const int k = result.nearest->blocking;
      const bool slides = kind(arm.joint_of(k)) == JointKind::prismatic;
      return {unit.shown(arm, k, result.residual), fmt::format(" {}", slides ? "m" : unit.name())};
    }
    default:
      return {result.residual, ""};
  }
}

void print_result(const Arguments& arguments, const Arm& arm, const InverseResult& result) {
  const UnitArgument& unit = arguments.unit;
  const Residual residual = residual_of(unit, arm, result);
  fmt::print("{}: {} solution{}{} by {}, residual {}{}\n", name(result.status),
             result.solutions.size(), result.solutions.size() == 1 ? "" : "s",
             result.complete ? ", all there are," : "", result.method, shown(residual.value),
             residual.unit);
  for (const Configuration& q : result.solutions) fmt::print("  {}\n", shown(unit.shown(arm, q)));
  if (result.singular) fmt::print("  {}\n", result.reason);
  if (result.nearest) {
    fmt::print("  nearest: q {}; tool at {}\n", shown(unit.shown(arm, result.nearest->q)),
               shown(result.nearest->world_T_tool, arm.planar(), unit));
  }
}

OrderedJson nearest_document(const Arguments& arguments, const Arm& arm,
                             const NearestMiss& nearest) {
  const UnitArgument& unit = arguments.unit;
  OrderedJson document{{"q", json_vector(unit.shown(arm, nearest.q))},
                       {"pose", json_pose(nearest.world_T_tool, arm.planar(), unit)},
                       {"position_error", json_number(nearest.error.position)},
                       {"orientation_error", json_number(unit.shown(nearest.error.orientation))}};
  if (nearest.blocking >= 0) {
    document["joint"] = arm.joint_of(nearest.blocking).name;
    document["excess"] = json_number(unit.shown(arm, nearest.blocking, nearest.excess));
  }
  return document;
}

OrderedJson result_document(const Arguments& arguments, const Arm& arm,
                            const InverseResult& result) {
  OrderedJson solutions = OrderedJson::array();
  for (const Configuration& q : result.solutions) {
    solutions.push_back(json_vector(arguments.unit.shown(arm, q)));
  }
  OrderedJson nearest;
  if (result.nearest) nearest = nearest_document(arguments, arm, *result.nearest);
  return {{"status", name(result.status)},
          {"solutions", solutions},
          {"singular", result.singular},
          {"complete", result.complete},
          {"residual", json_number(residual_of(arguments.unit, arm, result).value)},
          {"reason", result.reason},
          {"nearest", nearest},
          {"method", result.method},
          {"iterations", result.iterations},
          {"restarts", result.restarts}};
}

Exit inverse(const Arguments& arguments) {
  const Arm arm = arguments.arm.read();
  const WrittenPose goal = parse_pose(arguments.pose, arguments.unit.angle_unit());
  const InverseOptions options = options_for(arguments, arm);
  check_pose_form(arm, goal, arguments.task, "--pose");
  const InverseResult result = inverse_kinematics(arm, goal.pose, options);
  if (arguments.json) {
    print_json(result_document(arguments, arm, result));
  } else {
    print_result(arguments, arm, result);
  }
  const bool solved = result.status == InverseStatus::solved;
  if (solved && result.residual > options.tolerance) {
    fmt::print(stderr,
               "beeline: warning: rounding at this arm's size limits the error to {} m or rad\n",
               shown(result.residual));
  }
  if (!solved) fmt::print(stderr, "beeline: {}\n", result.reason);
  return solved ? Exit::yes : Exit::no;
}

void declare_choices(CLI::App& verb, Arguments& arguments) {
  InverseOptions& options = arguments.options;
  CLI::Option* all =
      verb.add_flag("--all", options.all, "Every solution found, nearest to the seed first");
  verb.add_flag("--every-turn", options.every_turn,
                "With --all: the same posture by every turn within limits")
      ->needs(all);
  verb.add_flag("--ignore-limits", options.ignore_limits, "Joint limits do not count");
  verb.add_option("--lock", arguments.lock,
                  "NAME or NAME=VALUE: this joint stays at the seed's value, or at this one");
  verb.add_option("--redundancy", arguments.redundancy,
                  "With a joint to spare, which of infinitely many solutions: any, the nearest\n"
                  "to the seed, or the one most centred between the limits")
      ->capture_default_str();
  verb.add_option("--grid", options.grid, "Values of the joint to spare that are tried first")
      ->capture_default_str();
}

void declare_search(CLI::App& verb, Arguments& arguments) {
  InverseOptions& options = arguments.options;
  verb.add_option("--method", arguments.method,
                  "automatic, closed_form (all solutions by formulas; an error where the arm\n"
                  "has none) or numerical (descents from the seed and from elsewhere)")
      ->capture_default_str();
  verb.add_option("--tolerance", options.tolerance, "Largest error, metres and radians")
      ->capture_default_str();
  verb.add_option("--iterations", options.iterations, "Most steps of the numerical solver in a try")
      ->capture_default_str();
  verb.add_option("--restarts", options.restarts, "Most tries from random configurations")
      ->capture_default_str();
  verb.add_option("--random-seed", options.random_seed, "The same seed gives the same answer")
      ->check(whole_number)
      ->capture_default_str();
  verb.add_option("--time-limit", options.time_limit,
                  "Seconds after which a numerical search ends with what it has");
}

}  // namespace

Run declare_ik(CLI::App& verb) {
  static Arguments arguments;
  arguments.arm.declare(verb);
  verb.add_option("--pose", arguments.pose,
                  "x,y,theta (planar arms), x,y,z,roll,pitch,yaw or x,y,z,qw,qx,qy,qz")
      ->required();
  verb.add_option("--seed", arguments.seed, "Joint values to be near to (default: the middle)");
  arguments.unit.declare(verb);
  arguments.task.declare(verb);
  declare_choices(verb, arguments);
  declare_search(verb, arguments);
  verb.add_flag("--json", arguments.json, "Print JSON");
  verb.footer(
      "Examples:\n"
      "  beeline ik rrr --pose 4.459,5.226,0 --all --degrees\n"
      "  beeline ik panda --pose 0.4,0.1,0.5,3.14159,0,0 --json\n"
      "  beeline ik puma560 --pose 0.3,0.2,0.4,180,0,0 --degrees --all --every-turn\n"
      "  beeline ik ur5 --pose 0.4,0.2,0.3,3.14,0,0 --method numerical --time-limit 0.01\n"
      "  beeline ik panda --pose 0.4,0.1,0.5,180,0,0 --degrees --redundancy centred\n"
      "  beeline ik panda --pose 0.4,0.1,0.5,180,0,0 --degrees --lock joint7=45 --all");
  return [] { return inverse(arguments); };
}
