#pragma once

#include <beeline/internal/enum_names.h>
#include <beeline/reach/grid.h>

namespace beeline::internal {

inline constexpr EnumNames<ReachOrientations::any> orientation_names(
    "orientations", "fixed headings directions rolls any");

}  // namespace beeline::internal
