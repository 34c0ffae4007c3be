#include <fmt/core.h>

#include <beeline/certificate/verify.h>
#include <beeline/draw/canvas.h>
#include <beeline/draw/timing_figure.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/read/file.h>
#include <beeline/read/pose_list.h>

#include "path_argument.h"
#include "results.h"
#include "verb.h"

using namespace beeline;

namespace {

struct Arguments {
  std::string trajectory;
  ArmArgument arm;
  UnitArgument unit;
  TaskArgument task;
  PathArgument path;
  std::string through, plot;
  VerifyOptions options;
  bool json = false;
};

/// The motion beside its limits, along its path as far as it follows that.
void draw_plot(const Arguments& arguments, const Arm& arm, const Trajectory& trajectory,
               const Verification& found, const VerifyOptions& options) {
  const Deviation tolerance{options.tolerance, options.orientation_tolerance};
  const FollowedPath path{found.path, found.path_parameters, *options.task, tolerance};
  const Drawing drawing = timing_figure(arm, trajectory, {.path = path});
  write_file(arguments.plot, render(drawing, format_of(arguments.plot)));
}

OrderedJson document(const Arguments& arguments, const Verification& found, std::size_t samples) {
  const bool passed = found.fault == Fault::none;
  OrderedJson document{{"status", passed ? "passed" : "failed"},
                       {"fault", passed ? OrderedJson(nullptr) : OrderedJson(name(found.fault))},
                       {"sample", passed ? OrderedJson(nullptr) : OrderedJson(found.sample + 1)},
                       {"time", passed ? OrderedJson(nullptr) : OrderedJson(found.time)}};
  add_deviation(document, found.deviation, arguments.unit);
  document["samples"] = samples;
  document["reason"] = found.reason;
  for (const std::size_t arrival : found.arrivals) document["arrivals"].push_back(arrival + 1);
  if (!arguments.plot.empty()) document["plot"] = arguments.plot;
  return document;
}

Exit check(const Arguments& arguments) {
  if (!arguments.plot.empty()) {
    format_of(arguments.plot);
    refuse_overwriting(arguments.plot,
                       {arguments.arm.text, arguments.trajectory, arguments.through});
  }
  const Arm arm = arguments.arm.read();
  const Trajectory trajectory = read_recording(arguments.trajectory, arm);
  const PoseList waypoints = read_waypoints(arguments.through, arm, arguments.task, arguments.unit);
  VerifyOptions options = arguments.options;
  options.task = arguments.task.read(arm);
  if (trajectory.size() == 0) throw FileError(arguments.trajectory, 0, "has no samples");
  const Pose begin = forward_kinematics(arm, trajectory.positions.front());
  const Route route = arguments.path.from(begin, waypoints.poses, *options.task);
  const Verification found = verify(arm, trajectory, route, options);
  const bool passed = found.fault == Fault::none;
  if (!arguments.plot.empty()) draw_plot(arguments, arm, trajectory, found, options);
  if (arguments.json) {
    print_json(document(arguments, found, trajectory.size()));
  } else {
    fmt::print("{}: {} samples through {} waypoint{}\n", passed ? "passed" : "failed",
               trajectory.size(), waypoints.poses.size(), waypoints.poses.size() == 1 ? "" : "s");
    if (passed) print_deviation(found.deviation, arguments.unit);
    if (!passed) fmt::print("fault         {}\n", name(found.fault));
    if (!arguments.plot.empty()) fmt::print("plot          {}\n", arguments.plot);
  }
  if (!passed) fmt::print(stderr, "beeline: {}\n", found.reason);
  return passed ? Exit::yes : Exit::no;
}

}  // namespace

Run declare_check(CLI::App& verb) {
  static Arguments arguments;
  VerifyOptions& options = arguments.options;
  verb.add_option("FILE", arguments.trajectory, "A trajectory: .csv or .json")->required();
  arguments.arm.declare(verb);
  verb.add_option("--through", arguments.through,
                  "The poses that it should go through, after its own first one: see line --help")
      ->required();
  arguments.unit.declare(verb);
  arguments.task.declare(verb);
  arguments.path.declare(verb);
  verb.add_option("--tolerance", options.tolerance, "Most deviation from the path, metres")
      ->capture_default_str();
  verb.add_option("--orientation-tolerance", options.orientation_tolerance,
                  "Most turn away from it, radians")
      ->capture_default_str();
  verb.add_option("--plot", arguments.plot,
                  "Draw the joints over time, and the deviation along the path, to this file:\n"
                  ".svg, .png or .pdf");
  verb.add_flag("--json", arguments.json, "Print JSON");
  verb.footer(
      "Proves, from the file alone, that the tool goes in straight lines through the poses, or on\n"
      "the path that --path or --round names, and the joints keep their limits, whoever made the\n"
      "file; joints move in proportion between its samples. Exit code 1, and the first fault with "
      "its place, when it does not.\n"
      "The trajectory's own values are radians and metres; --degrees is for the poses.\n"
      "Examples:\n"
      "  beeline check move.csv rrr --through waypoints.csv\n"
      "  beeline check move.csv panda --through poses.csv --path spline --plot check.svg\n"
      "  beeline check recorded.json robot.urdf --through poses.csv --tolerance 0.001 --json");
  return [] { return check(arguments); };
}
