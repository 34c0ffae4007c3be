#pragma once

#include <string>

namespace beeline::internal {

/// Returns the file that a rename to `path` should replace: the target of symbolic links, so that
/// the link stays; it need not exist.
std::string file_replaced_at(const std::string& path);

/// Returns the path of a temporary file beside the target that no other writer uses, of this
/// machine or another that shares the folder.
std::string temporary_beside(const std::string& target);

}  // namespace beeline::internal
