#pragma once

#include <string>
#include <vector>

#include <beeline/budget.h>
#include <beeline/error.h>
#include <beeline/path/joint_path.h>

namespace beeline {

/// The limits of a motion along a path in joint space, one number for each coordinate. Infinity
/// means no limit; finite limits are 1e-100 or more.
struct PathLimits {
  Configuration velocity;      ///< rad/s or m/s
  Configuration acceleration;  ///< rad/s^2 or m/s^2
  Configuration jerk;          ///< rad/s^3 or m/s^3
  /// The largest ds/dt at each grid point of the path, for example from a limit of the tool's
  /// speed; empty: no such limit.
  std::vector<double> speed;
  /// The fraction of the limits of acceleration and jerk that may be used at each grid point, above
  /// 0 to 1; empty: all of them everywhere.
  std::vector<double> fraction = {};
};

/// Returns the arm's limits, unknown ones replaced by assumed ones: see motion_limits(). The
/// speed scale k, from 1e-6 to 1, slows the motion down: velocity limits are multiplied by k,
/// acceleration by k^2, jerk by k^3. Throws Error for another scale.
PathLimits path_limits(const Arm& arm, double speed_scale = 1);

/// Throws Error unless there is one limit of each kind, 1e-100 or more, for each coordinate of the
/// path, and no speed or fraction or one for each grid point.
void check_limits(const PathLimits& limits, const JointPath& path);

/// A time scaling s(t) of a path: the path parameter as a function of time.
struct TimeScaling {
  Reason reason = {};                ///< why there is no time scaling; otherwise none
  std::vector<double> s;             ///< path parameter, strictly increasing, (N,)
  std::vector<double> t;             ///< seconds, strictly increasing from 0, (N,)
  std::vector<double> speed;         ///< ds/dt, (N,)
  std::vector<double> acceleration;  ///< d2s/dt2, (N,); the mean of both sides at a jump
  /// Whether d2s/dt2 is continuous: then s(t) is the quintic Hermite polynomial between points;
  /// else d2s/dt2 is constant there.
  bool smooth = false;

  /// Whether there is a time scaling.
  explicit operator bool() const { return !reason; }
  double duration() const { return t.empty() ? 0 : t.back(); }
};

/// The form of a time scaling s(t) of a path. All profiles begin and end at rest and are within the
/// limits of velocity and acceleration. The samples of a motion keep known jerk limits with every
/// profile; a profile without jerk in its form needs wider ramps of acceleration or a slowdown for
/// this.
enum class Profile {
  /// Minimum time under velocity and acceleration limits, or the motion by `jerk` if that is
  /// shorter.
  fastest,
  /// Minimum time under velocity, acceleration and jerk limits: a local optimum.
  jerk,
  /// One trapezoid of ds/dt: constant acceleration, cruise, constant deceleration.
  trapezoidal,
  /// s = 10 u^3 - 15 u^4 + 6 u^5 in u = t / T; s(t) keeps jerk limits.
  quintic,
  /// One s-curve: d2s/dt2 is a trapezoid in each half, d3s/dt3 piecewise constant; s(t) keeps jerk
  /// limits.
  s_curve,
};

/// The profile's name, as in "s-curve".
std::string name(Profile profile);

/// The names of all profiles.
std::vector<std::string> profile_names();

/// Throws Error listing the names of the profiles for another name.
Profile profile_named(const std::string& name);

/// Whether the time scaling s(t) keeps jerk limits, and a motion assumed ones.
bool keeps_jerk(Profile profile);

/// The profile of motions for which none is given.
constexpr Profile default_profile = Profile::jerk;

/// Returns the time scaling of a path by a profile:
///     minimise T  subject to  |dq_i/dt| <= velocity_i,  |d2q_i/dt2| <= acceleration_i,
///                             |d3q_i/dt3| <= jerk_i (where the profile keeps it),
///                             ds/dt <= speed,  at rest at t = 0 and t = T,
/// over all s(t) for fastest and jerk, and over all s(t) of the profile's form for the others. If
/// the budget ends the search of the profile jerk, returns the best time scaling so far, which
/// keeps the limits. Returns none, with the reason, if the budget ends the computation before one
/// is found. Throws Error for a path or limits that are not valid (check_path(), check_limits()),
/// and for Profile::jerk without any jerk limit.
TimeScaling time_scaling(const JointPath& path, const PathLimits& limits, Profile profile,
                         const Budget& budget = {});

}  // namespace beeline
