#pragma once

#include <array>

#include "poses.h"

namespace beeline::bench {

/// Kinds of poses for which solvers tend to report wrong results.
enum class Hardness {
  plain,     ///< of a random configuration within limits
  beyond,    ///< out of reach, some by less than 1e-6 m
  turned,    ///< a reachable position with a random orientation
  singular,  ///< of a configuration at or next to multiples of a right angle
  at_limit,  ///< of a configuration with joints at or next to their limits
  pushed,    ///< next to a singular one, then slightly displaced
};
constexpr std::array<const char*, 6> hardness_names{"plain",    "beyond reach", "turned",
                                                    "singular", "at a limit",   "pushed"};

struct HardPose {
  Pose world_T_tool;
  bool reachable;  ///< reachable within limits by construction; otherwise unknown
};
HardPose hard_pose(const BenchArm& arm, const Screws& screws, Hardness hardness, Engine& engine);

}  // namespace beeline::bench
