#include <filesystem>
#include <fmt/format.h>
#include <memory>

#include <beeline/draw/arm_figure.h>
#include <beeline/draw/figure.h>
#include <beeline/error.h>
#include <beeline/io/text/file.h>

#include "animation_argument.h"
#include "arguments.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct FigureArguments {
  std::string number, out;
  AnimationArgument animation;
};

/// Draws every figure into the folder --out, and with --animate .svg those that move.
Answer draw_all(const FigureArguments& arguments) {
  if (arguments.animation.wanted()) {
    throw Error("figure all takes --out DIR alone; --animate is for figure 1.7 or 1.9");
  }
  std::error_code failed;
  std::filesystem::create_directories(arguments.out, failed);
  if (failed || !std::filesystem::is_directory(arguments.out)) {
    throw FileError(arguments.out, 0, "is not a folder and cannot be made one");
  }
  Answer answer{.document = {{"status", "drawn"}, {"figure", "all"}}};
  Json files = Json::list();
  std::vector<NewFile> pictures;
  for (const std::string& number : chapter_figures()) {
    const std::string file =
        (std::filesystem::path(arguments.out) / ("figure_" + number + ".svg")).string();
    pictures.push_back({file, render(chapter_figure(number), Format::svg)});
    answer.text += fmt::format("figure {} drawn: {}\n", number, file);
    files.append(file);
  }
  write_files(pictures);
  answer.document.add("files", files);
  return answer;
}

Answer draw_figure(const FigureArguments& arguments) {
  if (arguments.out.empty() && !arguments.animation.wanted()) {
    throw Error("figure needs --out PICTURE or, for figures 1.7 and 1.9, --animate FILE");
  }
  if (arguments.number == "all") return draw_all(arguments);
  arguments.animation.check(arguments.out, {});
  Answer answer{.document = {{"status", "drawn"}, {"figure", arguments.number}}};
  const auto report = [&](const char* key, const std::string& file) {
    answer.text += fmt::format("figure {} drawn: {}\n", arguments.number, file);
    answer.document.add(key, file);
  };
  if (!arguments.out.empty()) {
    const Format format = format_of(arguments.out);
    write_file(arguments.out, render(chapter_figure(arguments.number), format));
    report("out", arguments.out);
  }
  if (arguments.animation.wanted()) {
    arguments.animation.write(
        for_option("--animate", [&] { return chapter_animation(arguments.number); }));
    report("animation", arguments.animation.file);
  }
  return answer;
}

}  // namespace

Verb figure_verb() {
  const auto arguments = std::make_shared<FigureArguments>();
  std::vector<std::string> numbers = chapter_figures();
  numbers.emplace_back("all");
  return {
      .name = "figure",
      .summary = "Redraw a figure of Dellaert, Serial Link Manipulators",
      .description =
          "Draws one of the chapter's figures from computed motions:\n"
          "  1.1  revolute and prismatic joints\n"
          "  1.2  the joint types P, R, S, C, H, E\n"
          "  1.3  the RRR arm at rest and actuated, with its frames\n"
          "  1.4  the transformations of a two-link arm\n"
          "  1.5  link frames, joint angles and link lengths\n"
          "  1.6  two configurations\n"
          "  1.7  joint-space control: a curved path of the tool\n"
          "  1.8  the columns of the Jacobian as velocities\n"
          "  1.9  Cartesian control: straight lines through three poses\n"
          "NUMBER splines draws the poses of 1.9 by straight lines and by a spline; all draws all "
          "figures as SVG into the folder --out, which is made if it is missing",
      .arguments = {{.name = "NUMBER",
                     .help = "One of " + listed(numbers) + ".",
                     .target = &arguments->number,
                     .choices = numbers}},
      .options =
          joined({{Option("--out FILE", "The picture: .svg, .png or .pdf; of figure all a folder.",
                          &arguments->out)},
                  arguments->animation.options()}),
      .examples = {{"Straight lines through three poses", "beeline figure 1.9 --out figure.svg"},
                   {"All figures", "beeline figure all --out figures"},
                   {"Joint-space control in motion, for a browser",
                    "beeline figure 1.7 --animate control.svg"}},
      .run = [arguments] { return draw_figure(*arguments); }};
}

}  // namespace beeline::command
