#pragma once

#include <string>
#include <vector>

#include <beeline/read/pose_list.h>

namespace beeline::internal {

constexpr const char* known_forms =
    "x,y,theta or x,y,z,roll,pitch,yaw or x,y,z,qw,qx,qy,qz, and positions x,y,z or x,y";

/// Returns the form of pose_forms() that has these columns, in any order. Throws Error for an
/// unknown column, and for one that is missing or does not belong to the others.
const std::vector<std::string>& pose_form_of(const std::vector<std::string>& columns);

/// The pose given by numbers in the order of a form. Throws Error as pose_of().
WrittenPose written_pose(std::span<const double> numbers, AngleUnit unit, Triple triple);

}  // namespace beeline::internal
