#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <beeline/kinematics/task.h>

namespace beeline {

struct InverseOptions {
  /// Solutions nearest to it come first; default: the middle of the limits.
  std::optional<Configuration> seed = std::nullopt;
  std::optional<Task> task = std::nullopt;  ///< default: planar for a planar arm, else spatial
  /// Closed form: all solutions there are, else the nearest only. Numerical: those that all
  /// restarts meet, of which some may be missing (and an arm with more joints than the task has
  /// rows has infinitely many), else the first that is met.
  bool all = false;
  bool ignore_limits = false;  ///< joint limits do not count
  /// Largest error of a solution, metres and radians. Never taken below the rounding of forward
  /// kinematics, about 4e-15 of the arm's size: from a reach of 1e5 m on that is what counts.
  double tolerance = 1e-9;
  int iterations = 100;           ///< most steps of the numerical solver in one try
  int restarts = 100;             ///< most tries after the first, from random configurations
  std::uint64_t random_seed = 1;  ///< the same seed gives the same answer
};

enum class InverseStatus {
  solved,          ///< at least one solution, checked by forward kinematics
  unreachable,     ///< proved, for tolerances up to 1e-6: no configuration reaches the pose
  outside_limits,  ///< there are solutions, but none within the joint limits (proved for planar
                   ///< closed form without a continuum, else none was found there)
  not_found,       ///< the search ended without a solution; that none exists is not proved
};
std::string name(InverseStatus status);

struct InverseResult {
  InverseStatus status = InverseStatus::not_found;
  std::vector<Configuration> solutions;  ///< by distance from the seed; empty unless solved
  /// Metres or radians, whichever is larger. Solved: the largest error that forward kinematics
  /// shows. Unreachable: what is missing at least. Else: the error of the nearest miss within
  /// limits, or, where none was looked for there, 0.
  double residual = 0;
  std::string reason;  ///< one sentence; empty when solved
  std::string method;  ///< "planar closed form", "numerical", or "reach" where that settles it
  int iterations = 0;  ///< of the numerical solver, over all tries
  int restarts = 0;    ///< tries from random configurations
};

/// The joint configurations that bring the tool to `world_T_tool`, as far as the task asks.
/// Chooses the method: closed form for planar arms of up to three joints, numerical otherwise.
/// Every q returned has been put through forward kinematics, and is finite and within limits.
/// Angles are given by the turn that is nearest to the seed within limits; lengths, helical joints
/// and joints whose followers would not come round as well are never wrapped. Distances from the
/// seed are Euclidean, radians and metres weighing alike.
/// Throws Error when the pose, the seed or an option makes no sense.
InverseResult inverse_kinematics(const Arm& arm, const Pose& world_T_tool,
                                 const InverseOptions& options = {});

}  // namespace beeline
