#pragma once

#include <beeline/planning/program.h>

#include <tests/planning/motion_promises.h>

namespace beeline::testing {

/// A pick of a panda: from above, down, a rest, and back.
inline Program pick() {
  const Pose object = make_pose({0.5, 0.2, 0.15}, so3_exp({pi, 0, 0}));
  const Pose above = object * make_pose({0, 0, -0.12}, Rotation::Identity());
  Program program;
  program.moves = {{.kind = MoveKind::joint, .target = above},
                   {.target = object, .speed = 0.1, .dwell = 0.3},
                   {.target = above, .speed = 0.25}};
  return program;
}

inline const Configuration home{{0, -0.785, 0, -2.356, 0, 1.571, 0.785}};

}  // namespace beeline::testing
