#include <cmath>
#include <fmt/core.h>

#include <beeline/draw/arm_figure.h>
#include <beeline/draw/canvas.h>
#include <beeline/error.h>
#include <beeline/read/file.h>

#include "results.h"
#include "verb.h"

using namespace beeline;

namespace {

struct Arguments {
  ArmArgument arm;
  UnitArgument unit;
  std::string motion, q, out;
  double azimuth = 0, elevation = 0;  ///< degrees
  ArmFigureOptions options;
  bool json = false;
};

Figure picture(const Arguments& arguments, const Arm& arm) {
  ArmFigureOptions options = arguments.options;
  options.azimuth = to_radians(arguments.azimuth, AngleUnit::degrees);
  options.elevation = to_radians(arguments.elevation, AngleUnit::degrees);
  if (!arguments.motion.empty()) {
    if (!arguments.q.empty()) throw Error("a motion has its own joint values: leave out --q");
    return motion_figure(arm, at_equal_times(read_recording(arguments.motion, arm)), {}, options);
  }
  if (arguments.q.empty()) return arm_figure(arm, middle_configuration(arm), options);
  const Configuration q = arguments.unit.configuration(arm, arguments.q, "--q");
  warn_outside_limits(arm, q);
  return arm_figure(arm, q, options);
}

Exit draw(const Arguments& arguments) {
  const Format format = format_of(arguments.out);
  for (const double angle : {arguments.azimuth, arguments.elevation}) {
    if (!std::isfinite(angle)) throw Error("--azimuth and --elevation must be finite numbers");
  }
  refuse_overwriting(arguments.out, {arguments.arm.text, arguments.motion});
  const Arm arm = arguments.arm.read();
  write_file(arguments.out, render(picture(arguments, arm), format));
  if (arguments.json) {
    print_json({{"status", "drawn"}, {"out", arguments.out}});
  } else {
    fmt::print("{} drawn: {}\n", arm.name(), arguments.out);
  }
  return Exit::yes;
}

}  // namespace

Run declare_draw(CLI::App& verb) {
  static Arguments arguments;
  ArmFigureOptions& options = arguments.options;
  const UnitArgument degrees{true};
  arguments.azimuth = std::round(degrees.shown(options.azimuth));
  arguments.elevation = std::round(degrees.shown(options.elevation));
  arguments.arm.declare(verb);
  verb.add_option("MOTION", arguments.motion, "A trajectory of the arm to draw: .csv or .json");
  verb.add_option("--q", arguments.q, "Joint values (default: the middle of the limits)");
  arguments.unit.declare(verb);
  verb.add_option("--out", arguments.out, "The picture: .svg, .png or .pdf")->required();
  verb.add_flag("--frames", options.frames, "Every link's frame: x red, y green, z blue");
  verb.add_flag("--jacobian", options.jacobian,
                "The Jacobian's columns as arrows at the tool: joint 1 red, 2 green, 3 blue");
  verb.add_option("--title", options.title, "The title (default: the arm's name)");
  verb.add_option("--azimuth", arguments.azimuth, "Spatial arms: degrees from x to the viewer")
      ->capture_default_str();
  verb.add_option("--elevation", arguments.elevation, "Spatial arms: degrees above the ground")
      ->capture_default_str();
  verb.add_flag("--json", arguments.json, "Print JSON");
  verb.footer(
      "Examples:\n"
      "  beeline draw rrr --q 0,90,0 --degrees --jacobian --out rrr.svg\n"
      "  beeline draw panda move.csv --out move.png\n"
      "  beeline draw robot.urdf --tip tool0 --frames --out robot.pdf");
  return [] { return draw(arguments); };
}
