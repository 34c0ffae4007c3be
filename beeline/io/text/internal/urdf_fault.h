#pragma once

#include <vector>

#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/internal/urdf_file.h>

namespace beeline::internal {

/// Returns the error for a fault on the chain; `cure` is appended to its message.
FileError error_of(const UrdfFile& file, const UrdfFault& fault, const std::string& cure = "");

/// Returns the warnings for the first faults, at most `most`; the first of each kind lists the
/// known names.
std::vector<ReadWarning> warnings_of(const UrdfFile& file, const std::vector<UrdfFault>& faults,
                                     std::size_t most);

}  // namespace beeline::internal
