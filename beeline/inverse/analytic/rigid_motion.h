#pragma once

#include <beeline/pose/se3.h>

namespace beeline::internal {

/// A rigid motion p -> rotation p + translation as plain numbers, for the kernels.
struct RigidMotion {
  double rotation[3][3];  ///< by row
  double translation[3];  ///< in the kernel's unit of length
};

/// Returns the pose with its translation divided by `unit` (metres).
inline RigidMotion rigid_motion(const Pose& pose, double unit = 1) {
  RigidMotion motion{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) motion.rotation[i][j] = pose(i, j);
    motion.translation[i] = pose(i, 3) / unit;
  }
  return motion;
}

}  // namespace beeline::internal
