#pragma once

#include <beeline/io/text/internal/column_unit.h>
#include <beeline/io/trajectory_file.h>

namespace beeline::internal {

/// The unit of angles or lengths as one of joint values.
JointUnit joint_unit_of(const Unit& unit);

}  // namespace beeline::internal
