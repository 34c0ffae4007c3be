#pragma once

#include <vector>

#include <beeline/doctor/diagnosis.h>
#include <beeline/io/text/pose_list.h>

namespace beeline::internal {

// Each function appends its findings.
void find_units(const Arm& arm, std::vector<Finding>& found);
void find_axes(const Arm& arm, std::vector<Finding>& found);
/// From the text of a URDF file, whose chain has none: see file_faults().
void find_faults(const std::string& path, std::vector<Finding>& found);

/// `unit` is the unit of angles that the arm's file declares.
void find_limits(const Arm& arm, AngleUnit unit, std::vector<Finding>& found);

/// From the text of a file, URDF or JSON, for the joints of the arm. Returns the unit of angles
/// that the file declares.
AngleUnit find_in_file(const std::string& path, const Arm& arm, std::vector<Finding>& found);

/// `joints 2, 4, 5`, or `joint 3 (elbow)` for one.
std::string joints_text(const Arm& arm, const std::vector<std::size_t>& joints);

}  // namespace beeline::internal
