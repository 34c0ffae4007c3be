#pragma once

#include <string>
#include <vector>

#include <beeline/io/text/scene.h>

#include "arguments.h"
#include "moving_base_argument.h"

namespace beeline::command {

/// ARM with --base, --tip, --srdf, --group, --tcp, --mount, --rail, --mobile-base and --limits.
struct ArmArgument {
  std::string text = {}, base = {}, tip = {};
  std::string srdf = {};             ///< a file of groups, states and exempted pairs; empty: none
  std::string group = {};            ///< of that file
  std::string tcp = {}, mount = {};  ///< poses as typed; empty: none
  MovingBaseArgument moving_base = {};
  std::string limits = {};  ///< a file of joint limits; empty: the arm's own

  Positional argument();
  /// The files that the arm is read from, for refuse_overwriting(), and others.
  std::vector<std::string> inputs(std::vector<std::string> others = {}) const;
  std::vector<Option> options();
  /// The first of these: --base, --tip, --srdf and --group, which say what is read from the file.
  std::vector<Option> chain_options();
  /// The arm with the tool and the limits, in the world, on its rail or mobile base. Warns of what
  /// the files say that is not applied and, unless `reports_faults` is false, of the faults beside
  /// the chain.
  Arm read(const UnitArgument& unit, bool reports_faults = true) const;
  /// The shapes of the links of that arm, and the pairs of them that --srdf exempts.
  ArmShapes shapes(ShapeOptions options) const;
  /// The shapes of a tool from a file, posed in the tool frame of the arm without --tcp.
  LinkShapes tool_shapes(const std::string& path) const;
  /// Whether x, y and theta alone are the poses of the arm: it is planar, and no URDF file, which
  /// describes an arm in space.
  bool shown_in_plane(const Arm& arm) const;
  /// The values of a named state for that arm; joints of --rail and --mobile-base are at 0.
  Configuration state(const Srdf& srdf, const Arm& arm, const std::string& name,
                      const std::string& of_group) const;
  /// Joint values as typed for `option`: a named state of --srdf, or numbers, see
  /// UnitArgument::configuration().
  Configuration configuration(const Arm& arm, const std::string& text, const std::string& option,
                              const UnitArgument& unit) const;

 private:
  /// The ends of the chain, by --srdf, --group, --base and --tip.
  ChainEnds ends() const;
};

}  // namespace beeline::command
