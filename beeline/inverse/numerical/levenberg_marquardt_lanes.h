#pragma once

#include <vector>

#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/model/chain.h>

namespace beeline::internal {

/// What descents need to know of an arm, a task and bounds, made once for many poses. Inside,
/// lengths count in units of `length`, slides' coordinates too, so that they weigh like radians;
/// it is a power of two, so that this rounds nothing.
struct NumericalProblem {
  Arm arm;
  Task task;
  Bounds bounds;
  double length = 1;  ///< metres; near unit_of_length(arm)
  Chain chain;        ///< in units of length
  struct Coordinate {
    double unit = 1;                 ///< radians or metres
    double lower = 0, upper = 0;     ///< the bounds in units
    bool wraps = false;              ///< goes on a turn away where it comes to a bound
    double lowest = 0, highest = 0;  ///< where it stops: infinite where it goes on a turn away
    bool slides = false;
    bool turns_around = false;         ///< see turns_around()
    int first_link = 0, end_link = 0;  ///< its links are those of `links` from here to there
  };
  std::vector<Coordinate> coordinates;
  std::vector<int> links;
};

/// Throws Error for an arm, task and bounds for which levenberg_marquardt() does.
NumericalProblem numerical_problem(const Arm& arm, const Task& task, const Bounds& bounds);

/// The number of descents that run together.
inline constexpr int solver_lane_count = 8;

/// A number of each descent, as the machine's widest registers take them.
struct alignas(64) EightNumbers {
  double lane[solver_lane_count] = {};
};

struct LaneOptions {
  double tolerance = 1e-10;      ///< metres and radians
  int iterations = 100;          ///< most steps of each descent
  bool polish = true;            ///< go on below the tolerance to 1e-13, or where rounding ends it
  bool first_is_enough = false;  ///< when one has arrived, the others' way is of no use any more
};

/// Eight descents on their way: where they are, and what their next steps need. One for each
/// thread; sized by start_lane() for the first problem, so that later calls do not allocate.
struct LevenbergMarquardtLanes {
  unsigned active = 0;              ///< bit i: lane i is under way
  unsigned arrived = 0;             ///< bit i: lane i has ended within the tolerance
  unsigned coarse = 0;              ///< bit i: and was stuck there on its way to 3e-11
  unsigned within = 0;              ///< bit i: lane i is within it
  std::vector<EightNumbers> q;      ///< a row for each coordinate, in its unit, within the bounds
  EightNumbers error[6];            ///< of the task at q; lengths in units
  EightNumbers cost;                ///< its square; infinite before the first look
  EightNumbers iterations;          ///< steps taken or tried
  EightNumbers factor;              ///< damping over cost
  EightNumbers milestone, due;      ///< the cost to halve until this step
  std::vector<EightNumbers> trial;  ///< the configuration to look at next
  std::vector<EightNumbers> step;
  std::vector<EightNumbers> free;    ///< 1, or 0 for a coordinate held at its bound
  std::vector<EightNumbers> column;  ///< six rows for each coordinate: the Jacobian at q
  std::vector<EightNumbers> axes;    ///< six rows for each link: see last_frame()
};

/// Sets lane `lane` on its way from q, which is brought within the bounds.
void start_lane(const NumericalProblem& problem, const double* q, int lane,
                LevenbergMarquardtLanes& lanes);

/// Where a lane is, in radians and metres: dof numbers into q.
void lane_configuration(const NumericalProblem& problem, const LevenbergMarquardtLanes& lanes,
                        int lane, double* q);
Deviation lane_deviation(const NumericalProblem& problem, const LevenbergMarquardtLanes& lanes,
                         int lane);

/// Runs the active lanes on towards the pose, all in step, until one or more of them end (arrived,
/// stuck, or out of iterations; no longer active), or for `max_steps`. Each lane does what
/// levenberg_marquardt() does, but for rounding and details of the bounds, whatever the other lanes
/// do. The pose must be finite.
void run_lanes(const NumericalProblem& problem, const Pose& world_T_tool,
               const LaneOptions& options, int max_steps, LevenbergMarquardtLanes& lanes);

/// Throws Error when the pose is not finite, or an option is not finite or negative.
void check_lane_options(const Pose& world_T_tool, const LaneOptions& options);

/// Searches from up to eight starts, one in each column, to their ends. Throws Error when
/// they do not fit the arm or are not finite, and what check_lane_options() throws.
void levenberg_marquardt_lanes(const NumericalProblem& problem, const Pose& world_T_tool,
                               const Eigen::Ref<const Eigen::MatrixXd>& starts,
                               const LaneOptions& options, LevenbergMarquardtLanes& lanes);

}  // namespace beeline::internal
