#pragma once

#include <initializer_list>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <beeline/budget.h>
#include <beeline/certificate/joint_faults.h>
#include <beeline/certificate/path_deviation.h>
#include <beeline/error.h>

namespace beeline {

struct VerifyOptions {
  MovingEnds moving = {};                   ///< default: the trajectory starts and ends at rest
  std::optional<Task> task = std::nullopt;  ///< default: planar for a planar arm, else spatial
  double tolerance = 1e-4;                  ///< max deviation in position, metres, above 0
  double orientation_tolerance = 1e-4;      ///< max deviation in orientation, radians, above 0
  /// Fraction, 0 to 0.1, by which velocity, acceleration and jerk may exceed their limits, for the
  /// rounding of other planners; a millionth is always accepted.
  double limit_tolerance = 0;
  Budget budget = {};
};

struct Verification {
  Fault fault = Fault::none;            ///< the first in time
  Reason reason = {};                   ///< time, sample, what, by how much; none if proved
  std::size_t sample = 0;               ///< the fault is at this sample, or between it and the next
  double time = 0;                      ///< of that sample, seconds
  PathDeviation deviation;              ///< over the whole trajectory, or up to the fault
  ToolPath path;                        ///< of the route
  std::vector<double> path_parameters;  ///< of the samples, as far as they are on the path
  /// arrivals[i] is the sample at the end of segment i, or the first after it, as far as the
  /// trajectory follows the path.
  std::vector<std::size_t> arrivals;
  /// Otherwise the rest of the trajectory has not been checked, and nothing is proved; a fault that
  /// was found is one, but not always the first.
  Ending ending = Ending::complete;

  explicit operator bool() const { return fault == Fault::none && ending == Ending::complete; }
};

/// Prints the fault with its reason, or the proved deviation.
std::ostream& operator<<(std::ostream& out, const Verification& verification);

/// Proves or refutes, from the columns alone, that a trajectory moves the tool along the whole
/// route within the arm's limits, whichever program computed it. The joints move between samples as
/// the columns mean (see Interpolation).
///
/// - Deviation: assigns a path parameter to each sample; these do not decrease, and fit all samples
///   between two stops together where the path approaches itself. path_deviation() bounds the
///   deviation between samples.
/// - Direction: at all times the tool is within the tolerance of the path's pose at a parameter
///   s(t), on a line of that at the projection x(t) of the tool's origin on it; and neither
///   s(t) nor x(t) falls behind an earlier value on the same segment by more than the tolerance:
///     x(a) - x(b) <= tolerance for all a < b.
///   The motion on a line is bounded by x itself, not by s(t), which may be ahead of it or behind.
/// - Position and velocity limits hold at all times, by the extremes of the polynomials, and so do
///   those of acceleration for cubics and quintics and of jerk for quintics. Derivatives that jump
///   at the samples are checked for the smoothest motion through these: divided differences of the
///   positions times the factorial of the order are weighted means of the derivative. The velocity
///   of linear joints may also change at a sample by no more than the acceleration limit allows
///   within the shorter interval beside it, on both sides. Planning counts them alike.
/// - Limits of velocity and acceleration that are not known count as assumed (motion_limits()). A
///   jerk limit that is not known is not checked, because minimum-time motions have no jerk limit.
///
/// Columns of velocity or acceleration are what the motion is, so they cannot be wrong by
/// themselves: false ones are found by the limits and the tolerance that the motion they mean
/// exceeds between samples. A motion within both passes, whatever its author meant.
///
/// Throws Error when the trajectory is empty or does not fit the arm, for a route without segments,
/// a task that its segments do not allow, and tolerances that are not above zero.
Verification verify(const Arm& arm, const Trajectory& trajectory, const Route& route,
                    const VerifyOptions& options = {});

/// The same for straight lines from the trajectory's first pose through the waypoints.
Verification verify(const Arm& arm, const Trajectory& trajectory, std::span<const Pose> waypoints,
                    const VerifyOptions& options = {});
Verification verify(const Arm& arm, const Trajectory& trajectory,
                    std::initializer_list<Pose> waypoints, const VerifyOptions& options = {});

}  // namespace beeline
