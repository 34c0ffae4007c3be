#pragma once

#include <vector>

#include <beeline/inverse/numerical/numerical_problem.h>

namespace beeline::internal {

struct LaneOptions {
  double tolerance = 1e-10;  ///< max position and orientation error, metres and radians
  int max_iterations = 100;  ///< max steps of each lane
  bool polish = true;  ///< iterate below the tolerance, down to 1e-13 or the level of rounding
  bool first_is_enough = false;  ///< stop all lanes as soon as one has converged
  /// gauss_newton(): whether a joint with a range above one turn continues one turn away when it
  /// passes a bound, and does not stop there.
  bool wraps = true;
};

/// The state of eight runs of Levenberg-Marquardt that step together. Each thread needs its own.
/// start_lane() sizes it for its first problem; later calls do not allocate.
struct LevenbergMarquardtLanes {
  unsigned active = 0;     ///< bit i: lane i still iterates
  unsigned converged = 0;  ///< bit i: lane i has ended within the tolerance
  unsigned coarse = 0;     ///< bit i: lane i has converged, but stagnated before it was polished
  unsigned within = 0;     ///< bit i: lane i is within the tolerance
  std::vector<EightNumbers> q;      ///< one for each coordinate, in its unit, within the bounds
  EightNumbers error[6];            ///< e, the task's error at q; lengths in units
  EightNumbers cost;                ///< |e|^2; infinite before the first evaluation
  EightNumbers iterations;          ///< steps tried, accepted or not
  EightNumbers factor;              ///< damping over cost
  EightNumbers milestone, due;      ///< the cost must be half of `milestone` by iteration `due`
  std::vector<EightNumbers> trial;  ///< the configuration to evaluate next
  std::vector<EightNumbers> step;
  std::vector<EightNumbers> free;    ///< 1, or 0 for a coordinate held at its bound
  std::vector<EightNumbers> column;  ///< six for each coordinate: the Jacobian at q
  std::vector<EightNumbers> axes;    ///< six for each link: see last_frame()
};

/// Starts lane `lane` at q, clamped to the bounds.
void start_lane(const NumericalProblem& problem, const double* q, int lane,
                LevenbergMarquardtLanes& lanes);

/// Writes a lane's configuration, radians and metres, into the dof numbers at q.
void lane_configuration(const NumericalProblem& problem, const LevenbergMarquardtLanes& lanes,
                        int lane, double* q);
Deviation lane_deviation(const NumericalProblem& problem, const LevenbergMarquardtLanes& lanes,
                         int lane);

/// Iterates all active lanes together until at least one of them ends and becomes inactive
/// (converged, stagnated, or out of iterations), or for `max_steps`. Each lane computes what
/// levenberg_marquardt() does, except for rounding and details at the bounds, independently of the
/// other lanes. Requires a finite pose.
void run_lanes(const NumericalProblem& problem, const Pose& world_T_tool,
               const LaneOptions& options, int max_steps, LevenbergMarquardtLanes& lanes);

/// Throws Error when the pose is not finite, or an option is not finite or negative.
void check_lane_options(const Pose& world_T_tool, const LaneOptions& options);

/// Runs levenberg_marquardt() from up to eight starts, the columns of `starts`. Throws Error when
/// they do not fit the arm or are not finite, and what check_lane_options() throws.
void levenberg_marquardt_lanes(const NumericalProblem& problem, const Pose& world_T_tool,
                               const Eigen::Ref<const Eigen::MatrixXd>& starts,
                               const LaneOptions& options, LevenbergMarquardtLanes& lanes);

}  // namespace beeline::internal
