#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include <beeline/draw/timing_figure.h>
#include <beeline/trajectory/limit_usage.h>

#include "output.h"

/// A motion's configurations at equal steps of time, as a picture's trail wants them.
std::vector<beeline::Configuration> at_equal_times(const beeline::Trajectory& trajectory);

/// A recording, its joints in the arm's order.
beeline::Trajectory read_recording(const std::string& path, const beeline::Arm& arm);

/// The poses of a file that --through names, each of a form that fits the arm and the task.
beeline::PoseList read_waypoints(const std::string& path, const beeline::Arm& arm,
                                 const TaskArgument& task, const UnitArgument& unit);

/// Prints what was measured and what is proved of a motion along a path.
void print_deviation(const beeline::PathDeviation& straight, const UnitArgument& unit);

/// The same as data: keys deviation_... and orientation_..., null where there is nothing to tell.
void add_deviation(OrderedJson& document, const std::optional<beeline::PathDeviation>& straight,
                   const UnitArgument& unit);

/// How much of the limits a motion uses, and which joint where.
void print_limits(const beeline::LimitUsage& limits);
OrderedJson json_limits(const beeline::LimitUsage& limits);

/// Throws Error when `output` is the same file as one of `inputs`, of which `-` is standard input.
void refuse_overwriting(const std::string& output, const std::vector<std::string>& inputs);

/// --out, --draw and --plot: where a motion's trajectory and pictures go.
struct ResultFiles {
  std::string out, draw, plot;

  void declare(CLI::App& verb);
  /// Throws Error for a format that is not known and for the name of an input file: to be asked
  /// before the work begins.
  void check(const std::vector<std::string>& inputs) const;
  /// Writes what was asked for, all or nothing. `path` is the one that the motion was to follow.
  void write(const beeline::Arm& arm, const beeline::Trajectory& trajectory,
             const std::vector<beeline::Pose>& waypoints,
             const std::optional<beeline::FollowedPath>& path = std::nullopt) const;
  /// Says where the files are.
  void print() const;
  void add_to(OrderedJson& document) const;
};
