#pragma once

#include <beeline/io/text/internal/urdf_file.h>

namespace beeline::internal {

/// Appends the faults of the joints' values to `file.faults`: an unknown type, an axis without
/// direction, a lower limit that exceeds the upper one, a limit of a rate that is too small, a
/// leader that is not in the file, and leaders that mimic each other. Joints whose leader is fixed,
/// or follows a fixed joint, become fixed at their constant value; this is the last kind of fault.
void find_joint_faults(UrdfFile& file);

}  // namespace beeline::internal
