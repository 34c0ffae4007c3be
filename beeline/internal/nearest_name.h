#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace beeline::internal {

/// Returns the choice with the smallest edit distance to `name`, ignoring case, if `name` may be a
/// misspelling or an abbreviation of it; null otherwise. Takes time in proportion to the choices.
const std::string* nearest_name(std::string_view name, const std::vector<std::string>& choices);

}  // namespace beeline::internal
