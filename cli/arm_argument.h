#pragma once

#include <string>
#include <vector>

#include "arguments.h"

namespace beeline::command {

/// ARM with --base, --tip, --srdf, --group, --tcp, --mount and --limits.
struct ArmArgument {
  std::string text = {}, base = {}, tip = {};
  std::string srdf = {};             ///< a file of groups and named states; empty: none
  std::string group = {};            ///< of that file
  std::string tcp = {}, mount = {};  ///< poses as typed; empty: none
  std::string limits = {};           ///< a file of joint limits; empty: the arm's own

  Positional argument();
  /// The files that the arm is read from, for refuse_overwriting(), and others.
  std::vector<std::string> inputs(std::vector<std::string> others = {}) const;
  std::vector<Option> options();
  /// The arm with the tool and the limits, in the world. Warns of what the files say that is not
  /// applied.
  Arm read(const UnitArgument& unit) const;
  /// Whether x, y and theta alone are the poses of the arm: it is planar, and no URDF file, which
  /// describes an arm in space.
  bool shown_in_plane(const Arm& arm) const;
  /// Joint values as typed for `option`: a named state of --srdf, or numbers, see
  /// UnitArgument::configuration().
  Configuration configuration(const Arm& arm, const std::string& text, const std::string& option,
                              const UnitArgument& unit) const;
};

}  // namespace beeline::command
