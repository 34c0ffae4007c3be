#include <algorithm>
#include <fmt/core.h>

#include <beeline/control/cartesian.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/move_along.h>
#include <beeline/read/pose_list.h>

#include "line_report.h"
#include "path_argument.h"
#include "progress.h"
#include "results.h"
#include "verb.h"

using namespace beeline;

namespace {

struct Arguments {
  ArmArgument arm;
  UnitArgument unit;
  TaskArgument task;
  PathArgument path;
  std::string from, through, law, method = "exact";
  PathMotionOptions options;
  CartesianOptions control;
  ResultFiles files;
  bool branches = false, json = false;
  std::vector<const CLI::Option*> exact_options, control_options;
};

/// Refuses an option that the chosen method would ignore.
void check_method(const Arguments& arguments) {
  const std::vector<std::string> methods{"exact", name(CartesianMethod::inverse_jacobian),
                                         name(CartesianMethod::inverse_kinematics)};
  if (std::find(methods.begin(), methods.end(), arguments.method) == methods.end()) {
    throw unknown_name("method", arguments.method, methods);
  }
  const bool exact = arguments.method == "exact";
  for (const CLI::Option* option : exact ? arguments.control_options : arguments.exact_options) {
    if (option->count() == 0) continue;
    throw Error(option->get_name() + " does not go with --method " + arguments.method);
  }
}

LineReport follow_exactly(const Arguments& arguments, const Arm& arm,
                          const std::optional<Configuration>& start, const std::vector<Pose>& poses,
                          const Task& task) {
  Progress progress;
  PathMotionOptions options = arguments.options;
  options.task = task;
  if (!arguments.law.empty()) options.profile = profile_named(arguments.law);
  options.progress = [&progress](double share) { progress.show(share); };
  options.suggest = true;
  const Route route = start ? arguments.path.from(forward_kinematics(arm, *start), poses, task)
                            : arguments.path.through(poses);
  PathMotion motion = move_along(arm, start, route, options);
  const Deviation tolerance{options.tolerance, options.orientation_tolerance};
  LineReport report;
  report.status = motion.status;
  report.reason = std::move(motion.reason);
  report.trajectory = std::move(motion.trajectory);
  report.deviation = motion.deviation;
  report.limits = motion.limits;
  report.limit_margin = motion.limit_margin;
  report.dexterity = motion.dexterity;
  report.nearby = std::move(motion.nearby);
  if (report.status == MotionStatus::reached) {
    report.path = {std::move(motion.path), std::move(motion.path_parameters), task, tolerance};
  }
  if (arguments.branches) {
    report.branches = branch_map(arm, route.path, {.task = task, .tolerance = tolerance});
  }
  return report;
}

LineReport follow_by_control(const Arm& arm, const Configuration& start,
                             const std::vector<Pose>& waypoints, const CartesianOptions& options) {
  ControlledMotion motion = control_in_lines(arm, start, waypoints, options);
  LineReport report;
  report.status = motion.status;
  report.reason = motion.reason;
  report.trajectory = std::move(motion.trajectory);
  report.steps = motion.steps;
  report.overshoot = motion.overshoot;
  if (report.status == MotionStatus::reached) {
    const Task task = options.task.value_or(default_task(arm));
    std::vector<Pose> poses = waypoints;
    poses.insert(poses.begin(), forward_kinematics(arm, start));
    const auto& samples = report.trajectory.positions;
    const ToolPath path = lines_through(poses);
    const auto path_parameters = path_parameters_along(arm, samples, path, motion.arrivals, task);
    report.path = {path, path_parameters, task};
    report.deviation = path_deviation(arm, samples, path_parameters, path, task);
  }
  return report;
}

LineReport follow(const Arguments& arguments, const Arm& arm, const std::vector<Pose>& waypoints) {
  std::optional<Configuration> start;
  if (!arguments.from.empty()) {
    start = arguments.unit.configuration(arm, arguments.from, "--from");
  }
  const Task task = arguments.task.read(arm);
  if (arguments.method == "exact") return follow_exactly(arguments, arm, start, waypoints, task);
  if (!start) throw Error("--method " + arguments.method + " needs --from");
  CartesianOptions options = arguments.control;
  options.task = task;
  options.method = arguments.method == name(CartesianMethod::inverse_jacobian)
                       ? CartesianMethod::inverse_jacobian
                       : CartesianMethod::inverse_kinematics;
  return follow_by_control(arm, *start, waypoints, options);
}

Exit line(const Arguments& arguments) {
  arguments.files.check({arguments.arm.text, arguments.through});
  check_method(arguments);
  const Arm arm = arguments.arm.read();
  const PoseList waypoints = read_waypoints(arguments.through, arm, arguments.task, arguments.unit);
  LineReport report = follow(arguments, arm, waypoints.poses);
  report.method = arguments.method;
  report.waypoints = waypoints.poses.size();
  const bool reached = report.status == MotionStatus::reached;
  if (reached) arguments.files.write(arm, report.trajectory, waypoints.poses, report.path);
  if (arguments.json) {
    print_json(json_report(arm, report, arguments.unit, arguments.files));
  } else {
    print_report(arm, report, arguments.unit, arguments.files);
  }
  if (!reached) fmt::print(stderr, "beeline: {}\n", report.reason);
  return reached ? Exit::yes : Exit::no;
}

}  // namespace

