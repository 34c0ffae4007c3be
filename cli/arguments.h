#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/io/text/pose_list.h>
#include <beeline/kinematics/task.h>

#include "command/option.h"

namespace beeline::command {

/// The arguments that several verbs share. Each is declared, and turned into the library's types,
/// in one place.

/// Lists of options in one.
std::vector<Option> joined(std::initializer_list<std::vector<Option>> lists);

/// The items of a list as typed, between separators; empty ones too.
std::vector<std::string> items_of(std::string_view list, char separator);

/// --degrees, --millimetres and --pose-form: angles, positions of poses and orientations, read and
/// printed.
struct UnitArgument {
  bool degrees = false;
  bool millimetres = false;
  std::string pose_form = {};  ///< empty: by the number of numbers; printed as the verb chooses

  std::vector<Option> options();
  AngleUnit angle_unit() const { return degrees ? AngleUnit::degrees : AngleUnit::radians; }
  /// How poses are read and, with this form if there is no --pose-form, printed.
  PoseFormat pose_format(Triple triple = Triple::planar,
                         std::optional<PoseForm> form = std::nullopt) const;
  /// Joint values as typed, such as "112,-52,-60"; the value of a prismatic joint is in metres.
  /// Throws Error that begins with `option` if they do not fit the arm.
  Configuration configuration(const Arm& arm, const std::string& text,
                              const std::string& option) const;
  /// Derivatives of joint values in time, as typed; the same without a warning of large angles.
  Configuration joint_rates(const Arm& arm, const std::string& text,
                            const std::string& option) const;
  /// The value of coordinate k in radians or metres.
  double coordinate(const Arm& arm, int k, double value) const;
  /// A configuration, a value of coordinate k, or an angle, in the unit of the output.
  Configuration shown(const Arm& arm, const Configuration& q) const;
  double shown(const Arm& arm, int k, double value) const;
  double shown(double radians) const;
  const char* name() const { return degrees ? "deg" : "rad"; }
  /// The position of a pose, in the unit of the output.
  Vector3 shown_position(const Pose& pose) const;
  const char* position_name() const { return millimetres ? "mm" : "m"; }
};

/// --velocity, --acceleration, --jerk and --speed: limits of a motion.
struct LimitsArgument {
  std::string velocity = {}, acceleration = {}, jerk = {};
  double speed = 1;

  std::vector<Option> options();
  std::vector<Option> rate_options();  ///< those without --speed
  /// The arm with these limits. Throws Error naming the option.
  Arm set_on(const Arm& arm, const UnitArgument& unit) const;
};

/// --task: planar, position, spatial or a mask; default the arm's own.
struct TaskArgument {
  std::string text = {};
  bool offered = true;  ///< whether the verb has --task

  std::vector<Option> options();
  Task read(const Arm& arm) const;
};

/// --frame with --task: which Jacobian.
struct JacobianArgument {
  std::string frame = {};  ///< empty: the task's frame
  TaskArgument task = {};

  std::vector<Option> options();
  /// The rows of the task, in the frame. Throws Error if the task's own frame is another one.
  Task read(const Arm& arm) const;
};

/// The coordinate of the joint of this name. Throws Error, which begins with `option`, for another
/// name, and which says for a number that joints have names.
int coordinate_named(const Arm& arm, const std::string& joint, const std::string& option = "joint");

/// An argument that is a file.
Positional file_argument(std::string name, std::string help, std::string* target,
                         bool required = true);

/// --threads.
Option threads_option(int* target);

/// --tool-speed, with the motions that it is for: "; of a program, in moves without a speed".
Option tool_speed_option(std::optional<double>* target, const std::string& motions = "",
                         std::vector<std::string> methods = {});

/// --tolerance and --orientation-tolerance of a path, with the range of both.
std::vector<Option> path_tolerance_options(double* position, double* orientation,
                                           const OptionRules& rules);

/// --q, which is required: the joint values of an answer.
Option configuration_option(std::string* target);

/// --q, or another option that takes joint values, with the Option::arguments.
Option joint_values_option(const std::string& name, std::string help, std::string* target,
                           std::vector<std::string> arguments = {});

/// Warns on stderr of an angle, in radians, beyond a revolution: it may be meant in degrees.
void warn_of_angle(const std::string& option, double angle, const UnitArgument& unit);
/// The same of the largest angle of poses in a form; a rotation vector is in radians always.
void warn_of_angle(const std::string& option, double angle, std::optional<PoseForm> form,
                   const UnitArgument& unit);

/// Warns on stderr of each coordinate of q that is outside the arm's limits.
void warn_outside_limits(const Arm& arm, const Configuration& q);

}  // namespace beeline::command
