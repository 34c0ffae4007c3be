#include <cmath>
#include <fmt/core.h>

#include <beeline/error.h>
#include <beeline/kinematics/manipulability.h>

#include "output.h"
#include "verb.h"

using namespace beeline;

namespace {

struct Arguments {
  ArmArgument arm;
  UnitArgument unit;
  TaskArgument task;
  std::string q;
  std::string frame = "base";
  bool json = false;
};

const char* meaning(Frame frame) {
  switch (frame) {
    case Frame::base:
      return "velocity of the tool's origin, in the world's axes";
    case Frame::tool:
      return "velocity of the tool's origin, in the tool's axes";
    case Frame::space:
      return "spatial twist, taken at the world's origin";
  }
  return "";
}

Exit differential(const Arguments& arguments) {
  const Arm arm = arguments.arm.read();
  const Configuration q = arguments.unit.configuration(arm, arguments.q, "--q");
  Task task = arguments.task.read(arm);
  if (task.frame == Frame::tool && arguments.frame != "tool") {
    throw Error("the task's :tool does not go with --frame " + arguments.frame);
  }
  task.frame = frame_named(arguments.frame);
  warn_outside_limits(arm, q);
  const Eigen::MatrixXd matrix = task_jacobian(arm, q, task);
  if (!std::isfinite(matrix.squaredNorm()))
    throw Error("--q: the tool is farther away than a number can tell");
  const Dexterity dexterous = dexterity(matrix);
  const std::vector<std::string> rows = row_names({task.rows, Frame::base});
  if (arguments.json) {
    print_json({{"frame", arguments.frame},
                {"rows", rows},
                {"columns", arm.joint_names()},
                {"jacobian", json_matrix(matrix)},
                {"singular_values", json_vector(dexterous.singular_values)},
                {"manipulability", json_number(dexterous.manipulability)},
                {"condition", json_number(dexterous.condition)}});
    return Exit::yes;
  }
  fmt::print("Jacobian in the {} frame: {}\n", arguments.frame, meaning(task.frame));
  fmt::print("(a column for each joint: {})\n", listed(arm.joint_names()));
  print_matrix(matrix, rows);
  fmt::print("singular values  {}\n", shown(dexterous.singular_values));
  fmt::print("manipulability   {}\n", shown(dexterous.manipulability));
  fmt::print("condition        {}\n", shown(dexterous.condition));
  return Exit::yes;
}

}  // namespace

Run declare_jacobian(CLI::App& verb) {
  static Arguments arguments;
  arguments.arm.declare(verb);
  verb.add_option("--q", arguments.q, "Joint values, comma-separated; metres where a joint slides")
      ->required();
  arguments.unit.declare(verb);
  verb.add_option("--frame", arguments.frame, "base, tool or space")->capture_default_str();
  arguments.task.declare(verb);
  verb.add_flag("--json", arguments.json, "Print JSON; a condition that is infinite is null");
  verb.footer(
      "Entries are per radian, or per metre of a joint that slides, also with --degrees.\n"
      "Examples:\n"
      "  beeline jacobian rrr --q 0,90,0 --degrees\n"
      "  beeline jacobian panda --q 0,-0.785,0,-2.356,0,1.571,0.785 --frame tool --json");
  return [] { return differential(arguments); };
}
