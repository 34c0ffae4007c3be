#pragma once

#include <beeline/inverse/numerical/levenberg_marquardt_lanes.h>

namespace beeline::internal {

/// A descent on its own that starts near the pose, as when a path is tracked: one configuration
/// runs faster without the other lanes. One for each thread; sized by the first start.
struct GaussNewtonState {
  std::vector<double> q;  ///< in the coordinates' units, within the bounds
  double error[6] = {};   ///< of the task at q; lengths in units
  int iterations = 0;
  std::vector<double> before;  ///< the step before
  std::vector<double> move;    ///< the step
  std::vector<char> free;      ///< whether a coordinate has not come to a bound
  std::vector<double> axes;    ///< eight numbers for each link: direction and origin
  std::vector<EightNumbers> angle, sine, cosine;  ///< of the links, eight by eight
  double normal[6 * solver_lane_count] = {};      ///< the factors of J J^T, rows of eight
  std::vector<EightNumbers> column;  ///< for each coordinate: the six numbers of its column
};

/// Gauss-Newton with geodesic acceleration (Transtrum & Sethna 2012) from `start`, which is first
/// brought within the bounds, to the pose of a task with all six rows: two or three steps from a
/// tenth of a radian away. Says whether it arrives. It does not where the error does not fall fast,
/// nor from a quarter turn away; then run_lanes() may. A joint that comes to a bound stays there.
/// The pose must be finite and the start fit.
bool gauss_newton(const NumericalProblem& problem, const Pose& world_T_tool, const double* start,
                  const LaneOptions& options, GaussNewtonState& near);

}  // namespace beeline::internal
