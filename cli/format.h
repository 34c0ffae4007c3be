#pragma once

#include <string>
#include <utility>
#include <vector>

#include <beeline/io/text/json.h>
#include <beeline/kinematics/task.h>

#include "arguments.h"

namespace beeline::command {

/// Formatting of answers: numbers are rounded in texts and exact in JSON.

/// The units of a Jacobian's entries, also with --degrees, for Answer::units.
constexpr const char* jacobian_units = "m or rad of the tool, per rad or m of the joint";

/// A number with six significant digits; rounding errors near zero are shown as 0.
std::string shown(double value);

/// Numbers with commas between.
std::string shown(const Eigen::VectorXd& values);

/// A pose on one line, in the order of --pose: x, y, theta of a planar arm's pose at z = 0 or, with
/// --pose-form and otherwise, the numbers of the form, by default rpy.
std::string shown(const Pose& pose, bool planar, const UnitArgument& unit);

/// The same of any pose without blanks, as an option of the arm takes it; where the arm is not
/// planar, a pose without a rotation as x,y,z.
std::string typed(const Pose& pose, bool planar, const UnitArgument& unit);

/// A matrix in aligned columns, each row indented and labelled.
std::string matrix_text(const Eigen::MatrixXd& matrix, const std::vector<std::string>& row_labels);

/// Texts of several lines side by side, with the heading of each above it.
std::string side_by_side(const std::vector<std::pair<std::string, std::string>>& columns);

/// The homogeneous matrix of a pose, indented: 3 x 3 for a planar arm.
std::string pose_matrix_text(const Pose& pose, bool planar, const UnitArgument& unit);

/// Whether x, y and theta are the whole pose: whether z is 0 to rounding.
bool is_at_height_zero(const Pose& pose);

/// A pose on indented lines: in --pose-form; or x, y and theta of a planar arm, with z unless that
/// is 0; or position, rpy and quaternion.
std::string pose_text(const Pose& pose, bool planar, const UnitArgument& unit);

/// "1 sample", "2 samples".
std::string counted(std::int64_t count, const std::string& noun);

/// A matrix as a list of its rows.
Json json_matrix(const Eigen::MatrixXd& matrix);

/// {matrix, translation, quaternion {qw,qx,qy,qz}} and, for planar arms, planar {x,y,theta}; with
/// --pose-form rpy, rotvec or abc also that orientation, such as abc {A,B,C}. Angles and positions
/// are in the units of the output.
Json json_pose(const Pose& pose, bool planar, const UnitArgument& unit);

}  // namespace beeline::command
