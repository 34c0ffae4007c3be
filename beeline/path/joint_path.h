#pragma once

#include <vector>

#include <beeline/model/arm.h>

namespace beeline {

/// A way through the joint space without time, as plain data: at grid point k the configuration
/// q[k], and its first and second derivative by the parameter s, which may be of any unit. Between
/// grid points the path is the quintic that has these values at both ends of the step.
struct JointPath {
  std::vector<double> s;           ///< strictly increasing
  std::vector<Configuration> q;    ///< radians, metres
  std::vector<Configuration> dq;   ///< q', by s
  std::vector<Configuration> ddq;  ///< q'', by s

  std::size_t size() const { return s.size(); }
};

/// Throws Error unless there are two grid points or more, all columns are as long as s and of the
/// same number of coordinates, all numbers are finite and s increases.
void check_path(const JointPath& path);

/// The path and its derivatives by s at one place.
struct PathPoint {
  Configuration q, dq, ddq, dddq;
};

/// At the fraction `share` (0 to 1) of step k, which leads from grid point k to k + 1.
PathPoint path_point(const JointPath& path, std::size_t step, double share);

struct RefineOptions {
  std::size_t steps = 400;    ///< no step is longer than the path over this number
  double largest_turn = 0.1;  ///< of q' in a step, as a share of its length
  int max_parts = 512;        ///< of one step
};

/// The same path with more grid points: those of `path` stay, and steps that are long or bend are
/// cut into equal parts.
JointPath refined(const JointPath& path, const RefineOptions& options = {});

}  // namespace beeline
