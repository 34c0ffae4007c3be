#include <fmt/core.h>

#include <beeline/draw/canvas.h>
#include <beeline/draw/chapter.h>
#include <beeline/error.h>
#include <beeline/read/file.h>

#include "output.h"
#include "verb.h"

using namespace beeline;

namespace {

struct Arguments {
  std::string number, out;
  bool json = false;
};

Exit redraw(const Arguments& arguments) {
  const Format format = format_of(arguments.out);
  write_file(arguments.out, render(chapter_figure(arguments.number), format));
  if (arguments.json) {
    print_json({{"status", "drawn"}, {"figure", arguments.number}, {"out", arguments.out}});
  } else {
    fmt::print("figure {} drawn: {}\n", arguments.number, arguments.out);
  }
  return Exit::yes;
}

}  // namespace

Run declare_figure(CLI::App& verb) {
  static Arguments arguments;
  verb.add_option("NUMBER", arguments.number, "One of " + listed(chapter_figures()))->required();
  verb.add_option("--out", arguments.out, "The picture: .svg, .png or .pdf")->required();
  verb.add_flag("--json", arguments.json, "Print JSON");
  verb.footer(
      "1.3  the RRR arm at rest and actuated, with its frames\n"
      "1.6  two configurations\n"
      "1.7  joint-space control: a curved trail that slows down\n"
      "1.8  the Jacobian's columns as velocities\n"
      "1.9  Cartesian control: straight trails through three waypoints\n"
      "Example:\n"
      "  beeline figure 1.9 --out figure.svg");
  return [] { return redraw(arguments); };
}
