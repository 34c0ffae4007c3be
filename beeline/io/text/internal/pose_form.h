#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <beeline/io/text/internal/stated_units.h>
#include <beeline/io/text/pose_list.h>

namespace beeline::internal {

/// The columns that a message offers: `x,y,theta or x,y,z,roll,pitch,yaw or ...`.
const std::string& known_pose_columns();

/// The columns of an orientation in space that a message offers in brief.
inline constexpr const char* spatial_forms =
    "x,y,z,roll,pitch,yaw or x,y,z,qw,qx,qy,qz or another form (pose_form, --pose-form)";

/// Throws Error for three numbers whose meaning `format` does not give; `what` precedes them.
void check_triple(std::size_t count, const PoseFormat& format, const std::string& what);

/// Returns the columns of so many numbers without names. Throws Error, which begins with `what`, if
/// no pose has as many, or none in format.pose_form.
const PoseColumns& pose_columns_of(std::size_t count, const PoseFormat& format,
                                   const std::string& what);

/// Returns the columns that a header has, in any order. Throws Error for an unknown column, and for
/// one that is missing or does not belong to the others.
const PoseColumns& pose_columns_of(const std::vector<std::string>& header);

/// Returns the columns of a header with their units: each name without its unit, and in lower or
/// upper case as in all_pose_columns() and program_columns(). Of the latter speed, blend and dwell
/// may have units, the last one of time. Throws Error if two are the same then.
ColumnsInUnits known_columns(const std::vector<std::string>& header);

/// Returns what the numbers of each column of a file are multiplied by, for written_pose(); 1 for
/// columns of programs. Throws Error as factors_to().
std::vector<double> pose_factors(ColumnsInUnits columns, const PoseFormat& format,
                                 const StatedUnits& stated, const std::string& path);

/// Whether these are the columns of a form, in any order, upper or lower case.
bool names_pose(const std::vector<std::string>& header);

}  // namespace beeline::internal
