#pragma once

#include <optional>
#include <span>
#include <string>

#include <beeline/motion/joint_faults.h>
#include <beeline/motion/straightness.h>

namespace beeline {

struct VerifyOptions {
  std::optional<Task> task = std::nullopt;  ///< default: planar for a planar arm, else spatial
  double tolerance = 1e-4;                  ///< metres
  double orientation_tolerance = 1e-4;      ///< radians
};

struct Verification {
  Fault fault = Fault::none;
  std::string reason;         ///< one sentence: what, where, by how much; empty when all is well
  std::size_t sample = 0;     ///< of the first fault: at it, or between it and the next
  double time = 0;            ///< of that sample, seconds
  Straightness straightness;  ///< on all lines; of the first fault alone when there is one
  std::vector<std::size_t> arrivals;  ///< the sample at each waypoint, as far as they are reached
};

/// Whether a trajectory, whoever made it, moves the tool in straight lines from its own first pose
/// through the waypoints and keeps the arm's limits, joints in proportion between samples: proved
/// from its numbers alone. Which sample reaches which waypoint is found out. The first fault in
/// time is told. Velocities, accelerations and jerks are told by the positions' divided
/// differences: a smooth motion through the samples that keeps a limit passes, whatever its rate.
/// Between samples with velocities the cubic that these make must stay within the position limits
/// too. Limits that are not known are none here. Throws Error when the trajectory does not fit the
/// arm or is none (see check_trajectory()), for waypoints that are none, and options that make no
/// sense.
Verification verify(const Arm& arm, const Trajectory& trajectory, std::span<const Pose> waypoints,
                    const VerifyOptions& options = {});

}  // namespace beeline
