#pragma once

#include <CLI/App.hpp>
#include <string>

#include <beeline/kinematics/task.h>
#include <beeline/read/pose_list.h>

/// The arguments that several verbs share, each declared and understood in one place.

/// ARM with --base and --tip.
struct ArmArgument {
  std::string text, base, tip;

  void declare(CLI::App& verb);
  beeline::Arm read() const;
};

/// --degrees: angles in degrees, both ways.
struct UnitArgument {
  bool degrees = false;

  void declare(CLI::App& verb);
  beeline::AngleUnit angle_unit() const {
    return degrees ? beeline::AngleUnit::degrees : beeline::AngleUnit::radians;
  }
  /// Joint values as typed, such as "112,-52,-60": metres stay metres where a joint slides.
  /// Throws Error beginning with `option` when they do not fit the arm.
  beeline::Configuration configuration(const beeline::Arm& arm, const std::string& text,
                                       const std::string& option) const;
  /// The same for coordinate k alone.
  double coordinate(const beeline::Arm& arm, int k, double value) const;
  /// A configuration, a value of coordinate k, or an angle, in the unit that the caller asked for.
  beeline::Configuration shown(const beeline::Arm& arm, const beeline::Configuration& q) const;
  double shown(const beeline::Arm& arm, int k, double value) const;
  double shown(double radians) const;
  const char* name() const { return degrees ? "deg" : "rad"; }
};

/// --task: planar, position, spatial or a mask; the arm's default when it is not given.
struct TaskArgument {
  std::string text;

  void declare(CLI::App& verb);
  beeline::Task read(const beeline::Arm& arm) const;
};

/// Refuses a planar pose for an arm that is not planar and, where no task was asked for, a pose in
/// space that is off a planar arm's plane: its height and tilt would be left out.
void check_pose_form(const beeline::Arm& arm, const beeline::WrittenPose& pose,
                     const TaskArgument& task, const std::string& where);

/// Warns on stderr, once for each coordinate, when q is outside the arm's limits.
void warn_outside_limits(const beeline::Arm& arm, const beeline::Configuration& q);
