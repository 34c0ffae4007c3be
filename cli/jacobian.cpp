#include <cmath>
#include <fmt/format.h>
#include <memory>

#include <beeline/error.h>
#include <beeline/io/text/numbers.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/kinematics/manipulability.h>

#include "arm_argument.h"
#include "format.h"
#include "rates_argument.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct JacobianArguments {
  ArmArgument arm;
  UnitArgument unit;
  JacobianArgument jacobian;
  std::string q, derivative, second_derivative, wrench, analytical;
  RatesArgument rates;
  bool hessian = false, gradient = false, ellipsoids = false;
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

constexpr const char* jacobian_rate_units = "m/s or rad/s of the tool, per rad or m of the joint";

/// An arm in a configuration, and the rows that are asked for.
struct ArmState {
  const Arm& arm;
  const Configuration& q;
  const Task& task;
  std::vector<std::string> rows;  ///< their names
};

/// Throws Error where a result exceeds the range of numbers.
template <class Matrix>
const Matrix& finite(const Matrix& matrix, const char* what, const std::string& option = "--q") {
  if (matrix.allFinite()) return matrix;
  throw Error(option + ": the " + what + " exceeds the range of numbers, 1e308");
}

/// The linear or the angular ones of the task's rows.
Task part_of(const Task& task, bool linear) {
  Task part = task;
  for (std::size_t i = 0; i < 6; ++i) part.rows[i] = task.rows[i] && (i < 3) == linear;
  return part;
}

/// The manipulability of the linear rows and of the angular rows, beside all rows.
void add_parts(const ArmState& state, Answer& answer) {
  for (const bool linear : {true, false}) {
    const Task part = part_of(state.task, linear);
    if (part.size() == 0 || part.size() == state.task.size()) continue;
    const double measure =
        manipulability_measures(task_jacobian(state.arm, state.q, part)).manipulability;
    const std::string name = linear ? "translational" : "rotational";
    answer.document.add("manipulability_" + name, measure);
    answer.text += fmt::format("  {:<15}{}\n", name, shown(measure));
  }
}

void add_derivative(const JacobianArguments& arguments, const ArmState& state, Answer& answer) {
  if (arguments.derivative.empty()) return;
  const auto& unit = arguments.unit;
  const Configuration dq = unit.joint_rates(state.arm, arguments.derivative, "--derivative");
  Configuration ddq = Configuration::Zero(state.arm.dof());
  if (!arguments.second_derivative.empty()) {
    ddq = unit.joint_rates(state.arm, arguments.second_derivative, "--second-derivative");
  }
  const Frame frame = state.task.frame;
  const Eigen::MatrixXd derivative =
      selected_rows(state.task, jacobian_derivative(state.arm, state.q, dq, frame));
  const Eigen::VectorXd velocity = task_jacobian(state.arm, state.q, state.task) * dq;
  const Eigen::VectorXd acceleration =
      task_rows(state.task, tool_acceleration(state.arm, state.q, dq, ddq, frame));
  finite(derivative, "time derivative of the Jacobian", "--derivative");
  finite(acceleration, "acceleration", "--derivative");
  answer.document.add("derivative", json_matrix(derivative));
  answer.document.add("velocity", velocity);
  answer.document.add("acceleration", acceleration);
  answer.units.add("derivative", jacobian_rate_units);
  answer.units.add("velocity", "m/s, rad/s");
  answer.units.add("acceleration", "m/s^2, rad/s^2");
  // In moving axes J ddq + J' dq is not the components of the tool's acceleration.
  const char* meaning = frame == Frame::base ? "acceleration" : "its derivative";
  answer.text += "time derivative of the Jacobian\n" + matrix_text(derivative, state.rows) +
                 fmt::format("velocity         {}   (J dq, m/s and rad/s)\n", shown(velocity)) +
                 fmt::format("{:<17}{}   (J ddq + J' dq)\n", meaning, shown(acceleration));
}

void add_hessian(const ArmState& state, Answer& answer) {
  const Hessian derivatives = finite(hessian(state.arm, state.q, state.task.frame), "Hessian");
  const int n = state.arm.dof();
  Json blocks;
  for (int k = 0; k < n; ++k) {
    const Eigen::MatrixXd block = selected_rows(state.task, derivatives.middleCols(k * n, n));
    blocks.append(json_matrix(block));
    answer.text += fmt::format("derivative with respect to {}\n", state.arm.joint_of(k).name) +
                   matrix_text(block, state.rows);
  }
  answer.document.add("hessian", blocks);
  answer.units.add("hessian", "m or rad of the tool, per (rad or m of the joints)^2");
}

