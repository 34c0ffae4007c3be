#pragma once

#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/internal/urdf_file.h>

namespace beeline::internal {

/// Returns the error for a fault on the chain; `cure` is appended to its message.
FileError error_of(const UrdfFile& file, const UrdfFault& fault, const std::string& cure = "");

/// Returns the warning for a fault beside the chain.
ReadWarning warning_of(const UrdfFile& file, const UrdfFault& fault);

}  // namespace beeline::internal
