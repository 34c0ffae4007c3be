#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/io/trajectory_file.h>

namespace beeline::internal {

/// Radians or metres per unit.
double si_per(JointUnit unit);

/// Returns the one of these units that has the name. Throws Error about `what`, listing the names.
JointUnit unit_among(const std::vector<JointUnit>& choices, const std::string& text,
                     const std::string& what);

/// Whether this is a unit of a revolute joint's coordinate; otherwise of a prismatic one's.
bool is_angle(JointUnit unit);

/// The columns of a recording, as their names say.
struct RecordedColumns {
  std::vector<std::string> names;                 ///< without the units
  std::vector<std::string> given;                 ///< as the recording has them
  std::vector<std::optional<JointUnit>> units{};  ///< those that the names give
  std::vector<std::string> sources{};             ///< the columns whose names give the units
};

/// Splits names of columns into the quantity and its unit: `joint1_deg`, `joint1 (deg)`,
/// `joint1[mm]`, `joint1_deg_vel`. Rates may have the unit of one, `joint1_vel (deg/s)`; a name
/// with such a unit that does not say its quantity, `joint1 (deg/s)`, becomes `joint1_vel` or
/// `joint1_acc`. A unit of angles elsewhere, `deg_joint1` or `states_deg/joint1/position`, counts
/// too and stays in the name. A name that one of `joints` has is not split. Names that would be
/// equal without their units keep them.
RecordedColumns columns_in_units(const std::vector<std::string>& names,
                                 const std::vector<std::string>& joints);

}  // namespace beeline::internal