Run declare_line(CLI::App& verb) {
  static Arguments arguments;
  PathMotionOptions& options = arguments.options;
  CartesianOptions& control = arguments.control;
  arguments.arm.declare(verb);
  verb.add_option(
      "--from", arguments.from,
      "Joint values at the start; without it the motion begins at the first pose, with\n"
      "the joint values that are best for the whole way");
  verb.add_option("--through", arguments.through,
                  "Poses, a CSV file with the header x,y,theta (planar arms),\n"
                  "x,y,z,roll,pitch,yaw or x,y,z,qw,qx,qy,qz")
      ->required();
  arguments.unit.declare(verb);
  arguments.task.declare(verb);
  verb.add_option("--method", arguments.method,
                  "exact: every sample on the line, the rest bounded by proof;\n"
                  "inverse-jacobian: feedback by eq. 1.6; inverse-kinematics: solutions at\n"
                  "intermediate poses, joint control (eq. 1.3) between them")
      ->capture_default_str();
  arguments.exact_options = {
      verb.add_option("--tolerance", options.tolerance,
                      "exact: most deviation between samples, metres")
          ->capture_default_str(),
      verb.add_option("--orientation-tolerance", options.orientation_tolerance,
                      "exact: most turn away from the path, radians")
          ->capture_default_str(),
      verb.add_option(
          "--law", arguments.law,
          "exact: of time, from stop to stop: fastest, jerk, trapezoidal, quintic or s-curve;\n"
          "see time --help"),
      verb.add_option("--rate", options.rate,
                      "exact: samples a second (default: as few as the tolerance needs)"),
      verb.add_flag(
          "--branches", arguments.branches,
          "exact: also list what becomes of every solution for the first pose: how far it\n"
          "goes, how near to limits and singularities, and why it ends"),
      verb.add_option("--tool-speed", options.tool_speed, "exact: most speed of the tool, m/s"),
      verb.add_option("--most-samples", options.max_samples,
                      "exact: samples after which to give up")
          ->capture_default_str()};
  for (const CLI::Option* option : arguments.path.declare(verb, "exact: ")) {
    arguments.exact_options.push_back(option);
  }
  arguments.control_options = {
      verb.add_option("--gain", control.gain, "feedback: K_p")->capture_default_str(),
      verb.add_option("--intermediate", control.intermediate,
                      "inverse-kinematics: poses on each line")
          ->capture_default_str(),
      verb.add_option("--time-step", control.simulation.time_step, "feedback: seconds a step")
          ->capture_default_str(),
      verb.add_option("--most-steps", control.simulation.max_steps,
                      "feedback: steps after which to give up")
          ->capture_default_str()};
  arguments.files.declare(verb);
  verb.add_flag("--json", arguments.json, "Print JSON");
  verb.footer(
      "Examples:\n"
      "  beeline line rrr --from 0,90,0 --degrees --through waypoints.csv --out move.csv "
      "--draw move.svg\n"
      "  beeline line panda --through poses.csv --round 0.02 --out move.csv\n"
      "  beeline line panda --through poses.csv --law s-curve --rate 250 --out move.csv\n"
      "  beeline line robot.urdf --tip tool0 --from 0,-1,1,0,1,0 --through poses.csv --json\n"
      "  beeline line rrr --from 0,90,0 --degrees --through waypoints.csv "
      "--method inverse-jacobian --gain 0.5");
  return [] { return line(arguments); };
}