void add_gradient(const ArmState& state, Answer& answer) {
  const ManipulabilityGradient found = manipulability_gradient(state.arm, state.q, state.task);
  const Configuration gradient = finite(found.gradient, "gradient");
  if (found.manipulability == 0) {
    answer.document.add("manipulability_gradient", nullptr);
    answer.text += "gradient         not defined, as the manipulability is 0\n";
    return;
  }
  answer.document.add("manipulability_gradient", gradient);
  answer.units.add("manipulability_gradient", "per rad or m of the joint");
  answer.text += fmt::format("gradient         {}   (of the manipulability)\n", shown(gradient));
}

void add_ellipsoids(const ArmState& state, Answer& answer) {
  const Task part = part_of(state.task, state.task.positions() > 0);
  const ManipulabilityEllipsoids found =
      manipulability_ellipsoids(task_jacobian(state.arm, state.q, part));
  const std::vector<std::string> names = row_names({part.rows, Frame::base});
  answer.document.add("ellipsoids", {{"rows", names},
                                     {"axes", json_matrix(found.axes)},
                                     {"velocity", found.velocity},
                                     {"force", found.force}});
  answer.text += "ellipsoids of velocity and force, axes in the columns\n" +
                 matrix_text(found.axes, names) +
                 fmt::format("  velocity       {}\n", shown(found.velocity)) +
                 fmt::format("  force          {}\n", shown(found.force));
}

void add_analytical(const JacobianArguments& arguments, const ArmState& state, Answer& answer) {
  if (arguments.analytical.empty()) return;
  const auto coordinates = orientation_coordinates_named(arguments.analytical);
  const Eigen::MatrixXd matrix = for_option("--analytical " + arguments.analytical, [&] {
    return analytical_jacobian(state.arm, state.q, coordinates);
  });
  finite(matrix, "analytical Jacobian");
  const std::vector<std::string> names = row_names(coordinates);
  answer.document.add("analytical", {{"rows", names}, {"jacobian", json_matrix(matrix)}});
  answer.text += fmt::format("analytical Jacobian: derivatives of position and {} in the world\n",
                             arguments.analytical) +
                 matrix_text(matrix, names);
}

/// The torques for a wrench of three numbers, fx, fy and mz of a planar arm, or of six.
void add_torques(const JacobianArguments& arguments, const ArmState& state, Answer& answer) {
  if (arguments.wrench.empty()) return;
  const std::vector<double> given = parse_numbers(arguments.wrench, "--wrench");
  Twist wrench = Twist::Zero();
  if (given.size() == 3 && state.arm.planar()) {
    wrench << given[0], given[1], 0, 0, 0, given[2];
  } else if (given.size() == 6) {
    for (Eigen::Index i = 0; i < 6; ++i) wrench[i] = given[static_cast<std::size_t>(i)];
  } else {
    throw Error("--wrench needs FX,FY,FZ,MX,MY,MZ" +
                std::string(state.arm.planar() ? ", or FX,FY,MZ" : "") + ", not " +
                counted(static_cast<std::int64_t>(given.size()), "number"));
  }
  const Configuration torques =
      finite(joint_torques(state.arm, state.q, wrench, state.task.frame), "torque", "--wrench");
  answer.document.add("torques", torques);
  answer.units.add("torques", "N m, of a prismatic joint N");
  answer.text +=
      fmt::format("joint torques    {}   (J^T F; N m, of a prismatic joint N)\n", shown(torques));
}

Answer differential_kinematics(const JacobianArguments& arguments) {
  const Arm arm = arguments.arm.read(arguments.unit);
  const Configuration q = arguments.arm.configuration(arm, arguments.q, "--q", arguments.unit);
  const Task task = arguments.jacobian.read(arm);
  warn_outside_limits(arm, q);
  const Eigen::MatrixXd matrix = finite(task_jacobian(arm, q, task), "Jacobian");
  finite(matrix * matrix.transpose(), "Jacobian");
  const ManipulabilityMeasures measures = manipulability_measures(matrix);
  const ArmState state{arm, q, task, row_names({task.rows, Frame::base})};
  const std::string frame = name(task.frame);
  Answer answer;
  answer.document = {{"frame", frame},
                     {"rows", state.rows},
                     {"columns", arm.joint_names()},
                     {"jacobian", json_matrix(matrix)},
                     {"singular_values", measures.singular_values},
                     {"manipulability", measures.manipulability},
                     {"condition", measures.condition}};
  answer.units = {{"jacobian", jacobian_units}};
  const std::string fewer = arm.dof() < task.size()
                                ? fmt::format("   ({} for {})", counted(arm.dof(), "coordinate"),
                                              counted(task.size(), "row"))
                                : "";
  answer.text = fmt::format("Jacobian in the {} frame: {}\n", frame, frame_meaning(task.frame)) +
                fmt::format("(a column for each joint: {})\n", listed(arm.joint_names())) +
                matrix_text(matrix, state.rows) +
                fmt::format("singular values  {}\n", shown(measures.singular_values)) +
                fmt::format("condition        {}\n", shown(measures.condition)) +
                fmt::format("manipulability   {}{}\n", shown(measures.manipulability), fewer);
  add_parts(state, answer);
  if (arguments.gradient) add_gradient(state, answer);
  if (arguments.ellipsoids) add_ellipsoids(state, answer);
  add_derivative(arguments, state, answer);
  if (arguments.hessian) add_hessian(state, answer);
  add_analytical(arguments, state, answer);
  add_torques(arguments, state, answer);
  arguments.rates.add_to(answer, arm, q, task, arguments.unit);
  return answer;
}

