#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/pose/se3.h>

namespace beeline {

/// The one-degree-of-freedom joints R, P and H (Dellaert, *Serial Link Manipulators*, Figures 1.1
/// and 1.2).
enum class JointKind { revolute, prismatic, helical };

/// Limits of one joint, in rad, or m for a prismatic joint, and s. Infinite if there is no limit,
/// or none is known.
struct Limits {
  static constexpr double none = std::numeric_limits<double>::infinity();
  /// Min limit of velocity, acceleration and jerk. A revolution at 1e-9 rad/s takes a century. With
  /// much smaller limits, the ratios of limits in time scaling leave the range of a double.
  static constexpr double min_rate = 1e-9;
  /// Max limit of velocity, acceleration and jerk that is not infinite, in SI units.
  static constexpr double max_rate = 1e10;
  /// Max magnitude of a position limit that is not infinite, rad or m.
  static constexpr double max_position = 1e6;

  double lower = -none;        ///< lower position limit, rad or m, at most `upper`
  double upper = none;         ///< upper position limit, rad or m
  double velocity = none;      ///< limit of |dq/dt|, above 0
  double acceleration = none;  ///< limit of |d2q/dt2|, above 0
  double jerk = none;          ///< limit of |d3q/dt3|, above 0
  /// The speed scale k that the limits have been multiplied by: velocity by k, acceleration by k^2,
  /// jerk by k^3. The values that are assumed for unknown limits are multiplied likewise.
  double speed_scale = 1;
};

/// The velocity limit assumed for a joint without a known one: radians or metres per second.
constexpr double assumed_velocity_limit = 1.0;

/// Assumed times to full speed and from zero to full acceleration, seconds, of a joint without
/// known limits of acceleration or jerk.
constexpr double assumed_time_to_velocity = 0.25;
constexpr double assumed_time_to_acceleration = 0.1;

/// The velocity limit that motions keep, radians or metres per second: the joint's own limit if it
/// is known, otherwise the assumed one.
constexpr double velocity_limit_of(const Limits& limits) {
  return limits.velocity < Limits::none ? limits.velocity
                                        : limits.speed_scale * assumed_velocity_limit;
}

/// Returns the limits that motions keep: the joint's own limits if they are known, otherwise the
/// assumed ones. Only position limits can be infinite.
constexpr Limits motion_limits(Limits limits) {
  limits.velocity = velocity_limit_of(limits);
  if (!(limits.acceleration < Limits::none)) {
    limits.acceleration = limits.speed_scale * limits.velocity / assumed_time_to_velocity;
  }
  if (!(limits.jerk < Limits::none)) {
    limits.jerk = limits.speed_scale * limits.acceleration / assumed_time_to_acceleration;
  }
  return limits;
}

/// Limits that replace a joint's limits, in the same units. std::nullopt keeps the joint's limit.
/// An infinite value means that there is no limit or that none is known.
struct LimitOverrides {
  std::optional<double> lower = std::nullopt;         ///< lower position limit, rad or m
  std::optional<double> upper = std::nullopt;         ///< upper position limit, rad or m
  std::optional<double> velocity = std::nullopt;      ///< limit of |dq/dt|, rad/s or m/s
  std::optional<double> acceleration = std::nullopt;  ///< limit of |d2q/dt2|, rad/s^2 or m/s^2
  std::optional<double> jerk = std::nullopt;          ///< limit of |d3q/dt3|, rad/s^3 or m/s^3
};

Limits overridden(const Limits& limits, const LimitOverrides& overrides);

/// The excess over a position limit that counts as rounding, rad or m.
inline constexpr double position_slack = 1e-9;

/// Whether lower - slack <= q <= upper + slack.
constexpr bool within_position_limits(const Limits& limits, double q,
                                      double slack = position_slack) {
  return q >= limits.lower - slack && q <= limits.upper + slack;
}

/// The position of q in the range from `lower` to `upper`: -1 at the lower end, 0 in the middle, 1
/// at the upper end. 0 if the range is infinite or empty.
inline double position_in_range(double q, double lower, double upper) {
  const double half = (upper - lower) / 2;
  return half > 0 && half < Limits::none ? (q - lower) / half - 1 : 0;
}

/// The distance from q to the nearer end of its range, over half the range: 1 in the middle, 0 on a
/// limit, negative outside. Infinite if the range is infinite or empty.
inline double limit_margin(double q, double lower, double upper) {
  const double half = (upper - lower) / 2;
  if (!(half > 0 && half < Limits::none)) return Limits::none;
  return std::min(q - lower, upper - q) / half;
}

/// The coupling of a joint to another one of the same arm: value = multiplier * leader + offset.
struct Mimic {
  std::string leader;     ///< name of the joint that it follows
  double multiplier = 1;  ///< factor of the leader's value
  double offset = 0;      ///< rad or m
};

/// One degree of freedom between two links. The pose of link i in link i-1 is offset * exp(screw *
/// q) (Dellaert, *Serial Link Manipulators*, eq. 1.1).
struct Joint {
  std::string name;                ///< unique in an arm
  Pose offset = Pose::Identity();  ///< pose of link i in link i-1 at q = 0
  /// Unit screw [vx vy vz wx wy wz] in the frame of link i: |w| = 1 for R and H, w = 0 and |v| = 1
  /// for P.
  Twist screw = Twist::Zero();
  Limits limits;               ///< limits of the coordinate q
  std::optional<Mimic> mimic;  ///< the joint that it follows
  std::string link;            ///< name of link i; empty if it has none
};

/// The kind of a joint, from its screw: P without rotation, H with rotation and pitch, else R.
JointKind kind(const Joint& joint);
char letter(JointKind kind);       ///< 'R', 'P' or 'H'
std::string name(JointKind kind);  ///< "revolute", "prismatic" or "helical"

/// The unit of the joint's coordinate, "rad" or "m", and a value of it formatted for a message:
/// `1.5708 rad (90 deg)` or `0.25 m`.
const char* unit(const Joint& joint);
std::string with_unit(const Joint& joint, double value);

/// The pitch of a helical joint: translation along its axis, metres per radian; 0 for the others.
double pitch(const Joint& joint);

/// The unit screw of a rotation about the line through `point` (metres) along `axis`, with `pitch`
/// metres per radian (Lynch & Park, section 3.3.2.2); and of a translation along `axis`. The axis
/// is normalised. Both throw Error when it is shorter than 1e-9.
Twist rotation_screw(const Vector3& axis, const Vector3& point = Vector3::Zero(), double pitch = 0);
Twist translation_screw(const Vector3& axis);

/// Returns the joint with the same motion whose link frame is `link_T_frame`, fixed to the link.
Joint with_link_frame(Joint joint, const Pose& link_T_frame);

/// exp(screw * q) for a unit screw.
Pose screw_motion(const Twist& unit_screw, double q);

/// The velocity [v w] of the point `point` of the link for unit velocity of its joint, all in the
/// world, where the link's frame is `world_T_link`: a column of the Jacobian.
Twist joint_velocity(const Joint& joint, const Pose& world_T_link, const Vector3& point);

/// T_i^{i-1}(q) = offset * exp(screw * q).
Pose joint_transform(const Joint& joint, double q);

/// The two conventions of Denavit-Hartenberg parameters. A table does not show which one it uses,
/// so it must be stated.
enum class DhConvention {
  standard,  ///< T = Rz(theta) Tz(d) Tx(a) Rx(alpha): Denavit & Hartenberg 1955, Paul 1981
  modified,  ///< T = Tx(a) Rx(alpha) Rz(theta) Tz(d): Craig 1986, with a and alpha of link i-1
};

/// One row of a Denavit-Hartenberg table, metres and radians. The joint's coordinate is added to
/// theta (revolute) or d (prismatic).
struct DhRow {
  double a = 0;                          ///< link length, m
  double alpha = 0;                      ///< link twist, rad
  double d = 0;                          ///< link offset, m
  double theta = 0;                      ///< joint angle, rad
  JointKind kind = JointKind::revolute;  ///< kind of the joint
};

/// Returns the joint of one row, with the convention's link frame and without a name, which arms
/// need: see arm_from_dh().
/// Throws Error for a helical row, which neither convention has.
Joint dh_joint(const DhRow& row, DhConvention convention);

/// A joint type: its letter in joint strings, its name in JSON, and whether it has several degrees
/// of freedom.
struct JointType {
  char letter;
  std::string name;
  bool composite;
};

/// All joint types. To add one, add a row to the table in composite.cpp.
const std::vector<JointType>& joint_types();

/// Expands a joint type (Dellaert, *Serial Link Manipulators*, Figures 1.1 and 1.2) into
/// one-degree-of-freedom joints with coincident frames, in this order:
///   R  revolute: rotation about z
///   P  prismatic: translation along x, the link's direction
///   H  helical: rotation about z with translation along z, `pitch` metres per radian
///   S  spherical: rotations about z, y, x
///   U  universal: rotations about z, y
///   C  cylindrical: rotation about z, translation along z
///   E  planar: translations along x and y, rotation about z
/// A single joint has the name `name`; several are named after their axes, `name_z` for a rotation
/// and `name_slide_x` for a translation. Throws Error for another letter.
std::vector<Joint> composite_joint(char letter, const std::string& name, double pitch = 0);

/// A planar link (section 1.4 of the chapter): `joint`, rotated by `angle` (rad) about z, then
/// `length` metres along x to the link frame.
Joint planar_link(Joint joint, double length, double angle = 0);

}  // namespace beeline
