#pragma once

#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/model/arm.h>

namespace beeline {

/// What is suspicious in a model.
enum class FindingKind {
  length_unit,       ///< lengths that are millimetres, as it seems
  angle_unit,        ///< degrees in the place of radians
  rounded_angle,     ///< a right angle written with few digits
  nearly_special,    ///< axes that are nearly, not exactly, parallel, perpendicular or concurrent
  coincident_axes,   ///< two neighbouring joints that move alike
  missing_axis,      ///< a joint of a URDF file without axis element
  axis_length,       ///< an axis that is not of unit length
  no_range,          ///< limits that leave no or nearly no range
  unknown_velocity,  ///< a velocity limit that is missing where other joints have one
  fault              ///< a fault of the file beside the chain
};
std::string name(FindingKind kind);

/// A suspicious number of a model.
struct Finding {
  FindingKind kind = FindingKind::length_unit;  ///< what is suspicious
  int joint = -1;                               ///< from 0; -1: several, or the whole arm
  std::string place = {};                       ///< such as `joint 3 (elbow)`, or `joints 2, 4, 5`
  std::string what = {};                        ///< the value, and why it is suspicious
  std::string cost = {};                        ///< what it costs, computed; empty where nothing is
  std::string remedy = {};                      ///< what to write instead
};

/// The suspicious numbers of a model.
struct Diagnosis {
  std::vector<Finding> findings;  ///< in the order of the checks

  /// Whether nothing is suspicious.
  explicit operator bool() const { return findings.empty(); }
};

/// Looks for numbers of an arm that are likely mistakes: units, rounded right angles and axes that
/// nearly have a closed form of inverse kinematics (with the method that is lost), joints that move
/// alike, limits. Says nothing of what may be meant.
Diagnosis diagnose(const Arm& arm);

/// The same of an arm as read_arm() takes it, with what its file alone shows: a missing axis
/// element, an axis not of unit length, angles in another unit than the file declares, faults
/// beside the chain. Throws Error and FileError as read_arm() does.
Diagnosis diagnose(const std::string& text, const ChainEnds& ends = {});

/// Returns the faults of a URDF file, on every chain, in the order of its lines: up to 100, and the
/// number of the others. It needs no chain, so that a file which read_arm() refuses for its first
/// fault shows all. Files of other formats have none. Throws FileError for a file that cannot be
/// read or is not URDF.
std::vector<Finding> file_faults(const std::string& path);

}  // namespace beeline
