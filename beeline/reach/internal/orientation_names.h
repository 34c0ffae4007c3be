#pragma once

#include <beeline/internal/enum_names.h>
#include <beeline/reach/grid.h>

namespace beeline::internal {

inline constexpr EnumNames<ReachOrientations> orientation_names("orientations");

}  // namespace beeline::internal
