#include "result_files.h"

#include <filesystem>
#include <fmt/format.h>

#include <beeline/draw/arm_figure.h>
#include <beeline/draw/figure.h>
#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/trajectory_file.h>

namespace beeline::command {

bool same_file(const std::string& a, const std::string& b) {
  std::error_code fault;
  if (std::filesystem::equivalent(a, b, fault) && !fault) return true;
  const auto resolved = [&fault](const std::string& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, fault), fault);
  };
  return resolved(a) == resolved(b) && !fault;
}

void refuse_overwriting(const std::string& output, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    if (!input.empty() && same_file(output, input == "-" ? "/dev/stdin" : input)) {
      throw Error("the output " + output + " is an input as well; choose another name");
    }
  }
}

Option plot_option(std::string* target) {
  return Option("--plot FILE",
                "Plot joints and tool over time beside their limits, with --scene or --self the "
                "distance from obstacles beside the clearance: .svg, .png or .pdf.",
                target);
}

std::vector<Option> ResultFiles::options() {
  return {Option("--out FILE",
                 "Write the joint trajectory: .csv, or .json and .yaml as a ROS JointTrajectory.",
                 &out, {.arguments = {"path"}}),
          Option("--draw FILE",
                 "Draw the arm and the path of its tool, and the obstacles: .svg, .png or .pdf. Of "
                 "a motion that collides: the arm where it does.",
                 &draw),
          plot_option(&plot)};
}

void ResultFiles::check(const std::vector<std::string>& inputs) const {
  if (!out.empty()) trajectory_format(out);
  if (!draw.empty()) format_of(draw);
  if (!plot.empty()) format_of(plot);
  const auto refuse_same = [](const char* options, const std::string& a, const std::string& b) {
    if (a.empty() || b.empty() || !same_file(a, b)) return;
    throw Error(options + std::string(" name the same file: ") + a);
  };
  refuse_same("--out and --draw", out, draw);
  refuse_same("--out and --plot", out, plot);
  refuse_same("--draw and --plot", draw, plot);
  for (const std::string& file : {out, draw, plot}) {
    if (!file.empty()) refuse_overwriting(file, inputs);
  }
}

void ResultFiles::write(const Arm& arm, const Trajectory& trajectory,
                        const std::vector<Pose>& waypoints, const TimingFigureOptions& plot_options,
                        const std::optional<Arm>& plotted, const CollisionModel* model,
                        std::span<const ProgramScene> scenes) const {
  std::vector<NewFile> files;
  if (!out.empty()) files.push_back({out, trajectory_text(trajectory, trajectory_format(out))});
  if (!draw.empty()) {
    const Figure figure = !scenes.empty()    ? motion_figure(scenes, trajectory, waypoints)
                          : model != nullptr ? motion_figure(*model, trajectory, waypoints)
                                             : motion_figure(arm, trajectory, waypoints);
    files.push_back({draw, render(figure, format_of(draw))});
  }
  if (!plot.empty()) {
    TimingFigureOptions options = plot_options;
    if (model != nullptr && !options.clearance)
      options.clearance = clearance_over_time(*model, trajectory);
    const Picture picture = timing_figure(plotted.value_or(arm), trajectory, options);
    files.push_back({plot, render(picture, format_of(plot))});
  }
  write_files(files);
}

void ResultFiles::draw_refusal(ClearanceReport& report,
                               std::span<const ProgramScene> scenes) const {
  if (draw.empty() || report.q.size() == 0) return;
  const CollisionModel* model = &report.scene->model;
  for (const ProgramScene& scene : scenes) {
    if (scene.begin <= report.proof.time) model = &scene.model;
  }
  const ArmFigureOptions options{
      .title = fmt::format("{} at {} s", model->arm().name(), number(report.proof.time))};
  write_file(draw, render(arm_figure(*model, report.q, options), format_of(draw)));
  report.picture = draw;
}

std::string ResultFiles::text() const {
  std::string text;
  if (!out.empty()) text += fmt::format("trajectory    {}\n", out);
  if (!draw.empty()) text += fmt::format("picture       {}\n", draw);
  if (!plot.empty()) text += fmt::format("plot          {}\n", plot);
  return text;
}

void ResultFiles::add_to(Json& document) const {
  if (!out.empty()) document.add("out", out);
  if (!draw.empty()) document.add("draw", draw);
  if (!plot.empty()) document.add("plot", plot);
}

}  // namespace beeline::command
