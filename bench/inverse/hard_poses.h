#pragma once

#include <array>

#include "poses.h"

namespace beeline::bench {

/// Kinds of poses on which solvers claim what is not so.
enum class Hardness {
  plain,     ///< of a random configuration within limits
  beyond,    ///< out of reach, some by a hair
  turned,    ///< a reachable position, an orientation from anywhere
  singular,  ///< of a configuration at or next to right angles, as singular ones are
  at_limit,  ///< of a configuration with joints at or next to their limits
  pushed,    ///< next to a singular one, and then moved by a hair
};
constexpr std::array<const char*, 6> hardness_names{"plain",    "beyond reach", "turned",
                                                    "singular", "at a limit",   "pushed"};

struct HardPose {
  Pose world_T_tool;
  bool reachable;  ///< within limits, by construction; else nobody knows
};
HardPose hard_pose(const BenchArm& arm, const Screws& screws, Hardness hardness, Engine& engine);

}  // namespace beeline::bench
