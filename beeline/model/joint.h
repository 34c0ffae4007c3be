#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

#include <beeline/pose/se3.h>

namespace beeline {

/// R, P and H of the chapter's Figures 1.1 and 1.2.
enum class JointKind { revolute, prismatic, helical };

/// Symmetric bounds except for the position. Radians and seconds; metres where the joint is
/// prismatic. Infinity where nothing is known.
struct Limits {
  static constexpr double none = std::numeric_limits<double>::infinity();
  double lower = -none;
  double upper = none;
  double velocity = none;
  double acceleration = none;
  double jerk = none;
};

/// The excess over a position limit that counts as rounding, rad or m.
inline constexpr double position_slack = 1e-9;

/// Whether lower - slack <= q <= upper + slack.
constexpr bool within_position_limits(const Limits& limits, double q,
                                      double slack = position_slack) {
  return q >= limits.lower - slack && q <= limits.upper + slack;
}

/// Where q is in the range from `lower` to `upper`: -1 at the lower end, 0 in the middle, 1 at the
/// upper end. 0 where the range is infinite or empty.
inline double position_in_range(double q, double lower, double upper) {
  const double half = (upper - lower) / 2;
  return half > 0 && half < Limits::none ? (q - lower) / half - 1 : 0;
}

/// The distance from q to the nearer end of its range, over half the range: 1 in the middle, 0 on a
/// limit, negative outside. Infinite where the range is infinite or empty.
inline double limit_margin(double q, double lower, double upper) {
  const double half = (upper - lower) / 2;
  if (!(half > 0 && half < Limits::none)) return Limits::none;
  return std::min(q - lower, upper - q) / half;
}

/// A joint that follows another one of the same arm: value = multiplier * leader + offset.
struct Mimic {
  std::string leader;  ///< the leading joint's name
  double multiplier = 1;
  double offset = 0;
};

/// One degree of freedom between two links, as data. Frame i of the chapter's eq. 1.1 is
///     T_i^{i-1}(q) = offset * exp(screw * q),
/// so `offset` is the pose of link i in link i-1 at q = 0, and `screw` the unit twist of the
/// motion, written in the frame of link i.
struct Joint {
  std::string name;
  Pose offset = Pose::Identity();
  Twist screw = Twist::Zero();  ///< [v w]; |w| = 1 for R and H, w = 0 and |v| = 1 for P
  Limits limits;
  std::optional<Mimic> mimic;
  std::string link;  ///< the name of the link that the joint moves; empty: none given
};

/// Told by the screw: no rotation is P, rotation with pitch is H, rotation alone is R.
JointKind kind(const Joint& joint);
char letter(JointKind kind);       ///< 'R', 'P' or 'H'
const char* name(JointKind kind);  ///< "revolute", "prismatic" or "helical"

/// The unit of the joint's coordinate, "rad" or "m"; and a value with it for a message:
/// `1.5708 rad (90 deg)` or `0.25 m`.
const char* unit(const Joint& joint);
std::string with_unit(const Joint& joint, double value);

/// Travel of a helical joint along its axis, metres per radian; 0 for a revolute one.
double pitch(const Joint& joint);

/// The unit screw of a joint whose axis runs along `axis` (any length but zero) through `point`,
/// with `pitch` metres of travel per radian. Throws Error when the axis is shorter than 1e-9.
Twist rotation_screw(const Vector3& axis, const Vector3& point = Vector3::Zero(), double pitch = 0);
Twist translation_screw(const Vector3& axis);

/// The same motion seen from a frame `link_T_frame` fixed to the link: used to move link frames.
Joint with_link_frame(Joint joint, const Pose& link_T_frame);

/// exp(screw * q) for a unit screw: Rodrigues' formula about the axis, plus the travel along it.
Pose screw_motion(const Twist& unit_screw, double q);

/// The velocity [v w] of the point `point` of the link for unit velocity of its joint, all in the
/// world, where the link's frame is `world_T_link`: a column of the Jacobian.
Twist joint_velocity(const Joint& joint, const Pose& world_T_link, const Vector3& point);

/// T_i^{i-1}(q) = offset * exp(screw * q).
Pose joint_transform(const Joint& joint, double q);

}  // namespace beeline