std::vector<Option> derivative_options(JacobianArguments& arguments) {
  Option derivative =
      joint_values_option("--derivative",
                          "Joint velocities dq, rad/s, or deg/s with --degrees, or m/s: prints the "
                          "time derivative J' of the Jacobian, the velocity J dq and its "
                          "derivative J' dq: in the base frame the acceleration of the tool.",
                          &arguments.derivative);
  Option second = joint_values_option("--second-derivative",
                                      "Joint accelerations ddq, in the same units per s: the "
                                      "derivative of the velocity is J ddq + J' dq.",
                                      &arguments.second_derivative);
  second.needs = "--derivative";
  return {
      derivative,
      second,
      Option("--hessian", "Prints the derivative of the Jacobian with respect to each coordinate.",
             &arguments.hessian),
      Option("--gradient", "Prints the gradient of the manipulability of all rows.",
             &arguments.gradient),
      Option("--ellipsoids",
             "Prints the principal axes and semi-axes of the ellipsoids of velocity and of force "
             "of the linear rows, or of the angular rows if there are no others.",
             &arguments.ellipsoids),
      Option("--analytical COORDINATES",
             "Prints the analytical Jacobian: the derivatives of the position and of these "
             "coordinates of the orientation, in the world: " +
                 listed(orientation_coordinates_names()) + ".",
             &arguments.analytical, {.choices = orientation_coordinates_names()}),
      Option("--wrench F",
             "Force and moment, N and N m, by which the tool acts on its surroundings, in the axes "
             "of --frame, the moment about the tool's origin or, in the space frame, the world's: "
             "FX,FY,FZ,MX,MY,MZ, or FX,FY,MZ of a planar arm. Prints the joint torques J^T F that "
             "balance it, without gravity.",
             &arguments.wrench)};
}

}  // namespace

Verb jacobian_verb() {
  const auto arguments = std::make_shared<JacobianArguments>();
  return {.name = "jacobian",
          .summary = "The Jacobian, its singular values and manipulability",
          .description =
              "Computes the Jacobian that maps joint velocities to the velocity of the tool: rows "
              "vx vy vz wx wy wz in m/s and rad/s, or x y theta for a planar arm; one column for "
              "each joint, per rad/s or m/s of that joint, also with --degrees. Prints its "
              "singular values, their product (manipulability) and the ratio of the largest to the "
              "smallest (condition number, null in JSON if infinite). With options also its "
              "derivatives, the analytical Jacobian, ellipsoids, joint torques and joint rates.",
          .arguments = {arguments->arm.argument()},
          .options = joined({{configuration_option(&arguments->q)},
                             arguments->unit.options(),
                             arguments->jacobian.options(),
                             derivative_options(*arguments),
                             arguments->rates.options(),
                             arguments->arm.options()}),
          .examples =
              {{"The columns drawn in figure 1.8 of the chapter",
                "beeline jacobian rrr --q 0,90,0 --degrees"},
               {"The body Jacobian of a Franka Panda, as JSON",
                "beeline jacobian panda --q 0,-0.785,0,-2.356,0,1.571,0.785 --frame tool --json"},
               {"The tool's acceleration while joints 1 and 3 of a UR5e move",
                "beeline jacobian ur5e --q 0,-1.2,1.3,-1.5,-1.4,0 --derivative 1,0,0.5,0,0,0"},
               {"The joint rates at which the tool moves down by 0.1 m/s",
                "beeline jacobian ur5e --q 0,-1.2,1.3,-1.5,-1.4,0 --rates-of 0,0,-0.1,0,0,0"},
               {"The torques with which the tool presses down by 10 N",
                "beeline jacobian ur5e --q 0,-1.2,1.3,-1.5,-1.4,0 --wrench 0,0,-10,0,0,0"}},
          .run = [arguments] { return differential_kinematics(*arguments); }};
}

}  // namespace beeline::command
