#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include <beeline/motion/trajectory.h>

#include "output.h"

/// A motion's configurations at equal steps of time, as a picture's trail wants them.
std::vector<beeline::Configuration> at_equal_times(const beeline::Trajectory& trajectory);

/// --out and --draw: where a motion's trajectory and picture go.
struct ResultFiles {
  std::string out, draw;

  void declare(CLI::App& verb);
  /// Throws Error for a format that is not known: to be asked before the work begins.
  void check_formats() const;
  /// Writes what was asked for; the picture is made before anything is written.
  void write(const beeline::Arm& arm, const beeline::Trajectory& trajectory,
             const std::vector<beeline::Pose>& waypoints) const;
  /// Says where the files are.
  void print() const;
  void add_to(OrderedJson& document) const;
};
