#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <beeline/kinematics/task.h>

namespace beeline {

struct InverseOptions {
  std::optional<Configuration> seed;  ///< solutions nearest to it come first; default: the middle
  std::optional<Task> task;           ///< default: planar for a planar arm, else spatial
  bool all = false;                   ///< every solution that the method can tell, else the nearest
  bool ignore_limits = false;         ///< joint limits do not count
  double tolerance = 1e-9;            ///< largest error of a solution, metres and radians
  int iterations = 100;               ///< most steps of the numerical solver in one try
  int restarts = 100;                 ///< most tries after the first, from random configurations
  std::uint64_t random_seed = 1;      ///< the same seed gives the same answer
};

enum class InverseStatus {
  solved,          ///< at least one solution, checked by forward kinematics
  unreachable,     ///< proved: no configuration reaches the pose
  outside_limits,  ///< there are solutions, but none within the joint limits
  not_found,       ///< the search ended without a solution; that none exists is not proved
};
std::string name(InverseStatus status);

struct InverseResult {
  InverseStatus status = InverseStatus::not_found;
  std::vector<Configuration> solutions;  ///< by distance from the seed; empty unless solved
  double residual = 0;  ///< largest error of the solutions, or of the nearest miss; metres, radians
  std::string reason;   ///< one sentence; empty when solved
  std::string method;   ///< "planar closed form" or "numerical"
  int iterations = 0;   ///< of the numerical solver, over all tries
  int restarts = 0;     ///< tries after the first
};

/// The joint configurations that bring the tool to `world_T_tool`, as far as the task asks.
/// Chooses the method: closed form for planar arms of up to three joints, numerical otherwise.
/// Every q returned has been put through forward kinematics, and is finite and within limits.
/// Throws Error when the pose, the seed or an option makes no sense.
InverseResult inverse_kinematics(const Arm& arm, const Pose& world_T_tool,
                                 const InverseOptions& options = {});

}  // namespace beeline
