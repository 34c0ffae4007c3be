#pragma once

#include <memory>
#include <optional>

#include "screws.h"

namespace beeline::bench {

/// Orocos KDL's Levenberg-Marquardt solver (ChainIkSolverPos_LMA): one try, without limits.
/// kdl_peer.cpp is built where KDL is installed, kdl_missing.cpp where it is not.
class KdlPeer {
 public:
  static bool installed();

  /// Throws Error unless KDL's forward kinematics agrees with the benchmark's own.
  explicit KdlPeer(const Screws& screws);
  ~KdlPeer();

  /// Returns whether KDL reports convergence; `q` is its result.
  bool solve(const Pose& world_T_tool, const Configuration& seed, Configuration& q);

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace beeline::bench
