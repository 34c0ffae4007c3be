#pragma once

#include <string>
#include <string_view>

#include <beeline/model/arm.h>

namespace beeline::internal {

/// Throws FileError, which says what reads it, if a text that is no recording of the arm begins as
/// a table of poses or a program. `path` is for the message.
void refuse_poses(std::string_view front, const std::string& path, const Arm& arm);

}  // namespace beeline::internal
