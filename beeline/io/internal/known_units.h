#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <beeline/io/internal/trajectory_csv.h>
#include <beeline/trajectory/internal/joint_columns.h>

namespace beeline::internal {

/// The units of the columns that are an arm's coordinates and their rates.
struct KnownUnits {
  /// The joint map, or the joints without one, with the units of positions that are known.
  JointMap joints = {};
  std::vector<std::optional<double>> column_units = {};  ///< of MatchOptions
  /// Radians or metres per unit and second of the velocities and accelerations of each coordinate,
  /// where names or comments give one; others are in the unit of their joint.
  std::array<std::vector<std::optional<double>>, 2> rates = {};
  /// Columns whose names give no unit, of coordinates beside others of their kind that have one.
  std::vector<std::string> angles_without_unit = {}, lengths_without_unit = {};
};

/// Returns the units that the joint map, names of columns and comments give to the columns of
/// `recorded`, of the file at `path`, and adds a note for each. Throws Error for a unit that a
/// joint does not have, for a comment that contradicts a name, and for positions without a unit
/// whose rates have one other than rad and m; FileError for units in comments that are not read.
KnownUnits known_units(const Arm& arm, const std::string& path, const RecordedColumns& columns,
                       const JointColumns& order, const JointMap& joint_map,
                       const Trajectory& recorded, const RecordingOptions& options,
                       std::vector<RecordingNote>& notes);

/// Converts the rates of a trajectory that is matched_to() the arm, where they have another unit
/// than their joint: by default `angle_unit`, radians, or metres.
void convert_rates(const Arm& arm, const KnownUnits& units, double angle_unit,
                   Trajectory& trajectory);

/// The unit in which angles without a unit are read.
struct MissingUnits {
  double angle_unit = 1;              ///< radians
  bool angle_unit_is_assumed = true;  ///< otherwise the options give it
};

/// Adds notes on the units of joints that nothing gives: beside other columns that have one, and
/// beside comments that are not clear.
void note_missing_units(const Arm& arm, const std::string& path, const KnownUnits& units,
                        const StatedUnits& stated, const MissingUnits& missing,
                        std::vector<RecordingNote>& notes);

}  // namespace beeline::internal
