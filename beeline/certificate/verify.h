#pragma once

#include <initializer_list>
#include <iosfwd>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <beeline/budget.h>
#include <beeline/error.h>
#include <beeline/kinematics/task.h>
#include <beeline/path/tool_path.h>
#include <beeline/reason.h>
#include <beeline/trajectory/limit_usage.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// The bound on a deviation where nothing is proved.
inline constexpr Deviation no_bound{std::numeric_limits<double>::infinity(),
                                    std::numeric_limits<double>::infinity()};

/// Deviation of a joint motion from its path; metres and radians. sampled <= measured <= bound.
struct PathDeviation {
  Deviation sampled;           ///< largest deviation at the samples
  Deviation measured;          ///< largest deviation at the samples and at some times between them
  Deviation bound = no_bound;  ///< proved upper bound at all times; infinite: nothing is proved
  /// Bound proved from each sample to the next: position, m, and orientation, rad, (N - 1, 2).
  std::vector<Deviation> interval_bounds;
  /// How the computation ended; unless complete, `bound` is infinite.
  Ending ending = Ending::complete;
};

/// Measures and bounds the deviation of a trajectory from the path, for the motion that the columns
/// mean (see Interpolation). The columns are in the arm's order. `path_parameters[k]` is the path
/// parameter of sample k: whole segments, with a fraction of the next. On a line the deviation is
/// measured from its nearest point, for any fraction; verify() also checks that each line is
/// traversed to its end.
///
/// Between two samples the error is compared with its quintic Hermite polynomial by a bound on the
/// sixth derivative (certificate/internal/interval_deviation.h). For samples on the path that have
/// its velocity and acceleration, the bound falls with the sixth power of the time between them.
///
/// Throws Error when sizes do not fit, the path parameters are not on the path or decrease, or the
/// task leaves rows free that the path's segments need (see PathMotionOptions::task).
PathDeviation path_deviation(const Arm& arm, const Trajectory& trajectory,
                             std::span<const double> path_parameters, const ToolPath& path,
                             const Task& task, const Budget& budget = {});

/// Computes the path parameters of samples along the path; sample `arrivals[i]` is at the end of
/// segment i. A sample between two arrivals gets the parameter of the nearest point, and a sample
/// after the last arrival gets its segment's end. Throws Error when the arrivals are not indices of
/// samples in order, or more than segments.
std::vector<double> path_parameters_along(const Arm& arm, std::span<const Configuration> samples,
                                          const ToolPath& path,
                                          std::span<const std::size_t> arrivals, const Task& task);

/// Returns the index of the first sample at or after the end of each segment, for the segments
/// whose end the path parameters reach.
std::vector<std::size_t> arrivals(std::span<const double> path_parameters);

/// The faults that verify() finds in a trajectory.
enum class Fault {
  none,    ///< no fault
  limits,  ///< a joint exceeds its position limits, at a sample or between two
  /// A joint rotates by pi or more between two samples that have no velocities or velocities of the
  /// other direction, or faster than its limit: the direction is not known.
  flip,
  deviation,     ///< the tool leaves the path, at a sample or possibly between two
  backwards,     ///< the tool moves back on the path, at a sample or possibly between two
  not_through,   ///< a waypoint is not reached
  velocity,      ///< a velocity limit is exceeded between two samples
  acceleration,  ///< an acceleration limit is exceeded between two samples
  jerk,          ///< a jerk limit is exceeded between two samples
  moving,        ///< a joint moves at the start, the end or a waypoint where a program stops
  dwell,         ///< the arm does not rest long enough at a waypoint of a program
  tool_speed,    ///< the tool is faster than a move of a program allows
};
std::string name(Fault fault);

/// The ends of a trajectory at which the joints may move. At the other ends they are at rest.
struct MovingEnds {
  bool start = false;  ///< whether the joints may move at the start
  bool end = false;    ///< whether they may move at the end
};

/// A fault of a trajectory's joints.
struct JointFault {
  Fault kind = Fault::none;  ///< kind of the fault
  std::size_t sample = 0;    ///< index of the sample at the fault, or of the sample before it
  Reason reason = {};        ///< why: joint, value, limit
};

/// The faults of one kind in a trajectory.
struct FaultsOfKind {
  Fault kind = Fault::none;  ///< kind of the faults
  std::size_t sample = 0;  ///< index of the sample at the first of them, or of the sample before it
  double time = 0;         ///< time of that sample, s
  Reason first = {};       ///< the first in time
  Reason worst = {};       ///< the largest, with its sample and time
  /// Size of the largest, which compares faults of this kind: the excess over position limits, rad
  /// or m; the rotation of a flip, rad; the value as a multiple of the limit for velocity,
  /// acceleration, jerk and moving joints; the multiple of the tolerance for deviations. 0 for
  /// kinds without a size.
  double amount = 0;
};

/// Returns the first fault in time of a trajectory's joints, whose columns are in the arm's order:
/// limits, flip, velocity, acceleration, jerk or moving; see verify() for their meaning.
/// Derivatives may exceed their limits by a millionth, or by the fraction `limit_tolerance` if that
/// is more. They may also exceed them by the effect of rounding times to doubles, which grows with
/// the time and is at most a ten thousandth. For `recover` see VerifyOptions. Returns nothing if
/// the budget ends the check before a fault is found. Throws Error when the trajectory does not fit
/// the arm.
std::optional<JointFault> first_joint_fault(const Arm& arm, const Trajectory& trajectory,
                                            const MovingEnds& moving = {},
                                            const Budget& budget = {}, double limit_tolerance = 0,
                                            double recover = 0);

