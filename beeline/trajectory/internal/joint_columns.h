#pragma once

#include <string>
#include <vector>

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// The columns of a trajectory's positions that belong to an arm's coordinates. A column holds
/// velocities or accelerations where its name says so; all joints have them, or none.
struct JointColumns {
  std::vector<Eigen::Index> positions;
  std::vector<Eigen::Index> velocities, accelerations;  ///< empty where there are none
  /// Columns of rates that are left out: some joints have none, or accelerations lack velocities.
  std::vector<Eigen::Index> unread_rates = {};
};

/// Whether each joint of one of these lists is part of the name of a column, in any case.
bool names_all_joints(const Arm& arm, const std::vector<std::string>& columns);

/// Finds them by the names that matched_to() describes, or by the joint map, unless it is empty.
/// Throws Error for joints that are missing, or that the arm does not have.
JointColumns joint_columns(const Arm& arm, const std::vector<std::string>& names,
                           const JointMap& joint_map);

}  // namespace beeline::internal
