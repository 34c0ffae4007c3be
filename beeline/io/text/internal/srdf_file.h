#pragma once

#include <string>
#include <string_view>

#include <beeline/io/text/urdf.h>

namespace beeline::internal {

/// Returns the ends of the chain of a group, for the text of a URDF file; `path` names it in
/// messages.
ChainEnds group_ends(const Srdf& srdf, const std::string& group, std::string_view urdf,
                     const std::string& path);

}  // namespace beeline::internal
