#pragma once

#include <iosfwd>
#include <optional>
#include <span>
#include <string>

#include <beeline/certificate/joint_faults.h>
#include <beeline/certificate/path_deviation.h>

namespace beeline {

struct VerifyOptions {
  std::optional<Task> task = std::nullopt;  ///< default: planar for a planar arm, else spatial
  double tolerance = 1e-4;                  ///< metres
  double orientation_tolerance = 1e-4;      ///< radians
};

struct Verification {
  Fault fault = Fault::none;
  std::string reason;       ///< one sentence: what, where, by how much; empty when all is well
  std::size_t sample = 0;   ///< of the first fault: at it, or between it and the next
  double time = 0;          ///< of that sample, seconds
  PathDeviation deviation;  ///< on all the way; of the first fault alone when there is one
  ToolPath path;            ///< that was to be followed
  std::vector<double> path_parameters;  ///< on it, of the samples, as far as it is followed
  std::vector<std::size_t> arrivals;    ///< the sample at each waypoint, as far as they are reached
};
/// Prints the fault with the reason, or the proved deviation.
std::ostream& operator<<(std::ostream& out, const Verification& verification);

/// Whether a trajectory, whoever made it, moves the tool all along the route and keeps the arm's
/// limits, joints in proportion between samples: proved from its numbers alone. Which sample is
/// where on the route is found out; the tool may not go back on its way. The first
/// fault in time is told. Velocities, accelerations and jerks are told by the positions' divided
/// differences: a smooth motion through the samples that keeps a limit passes, whatever its rate.
/// Between samples with velocities the cubic that these make must stay within the position limits
/// too. Limits that are not known are none here. Throws Error when the trajectory does not fit the
/// arm or is none (see check_trajectory()), for a route without segments, what check_task()
/// refuses, and options that make no sense.
Verification verify(const Arm& arm, const Trajectory& trajectory, const Route& route,
                    const VerifyOptions& options = {});

/// The same for straight lines from the trajectory's own first pose through the waypoints.
Verification verify(const Arm& arm, const Trajectory& trajectory, std::span<const Pose> waypoints,
                    const VerifyOptions& options = {});

}  // namespace beeline