namespace internal {

/// Throws Error unless a limit tolerance is from 0 to 0.1.
void check_limit_tolerance(double limit_tolerance);

}  // namespace internal

/// The smallest tolerance that plans accept, metres and radians. Smaller ones are comparable with
/// the rounding of samples.
constexpr double min_tolerance = 1e-8;

struct VerifyOptions {
  MovingEnds moving = {};  ///< ends at which the joints may move; default: at rest at both
  /// Task rows that are checked; default: planar for a planar arm, whose path must then be in
  /// its plane, else spatial.
  std::optional<Task> task = std::nullopt;
  double tolerance = 1e-4;              ///< max deviation in position, metres, above 0
  double orientation_tolerance = 1e-4;  ///< max deviation in orientation, radians, above 0
  /// Fraction, 0 to 0.1, by which velocity, acceleration and jerk may exceed their limits, for the
  /// rounding of other planners. A millionth is always accepted.
  double limit_tolerance = 0;
  /// Largest excess over a position limit at the first sample, 0 to 0.1 rad or m, from which the
  /// motion may recover, to rounding: each joint that starts outside returns, and its excess never
  /// rises by more than twice position_slack. The path begins at the first sample at which all are
  /// within their limits.
  double recover = 0;
  Budget budget = {};
};

/// The proof that a trajectory follows a path within the arm's limits, or its faults.
struct Verification {
  Fault fault = Fault::none;  ///< first fault in time
  Reason reason = {};         ///< why: time, sample, fault and amount; none if proved
  std::size_t sample = 0;     ///< index of the sample at the fault, or of the sample before it
  double time = 0;            ///< time of that sample, seconds
  /// Every kind of fault, the one of `fault` first, the others in the order of time. The joints are
  /// checked over the whole trajectory, the direction on the path and between samples up to its
  /// first fault. The worst deviation is the largest distance of a sample from all lines of the
  /// route; with more than 1e6 pairs of a sample and a line only some samples are compared.
  std::vector<FaultsOfKind> faults = {};
  /// Deviation over the whole trajectory. After a fault `sampled`, `measured` and `interval_bounds`
  /// are those up to the fault, and `bound` is infinite.
  PathDeviation deviation;
  ToolPath path;                        ///< path of the route
  std::vector<double> path_parameters;  ///< path parameter of each sample that is on the path
  /// Index of the first sample at or after the end of each segment (of each move, for a program),
  /// for the part of the path that the trajectory follows.
  std::vector<std::size_t> arrivals;
  /// The beginning that leads back within the position limits, if the option `recover` accepts it;
  /// of a motion that starts within them none. The limits and the path are proved after it.
  std::optional<Recovery> recovery = std::nullopt;
  /// How the check ended. Unless complete, the rest of the trajectory has not been checked, and
  /// nothing is proved; a fault that was found is valid but may not be the first.
  Ending ending = Ending::complete;

  /// Returns whether the trajectory is proved.
  explicit operator bool() const { return fault == Fault::none && ending == Ending::complete; }
};

/// Prints the fault with its reason, or the proved deviation.
std::ostream& operator<<(std::ostream& out, const Verification& verification);

/// Proves or refutes, from the columns alone, that a trajectory moves the tool along the whole
/// route within the arm's limits. The trajectory may come from any program. The joints move between
/// samples as the columns mean (see Interpolation).
///
/// - Deviation: assigns a path parameter to each sample. The parameters do not decrease, and fit
///   all samples between two stops together if the path approaches itself. path_deviation() bounds
///   the deviation between samples.
/// - Direction: at all times the tool is within the tolerance of the path's pose at a parameter
///   s(t). On a line this is the pose at the projection x(t) of the tool's origin on it. Neither
///   s(t) nor x(t) falls behind an earlier value on the same segment by more than the tolerance:
///     x(a) - x(b) <= tolerance for all a < b.
///   The motion on a line is bounded by x itself, not by s(t), which may be ahead of it or behind.
/// - Limits of position and velocity hold at all times, by the extremes of the polynomials. So do
///   limits of acceleration for cubics and quintics, and limits of jerk for quintics. Derivatives
///   that jump at the samples are checked for the smoothest motion through the samples: divided
///   differences of the positions times the factorial of the order are weighted means of the
///   derivative. The velocity of linear joints may also change at a sample, by no more than the
///   acceleration limit allows within the shorter interval beside it, on both sides. Planning uses
///   the same rule.
/// - Limits of velocity and acceleration that are not known are assumed (motion_limits()). A jerk
///   limit that is not known is not checked, because minimum-time motions have no jerk limit.
///
/// The columns of velocity and acceleration define the motion, so they cannot be wrong by
/// themselves. False columns are found because their motion exceeds the limits or the tolerance
/// between samples. A motion within both passes, even if its columns differ from its author's
/// intent.
///
/// Throws Error when the trajectory is empty or does not fit the arm, for a route without segments,
/// for a task that its segments do not allow, and for tolerances that are not above zero.
Verification verify(const Arm& arm, const Trajectory& trajectory, const Route& route,
                    const VerifyOptions& options = {});

/// Verifies against straight lines from the trajectory's first pose through the waypoints.
Verification verify(const Arm& arm, const Trajectory& trajectory, std::span<const Pose> waypoints,
                    const VerifyOptions& options = {});
Verification verify(const Arm& arm, const Trajectory& trajectory,
                    std::initializer_list<Pose> waypoints, const VerifyOptions& options = {});

/// Verifies the limits of the joints only, without a path: `deviation.bound` is infinite. The
/// task and the tolerances of the options have no effect.
Verification verify(const Arm& arm, const Trajectory& trajectory,
                    const VerifyOptions& options = {});

}  // namespace beeline
