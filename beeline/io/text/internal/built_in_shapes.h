#pragma once

#include <string_view>

namespace beeline::internal {

/// Returns the file of a built-in arm with shapes of its links, and an empty text for other names.
/// cmake/catalog_shapes.cmake writes the source of this function.
std::string_view built_in_shapes(std::string_view name);

}  // namespace beeline::internal
