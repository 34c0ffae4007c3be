#pragma once

#include <memory>

#include "../inverse/screws.h"

namespace beeline::bench {

/// Another library's kinematics of the same arm, through its usual interface.
class KinematicsPeer {
 public:
  virtual ~KinematicsPeer() = default;
  virtual const char* name() const = 0;

  /// Computes the tool pose.
  virtual Pose forward(const Configuration& q) = 0;

  /// Computes the Jacobian of the tool's origin in the world's axes, linear rows first; returns a
  /// value that depends on it.
  virtual double jacobian(const Configuration& q) = 0;
};

/// Returns the peers found when the benchmark was built. Throws Error when the pose of one differs
/// from the benchmark's own by more than 1e-12.
std::vector<std::unique_ptr<KinematicsPeer>> kinematics_peers(const Screws& screws);

std::unique_ptr<KinematicsPeer> kdl_kinematics(const Screws& screws);
std::unique_ptr<KinematicsPeer> pinocchio_kinematics(const Screws& screws);

}  // namespace beeline::bench
