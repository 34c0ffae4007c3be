#include <cmath>
#include <fmt/core.h>

#include <beeline/error.h>
#include <beeline/kinematics/manipulability.h>

#include "arm_argument.h"
#include "format.h"
#include "verbs.h"

using namespace beeline;

namespace {

struct JacobianArguments {
  ArmArgument arm;
  UnitArgument unit;
  JacobianArgument jacobian;
  std::string q;
  bool json = false;
};

const char* frame_meaning(Frame frame) {
  switch (frame) {
    case Frame::base:
      return "velocity of the tool origin, in the world's axes";
    case Frame::tool:
      return "velocity of the tool origin, in the tool's axes";
    case Frame::space:
      return "spatial twist, at the world's origin";
  }
  return "";
}

Answer differential_kinematics(const JacobianArguments& arguments) {
  const Arm arm = arguments.arm.read(arguments.unit);
  const Configuration q = arguments.arm.configuration(arm, arguments.q, "--q", arguments.unit);
  const Task task = arguments.jacobian.read(arm);
  warn_outside_limits(arm, q);
  const Eigen::MatrixXd matrix = task_jacobian(arm, q, task);
  if (!std::isfinite(matrix.squaredNorm())) {
    throw Error("--q: the Jacobian exceeds the range of numbers, 1e308");
  }
  const ManipulabilityMeasures measures = manipulability_measures(matrix);
  const std::vector<std::string> rows = row_names({task.rows, Frame::base});
  const std::string& frame = arguments.jacobian.frame;
  Answer answer;
  answer.document = {{"frame", frame},
                     {"rows", rows},
                     {"columns", arm.joint_names()},
                     {"jacobian", json_matrix(matrix)},
                     {"singular_values", measures.singular_values},
                     {"manipulability", measures.manipulability},
                     {"condition", measures.condition}};
  answer.units = {{"jacobian", jacobian_units}};
  answer.text = fmt::format("Jacobian in the {} frame: {}\n", frame, frame_meaning(task.frame)) +
                fmt::format("(a column for each joint: {})\n", listed(arm.joint_names())) +
                matrix_text(matrix, rows) +
                fmt::format("singular values  {}\n", shown(measures.singular_values)) +
                fmt::format("manipulability   {}\n", shown(measures.manipulability)) +
                fmt::format("condition        {}\n", shown(measures.condition));
  return answer;
}

}  // namespace

Verb jacobian_verb() {
  static JacobianArguments arguments;
  Option q = joint_values_option(
      "--q", "Joint values, comma-separated, from the base on; metres for a prismatic joint.",
      &arguments.q);
  q.required = true;
  return {
      .name = "jacobian",
      .summary = "The Jacobian, its singular values and manipulability",
      .description =
          "Computes the Jacobian that maps joint velocities to the velocity of the tool: rows "
          "vx vy vz wx wy wz in m/s and rad/s, or x y theta for a planar arm; one column for "
          "each joint, per rad/s or m/s of that joint, also with --degrees. Prints its "
          "singular values, their product (manipulability) and the ratio of the largest to "
          "the smallest (condition number, null in JSON if infinite).",
      .arguments = {arguments.arm.argument()},
      .options = joined(
          {{q}, arguments.unit.options(), arguments.jacobian.options(), arguments.arm.options()}),
      .examples = {{"The columns drawn in figure 1.8 of the chapter",
                    "beeline jacobian rrr --q 0,90,0 --degrees"},
                   {"The body Jacobian of a Franka Panda, as JSON",
                    "beeline jacobian panda --q 0,-0.785,0,-2.356,0,1.571,0.785 --frame tool "
                    "--json"}},
      .json = &arguments.json,
      .run = [] { return differential_kinematics(arguments); }};
}
