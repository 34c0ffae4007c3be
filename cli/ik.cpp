#include <algorithm>
#include <fmt/core.h>

#include <beeline/error.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/read/pose_list.h>

#include "inverse_argument.h"
#include "output.h"
#include "verb.h"

using namespace beeline;

namespace {

struct Arguments {
  ArmArgument arm;
  UnitArgument unit;
  std::string pose;
  InverseArgument inverse;
  bool json = false;
};

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
    case InverseStatus::orientation_unreachable:
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

Exit ik(const Arguments& arguments) {
  const Arm arm = arguments.arm.read();
  const WrittenPose goal = parse_pose(arguments.pose, arguments.unit.angle_unit());
  const InverseOptions options = arguments.inverse.read(arm, arguments.unit);
  check_pose_form(arm, goal, arguments.inverse.task, "--pose");
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

}  // namespace

Run declare_ik(CLI::App& verb) {
  static Arguments arguments;
  arguments.arm.declare(verb);
  verb.add_option("--pose", arguments.pose,
                  "x,y,theta (planar arms), x,y,z,roll,pitch,yaw or x,y,z,qw,qx,qy,qz")
      ->required();
  arguments.unit.declare(verb);
  InverseArgument& inverse = arguments.inverse;
  CLI::Option* all = verb.add_flag("--all", inverse.options.all,
                                   "Every solution found, nearest to the seed first");
  verb.add_flag("--every-turn", inverse.options.every_turn,
                "With --all: the same posture by every turn within limits")
      ->needs(all);
  inverse.declare_choices(verb);
  inverse.declare_search(verb);
  verb.add_flag("--json", arguments.json, "Print JSON");
  verb.footer(
      "Examples:\n"
      "  beeline ik rrr --pose 4.459,5.226,0 --all --degrees\n"
      "  beeline ik panda --pose 0.4,0.1,0.5,3.14159,0,0 --json\n"
      "  beeline ik puma560 --pose 0.3,0.2,0.4,180,0,0 --degrees --all --every-turn\n"
      "  beeline ik ur5 --pose 0.4,0.2,0.3,3.14,0,0 --method numerical --time-limit 0.01\n"
      "  beeline ik panda --pose 0.4,0.1,0.5,180,0,0 --degrees --redundancy centred\n"
      "  beeline ik panda --pose 0.4,0.1,0.5,180,0,0 --degrees --lock joint7=45 --all");
  return [] { return ik(arguments); };
}
