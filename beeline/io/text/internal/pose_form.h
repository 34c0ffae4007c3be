#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <beeline/io/text/internal/column_unit.h>
#include <beeline/io/text/pose_list.h>

namespace beeline::internal {

/// The columns by which a file gives a pose, in the order in which numbers without names are.
struct PoseColumns {
  std::vector<std::string> names;
  std::optional<PoseForm> form = std::nullopt;  ///< of the orientation in space
  bool planar = false;
  bool oriented = true;
};

/// All of them: x,y,theta first, those of each PoseForm, x,y,z and x,y last.
const std::vector<PoseColumns>& all_pose_columns();

/// The columns that a message offers: `x,y,theta or x,y,z,roll,pitch,yaw or ...`.
const std::string& known_pose_columns();

/// The columns of an orientation in space that a message offers in brief.
inline constexpr const char* spatial_forms =
    "x,y,z,roll,pitch,yaw or x,y,z,qw,qx,qy,qz or another of --pose-form";

/// Whether numbers without names may be in these columns: whether they have the orientation of
/// format.pose_form, or by default rpy, a quaternion or a matrix, or none; of three, format.triple.
bool reads_without_names(const PoseColumns& columns, const PoseFormat& format);

/// Returns the columns of so many numbers without names. Throws Error, which begins with `what`, if
/// no pose has as many, or none in format.pose_form.
const PoseColumns& pose_columns_of(std::size_t count, const PoseFormat& format,
                                   const std::string& what);

/// Returns the columns that a header has, in any order. Throws Error for an unknown column, and for
/// one that is missing or does not belong to the others.
const PoseColumns& pose_columns_of(const std::vector<std::string>& header);

/// Returns the columns of a header with their units: each name without its unit, and in lower or
/// upper case as in all_pose_columns() and program_columns(); the latter have no units. Throws
/// Error if two are the same then.
ColumnsInUnits known_columns(const std::vector<std::string>& header);

/// The name of the unit in which written_pose() takes the numbers of a column; empty for none.
std::string unit_of_column(const std::string& name, const PoseFormat& format);

/// Returns what the numbers of each column of a file are multiplied by, for written_pose(). Throws
/// Error as factors_to().
std::vector<double> pose_factors(const ColumnsInUnits& columns, const PoseFormat& format,
                                 const StatedUnits& stated);

/// Whether these are the columns of a form, in any order, upper or lower case.
bool names_pose(const std::vector<std::string>& header);

/// The pose given by numbers in the order of `columns`. Throws Error as pose_of().
WrittenPose written_pose(std::span<const double> numbers, const PoseColumns& columns,
                         const PoseFormat& format);

}  // namespace beeline::internal
