#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <beeline/draw/timing_figure.h>
#include <beeline/io/text/json.h>
#include <beeline/trajectory/trajectory.h>

#include "command/option.h"
#include "scene_argument.h"

namespace beeline::command {

/// Whether two paths name the same file, which need not exist: ./q.svg is q.svg.
bool same_file(const std::string& a, const std::string& b);

/// Throws Error if `output` is the same file as one of `inputs`, where `-` is the standard input.
void refuse_overwriting(const std::string& output, const std::vector<std::string>& inputs);

/// --plot.
Option plot_option(std::string* target);

/// --out, --draw and --plot: the files that a motion is written to.
struct ResultFiles {
  std::string out = {}, draw = {}, plot = {};

  std::vector<Option> options();
  /// Throws Error for an unknown format and for the name of an input file. Called before the
  /// computation begins.
  void check(const std::vector<std::string>& inputs) const;
  /// Writes all files or none. The path of `plot_options` is in the world of
  /// `plotted`, which is the arm where it is not given. The pictures show the obstacles of
  /// `model`, if it is given, and the parts that a program carries, of which `scenes` are the
  /// program_scenes().
  void write(const Arm& arm, const Trajectory& trajectory, const std::vector<Pose>& waypoints,
             const TimingFigureOptions& plot_options = {},
             const std::optional<Arm>& plotted = std::nullopt,
             const CollisionModel* model = nullptr,
             std::span<const ProgramScene> scenes = {}) const;
  /// Draws where a motion is refused by its clearance, with --draw, and says so in the report.
  /// `scenes`: as for write().
  void draw_refusal(ClearanceReport& report, std::span<const ProgramScene> scenes = {}) const;
  /// The names of the files, one a line.
  std::string text() const;
  void add_to(Json& document) const;
};

}  // namespace beeline::command
