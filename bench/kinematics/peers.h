#pragma once

#include <memory>

#include "../inverse/screws.h"

namespace beeline::bench {

/// Another library's kinematics of the same arm, called as its users call it.
class KinematicsPeer {
 public:
  virtual ~KinematicsPeer() = default;
  virtual const char* name() const = 0;

  /// The tool's pose.
  virtual Pose forward(const Configuration& q) = 0;

  /// The Jacobian of the tool's origin in the world's axes, linear rows first, as far as the
  /// library gives it without the pose; returns what depends on it.
  virtual double jacobian(const Configuration& q) = 0;
};

/// Those that were found when the benchmark was built. Throws Error where one's pose differs from
/// the benchmark's own by more than 1e-12.
std::vector<std::unique_ptr<KinematicsPeer>> kinematics_peers(const Screws& screws);

std::unique_ptr<KinematicsPeer> kdl_kinematics(const Screws& screws);
std::unique_ptr<KinematicsPeer> pinocchio_kinematics(const Screws& screws);

}  // namespace beeline::bench
