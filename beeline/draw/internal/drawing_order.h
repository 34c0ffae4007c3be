#pragma once

#include <vector>

#include <beeline/draw/internal/page_layout.h>

namespace beeline::internal {

/// Puts the marks of the frame in the order of the frame before where that looks the same: where
/// no two sources overlap on paper whose order differs. Marks of one source stay together.
void keep_order(const std::vector<FrameMark>& before, std::vector<FrameMark>& frame);

}  // namespace beeline::internal
