#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include <beeline/budget.h>
#include <beeline/certificate/verify.h>
#include <beeline/error.h>
#include <beeline/inverse/inverse_kinematics.h>

namespace beeline {

/// The outcome of a motion. Every status except `reached` has a reason.
enum class MotionStatus {
  reached,         ///< the goal is reached, within tolerance
  unreachable,     ///< no configuration reaches a pose of the path: by geometry or search
  not_found,       ///< no configuration was found for a pose of the path; one may exist
  outside_limits,  ///< a joint would have to leave its limits
  singular,    ///< the arm is at a singularity and can continue only by a jump to another branch
  not_proved,  ///< the deviation between samples is not proved to be within tolerance
  too_many_samples,  ///< the tolerance needs more than the option max_samples
  not_converged,     ///< a feedback controller did not converge to the goal, see ControlledMotion
  collides,          ///< a planned motion brings two bodies closer than their clearance
  not_decided,       ///< whether a planned motion keeps its clearance is not decided
  time_limit,        ///< the budget's time ended the search
  cancelled,         ///< the search was cancelled
  work_limit,        ///< the budget's work ended the search
};
std::string name(MotionStatus status);

/// Returns the status of a motion through a pose for which inverse kinematics has this status.
MotionStatus motion_status(InverseStatus status);

/// The samples of an arm along one segment of a path, up to the point where it can no longer track
/// it.
struct TrackedSegment {
  std::vector<Configuration> samples;  ///< samples, the first at the segment's beginning
  std::vector<double> fractions;  ///< fraction of the segment at each sample, the first 0, (N,)
  PathDeviation deviation;        ///< deviation from the path
  bool complete() const { return fractions.back() == 1; }
};

/// One continuous motion of the arm along a path, without times: a solution of inverse kinematics
/// at its beginning, tracked as far as possible.
struct Branch {
  Configuration start = {};  ///< configuration at the path's beginning
  MotionStatus status = MotionStatus::reached;
  Reason reason = {};  ///< reason and position of its end before the path's end
  /// Path parameter where it ends: the number of complete segments plus a fraction of the next.
  double path_parameter = 0;
  /// Smallest distance of a joint to a position limit, as a fraction of half its range; 1 if no
  /// joint has limits, 0 if the budget ended the search.
  double limit_margin = 1;
  /// Smallest inverse condition number of the task's Jacobian along the branch: its smallest over
  /// its largest singular value, with lengths in units of the arm's reach. It is 0 at a singularity
  /// and at most 1. 0 if the budget ended the search.
  double inverse_condition = 1;
  /// Least value of BranchOptions::spare_clearance at the samples, m; infinite without it.
  double spare_clearance = Limits::none;
  /// Samples along each segment; one sample if the task's rows are at rest.
  std::vector<TrackedSegment> segments = {};

  /// Whether it reaches the end of the path.
  explicit operator bool() const { return status == MotionStatus::reached; }
};

/// Spare clearance, m, that is as good as the middle of a joint's range; more is not better.
constexpr double enough_spare_clearance = 0.1;

struct BranchOptions {
  Task task;                           ///< rows that are constrained; default: spatial, all six
  Deviation tolerance = {1e-4, 1e-4};  ///< max deviation in m and rad, above 0, between samples too
  std::size_t max_samples = 200'000;   ///< max samples of one branch; beyond it `too_many_samples`
  /// For redundant arms: max approximate number of solutions per pose in the graph of
  /// configurations. Grids of 16, 64 and 256 solutions are tried in this order; 16 is always tried.
  /// With one redundant joint each grid halves the distances between nodes of the one before.
  int max_grid = 256;
  enum class Reasons { all, best, none };
  /// The branches whose reason for ending is determined; this takes milliseconds per branch.
  Reasons reasons = Reasons::best;
  /// Returns the preferred configuration at a path parameter, for poses with several solutions;
  /// default: no preference.
  std::function<Configuration(double)> guide = {};
  /// Distance beyond the clearance at a configuration, m, negative where it is blocked, usually
  /// spare_clearance() of a model (in Python the CollisionModel). A complete branch with a
  /// negative value gives way to the others. Default: nothing is blocked.
  std::function<double(const ConfigurationRef&)> spare_clearance = {};
  Budget budget = {};
};

/// Plans the arm's motion along a path, without times, from `start` or, without a start, from the
/// best configuration for the path's beginning.
///
/// With options.spare_clearance, complete branches without blocked samples precede the others. The
/// self-motion of a redundant arm avoids blocked configurations and keeps away from joint limits
/// and obstacles.
///
/// Rows of the task that the arm does not move independently of the others, such as the height of a
/// planar arm's tool, must be kept, but leave the arm as redundant as the others do, also in
/// Branch::inverse_condition.
///
/// - An arm that is redundant for the task follows the best path through a graph of configurations
///   (Ferrentino & Chiacchio 2020), which is refined until a motion is complete. With one redundant
///   joint the graph has the curves of self-motion that a motion can reach, traced along the path,
///   and the smallest margin to the joint limits over the whole path is maximised first, up to a
///   fifth: see internal/self_motion_graph.h for the programme. With more redundant joints, if no
///   motion is complete and 5 mm beyond the clearance, it also tries the motion that keeps all rows
///   of the tool's pose: relative to the path, the tool then keeps the pose that it has at the
///   start, or the path's pose. The one with more spare clearance is taken.
/// - Any other arm follows the best of all branches.
///
/// If none is complete, returns the one that reaches farthest, with its reason. If the budget ends
/// the search, returns the best so far with the budget's status. Throws Error for a path without
/// segments or without a span for each, a task that its segments do not allow, tolerances that are
/// not above zero, and a start that does not fit the arm or whose tool is not at the path's
/// beginning.
Branch plan_path(const Arm& arm, const std::optional<Configuration>& start, const ToolPath& path,
                 const BranchOptions& options);

/// Computes all branches along a path with their reasons, best first: one for each solution of
/// inverse kinematics at the path's beginning. For a redundant arm the solutions are on a coarse
/// grid. A branch that the budget ended has the budget's status; a branch that was not begun has no
/// segments. Throws Error as plan_path() does.
std::vector<Branch> branch_map(const Arm& arm, const ToolPath& path, const BranchOptions& options);

}  // namespace beeline
