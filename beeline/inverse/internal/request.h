#pragma once

#include <chrono>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>

namespace beeline::internal {

/// What is asked of inverse kinematics, checked and with its defaults filled in.
struct Request {
  const Arm& arm;
  const InverseOptions& options;
  Pose goal;
  Task task;
  Configuration seed;
  Bounds bounds;  ///< the limits, or none where these do not count
  double tolerance = 0;
  std::chrono::steady_clock::time_point deadline;
};

/// Throws Error for options that make no sense for the arm, whatever the pose.
void check_options(const Arm& arm, const InverseOptions& options);

/// `options` are checked already, but for the seed. Throws Error when pose or seed make no sense.
Request make_request(const Arm& arm, const InverseOptions& options, const Task& task,
                     const Bounds& bounds, const Pose& world_T_tool, const Configuration& seed);

/// The larger part of the task's error at q, by forward kinematics.
double error_at(const Request& request, const Configuration& q);

/// Adds q to the solutions by the turns nearest to the seed, if so it is within limits, forward
/// kinematics confirms it, and it is not there yet. `q` is a posture that some method claims to be
/// a solution; its last digits are mended.
void confirm(const Request& request, const Configuration& q, InverseResult& result);

/// Sorts the solutions and leaves out what was not asked for.
void finish(const Request& request, InverseResult& result);

}  // namespace beeline::internal
