#include <fmt/core.h>

#include <beeline/draw/canvas.h>
#include <beeline/draw/chapter.h>
#include <beeline/error.h>
#include <beeline/read/internal/file.h>

#include "animation_argument.h"
#include "arguments.h"
#include "verbs.h"

using namespace beeline;

namespace {

struct FigureArguments {
  std::string number, out;
  AnimationArgument animation;
  bool json = false;
};

Answer draw_figure(const FigureArguments& arguments) {
  if (arguments.out.empty() && !arguments.animation.wanted()) {
    throw Error("figure needs --out PICTURE or, for figures 1.7 and 1.9, --animate FILE");
  }
  arguments.animation.check(arguments.out, {});
  Answer answer{.document = {{"status", "drawn"}, {"figure", arguments.number}}};
  const auto report = [&](const char* key, const std::string& file) {
    answer.text += fmt::format("figure {} drawn: {}\n", arguments.number, file);
    answer.document.add(key, file);
  };
  if (!arguments.out.empty()) {
    const Format format = format_of(arguments.out);
    internal::write_file(arguments.out, render(chapter_figure(arguments.number), format));
    report("out", arguments.out);
  }
  if (arguments.animation.wanted()) {
    arguments.animation.write(chapter_animation(arguments.number));
    report("animation", arguments.animation.file);
  }
  return answer;
}

}  // namespace

Verb figure_verb() {
  static FigureArguments arguments;
  return {
      .name = "figure",
      .summary = "Redraw a figure of Dellaert, Serial Link Manipulators",
      .description =
          "Draws one of the chapter's figures from computed motions:\n"
          "  1.3  the RRR arm at rest and actuated, with its frames\n"
          "  1.6  two configurations\n"
          "  1.7  joint-space control: a curved path of the tool\n"
          "  1.8  the columns of the Jacobian as velocities\n"
          "  1.9  Cartesian control: straight lines through three poses",
      .arguments = {{.name = "NUMBER",
                     .help = "One of " + listed(chapter_figures()) + ".",
                     .target = &arguments.number,
                     .choices = chapter_figures()}},
      .options = joined({{{.name = "--out",
                           .value = "FILE",
                           .help = "The picture: .svg, .png or .pdf.",
                           .target = &arguments.out,
                           .completes = Completes::file}},
                         arguments.animation.options()}),
      .examples = {{"Straight lines through three poses", "beeline figure 1.9 --out figure.svg"},
                   {"Joint-space control in motion, for a browser",
                    "beeline figure 1.7 --animate control.svg"}},
      .json = &arguments.json,
      .run = [] { return draw_figure(arguments); }};
}
