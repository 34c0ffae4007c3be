#pragma once

#include <string>
#include <vector>

#include <beeline/io/text/json.h>
#include <beeline/io/trajectory_file.h>

#include "arguments.h"

namespace beeline::command {

/// What the reading of a recording depends on besides its options.
struct ReadingNeeds {
  bool times = true;
  bool joint_map = true;  ///< false: only a file that has its names is read by --joint-map
  bool time_unit = true;  ///< false: only a file whose unit is not fixed is read by --time-unit
};

/// --joint-map, --angle-unit, --time-unit and --no-unwrap: how recordings are read.
struct RecordingArgument {
  std::string joint_map = {}, angle_unit = {}, time_unit = {};
  bool no_unwrap = false;

  std::vector<Option> options();
  std::vector<Option> reading_options();  ///< those without --no-unwrap

  /// A recording of the arm as the file has it. Warns of how it was read where the file does not
  /// say, and of units that it seems to be in. Throws FileError for a value or a time that is out
  /// of range.
  Recording read(const std::string& path, const Arm& arm, const UnitArgument& unit,
                 const ReadingNeeds& needs = {}) const;
  /// The same, unwrapped unless --no-unwrap is given, with a warning.
  Recording read_unwrapped(const std::string& path, const Arm& arm, const UnitArgument& unit,
                           const ReadingNeeds& needs = {}) const;
};

/// Warns of the joints of the file that were unwrapped.
void warn_of_unwrapped(const std::string& path, const std::vector<UnwrappedJoint>& joints);

/// [{"joint", "wraps", "first_time"}, ...]
Json json_unwrapped(const std::vector<UnwrappedJoint>& joints);

/// What the description of a verb says of its recordings.
extern const char* const recording_units;

}  // namespace beeline::command
