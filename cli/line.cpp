#include <algorithm>
#include <fmt/core.h>

#include <beeline/control/cartesian.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/motion/along.h>
#include <beeline/motion/line.h>
#include <beeline/motion/path/corner.h>
#include <beeline/read/pose_list.h>

#include "line_report.h"
#include "progress.h"
#include "results.h"
#include "verb.h"

using namespace beeline;

namespace {

struct Arguments {
  ArmArgument arm;
  UnitArgument unit;
  TaskArgument task;
  std::string from, through, law, path = "line", method = "exact";
  std::optional<double> round;
  LineOptions options;
  CartesianOptions control;
  ResultFiles files;
  bool branches = false, json = false;
  std::vector<const CLI::Option*> exact_options, control_options;
};

constexpr double rounding_turn = 0.2;  // metres that count as a radian

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

LineReport report_of(LineMotion motion) {
  LineReport report;
  report.status = motion.status;
  report.reason = std::move(motion.reason);
  report.trajectory = std::move(motion.trajectory);
  report.straightness = motion.straightness;
  report.limits = motion.limits;
  report.limit_margin = motion.limit_margin;
  report.dexterity = motion.dexterity;
  report.nearby = std::move(motion.nearby);
  return report;
}

LineReport follow_exactly(const Arm& arm, const std::optional<Configuration>& start,
                          const std::vector<Pose>& waypoints, LineOptions options) {
  Progress progress;
  options.progress = [&progress](double share) { progress.show(share); };
  options.suggest = true;
  LineMotion motion = start ? move_in_lines(arm, *start, waypoints, options)
                            : move_in_lines(arm, waypoints, options);
  const std::vector<std::size_t> arrivals = motion.arrivals;
  LineReport report = report_of(std::move(motion));
  if (report.status == MotionStatus::reached) {
    report.lines = {waypoints, arrivals, options.task.value_or(default_task(arm)),
                    Deviation{options.tolerance, options.orientation_tolerance}};
  }
  return report;
}

/// Arcs, screws, splines, and lines with rounded corners.
LineReport follow_route(const Arguments& arguments, const Arm& arm,
                        const std::optional<Configuration>& start, const std::vector<Pose>& poses,
                        const LineOptions& options) {
  const PathKind kind = path_kind_named(arguments.path);
  if (arguments.round && kind != PathKind::line) {
    throw Error("--round goes with --path line, whose corners it rounds");
  }
  if (options.rate > 0) throw Error("--rate goes with straight lines without --round only");
  Route route;
  if (arguments.round) {
    const double turn = *arguments.round / rounding_turn;
    route = route_of(rounded_lines(poses, {*arguments.round, turn}));
  } else {
    route = route_of(path_through(poses, kind), kind);
  }
  return report_of(move_along(arm, start, route, options));
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
    report.lines = {waypoints, motion.arrivals, task};
    report.straightness =
        straightness(arm, report.trajectory.positions, waypoints, motion.arrivals, task);
  }
  return report;
}

LineReport follow(const Arguments& arguments, const Arm& arm, const std::vector<Pose>& waypoints) {
  std::optional<Configuration> start;
  if (!arguments.from.empty()) {
    start = arguments.unit.configuration(arm, arguments.from, "--from");
  }
  const Task task = arguments.task.read(arm);
  if (arguments.method == "exact") {
    LineOptions options = arguments.options;
    options.task = task;
    if (!arguments.law.empty()) options.law = law_named(arguments.law);
    std::vector<Pose> poses = waypoints;
    if (start) poses.insert(poses.begin(), forward_kinematics(arm, *start));
    if (arguments.round || arguments.path != "line") {
      if (arguments.branches) throw Error("--branches goes with straight lines without --round");
      return follow_route(arguments, arm, start, poses, options);
    }
    LineReport report = follow_exactly(arm, start, waypoints, options);
    if (arguments.branches) {
      report.branches = branch_map(
          arm, poses,
          {.task = task, .tolerance = {options.tolerance, options.orientation_tolerance}});
    }
    return report;
  }
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
  if (reached) arguments.files.write(arm, report.trajectory, waypoints.poses, report.lines);
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
  LineOptions& options = arguments.options;
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
                      "exact: most turn away from the line, radians")
          ->capture_default_str(),
      verb.add_option(
              "--path", arguments.path,
              "exact: line; screw motions between the poses; arc, each through two more\n"
              "poses, of the first of which the position counts; or spline through them all")
          ->capture_default_str(),
      verb.add_option(
          "--round", arguments.round,
          "exact: round the lines' corners and pass them without a stop, at no more than\n"
          "this from them, metres, and 5 rad for each metre"),
      verb.add_option(
          "--law", arguments.law,
          "exact: of time on each line: fastest, jerk, trapezoidal, quintic or s-curve;\n"
          "see time --help"),
      verb.add_option("--rate", options.rate,
                      "exact: samples a second (default: as few as the tolerance needs)"),
      verb.add_flag(
          "--branches", arguments.branches,
          "exact: also list what becomes of every solution for the first pose: how far it\n"
          "goes, how near to limits and singularities, and why it ends"),
      verb.add_option("--tool-speed", options.tool_speed, "exact: most speed of the tool, m/s"),
      verb.add_option("--most-samples", options.most_samples,
                      "exact: samples after which to give up")
          ->capture_default_str()};
  arguments.control_options = {
      verb.add_option("--gain", control.gain, "feedback: K_p")->capture_default_str(),
      verb.add_option("--intermediate", control.intermediate,
                      "inverse-kinematics: poses on each line")
          ->capture_default_str(),
      verb.add_option("--time-step", control.simulation.time_step, "feedback: seconds a step")
          ->capture_default_str(),
      verb.add_option("--most-steps", control.simulation.most_steps,
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
