#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/model/arm.h>
#include <beeline/pose/se3.h>

namespace beeline {
namespace {

/// Returns the largest part of the pitch v . w that may be an effect of the decimals to which the
/// numbers are rounded; 0 if they have more than eight.
double rounding_of_pitch(const Twist& screw) {
  const Vector3 v = screw.head<3>(), w = screw.tail<3>();
  const bool is_exact = std::abs(w.squaredNorm() - 1) < 1e-12;  // w
  const double sum = w.lpNorm<1>() + (is_exact ? 0 : v.lpNorm<1>());
  constexpr double margin = 1.01, finest = 0.9e-8, shown = 1e-12;
  for (double digit = 1; digit > finest; digit /= 10) {
    const Twist rest = screw - digit * (screw / digit).array().round().matrix();
    if (rest.cwiseAbs().maxCoeff() < shown * std::max(1.0, v.norm())) {
      return margin * digit / 2 * sum;
    }
  }
  return 0;
}

/// Returns a screw of unit length and with an exact pitch, which `what` names in errors: typed
/// numbers are rounded.
Twist exact_screw(const Twist& screw, const std::string& what) {
  constexpr double rounded = 1e-3;    // of a length
  constexpr double vanishing = 1e-9;  // length, and pitch in metres per radian and metre of |v|
  if (!screw.allFinite()) throw Error(what + " has a number that is not finite");
  const bool rotates = screw.tail<3>().norm() > vanishing;
  const double length = rotates ? screw.tail<3>().norm() : screw.head<3>().norm();
  if (!(std::abs(length - 1) <= rounded)) {
    throw Error(
        what + (rotates ? " has w of length " : " has w = 0 and v of length ") + number(length) +
        (rotates ? "; a rotation needs 1, and a translation w = 0" : "; a translation needs 1"));
  }
  Twist unit = screw / length;
  if (!rotates) {
    unit.tail<3>().setZero();
    return unit;
  }
  const Vector3 v = unit.head<3>(), w = unit.tail<3>();
  const double pitch = v.dot(w);
  const Vector3 normal = v - pitch * w;
  if (std::abs(pitch) <= vanishing * std::max(1.0, v.norm())) {
    unit.head<3>() = normal;
  } else if (std::abs(pitch) <= rounding_of_pitch(screw)) {
    throw Error(what + " has a pitch, v . w, of " + number(pitch) +
                " m/rad, which may be rounding of its digits; a rotation has 0, as with v = " +
                number(normal.x()) + " " + number(normal.y()) + " " + number(normal.z()));
  }
  return unit;
}

/// Returns the point of a rotation's axis nearest to `point`.
Vector3 nearest_on_axis(const Twist& screw, const Vector3& point) {
  const Vector3 w = screw.tail<3>();
  const Vector3 foot = w.cross(screw.head<3>());
  return foot + w.dot(point) * w;
}

}  // namespace

Arm arm_from_screws(const std::string& name, std::span<const Twist> screws, const Pose& home,
                    ScrewFrame frame, std::span<const Limits> limits) {
  if (!limits.empty() && limits.size() != screws.size()) {
    throw Error(
        "", "limits",
        ": " + std::to_string(limits.size()) + " for " + std::to_string(screws.size()) + " joints");
  }
  const Pose world_T_tool = checked_pose(home, "home");
  Vector3 origin = Vector3::Zero();  // of the link before, in the world
  std::vector<Joint> joints;
  for (const Twist& given : screws) {
    Joint joint;
    joint.name = "joint" + std::to_string(joints.size() + 1);
    Twist screw = exact_screw(given, "the screw of " + joint.name);
    if (frame == ScrewFrame::body) screw = adjoint(world_T_tool, screw);
    const Vector3 w = screw.tail<3>();
    const Vector3 here = w.isZero(0) ? origin : nearest_on_axis(screw, origin);
    joint.offset.translation() = here - origin;
    joint.screw = screw;
    if (!w.isZero(0)) joint.screw << pitch(joint) * w, w;  // its frame is on the axis
    if (!limits.empty()) joint.limits = limits[joints.size()];
    joints.push_back(std::move(joint));
    origin = here;
  }
  Pose tool = world_T_tool;
  tool.translation() -= origin;
  return Arm(name, std::move(joints), tool);
}

Pose home_pose(const Arm& arm) {
  Pose home = arm.base();
  for (const Joint& joint : arm.joints()) home = home * joint.offset;
  return home * arm.tool();
}

std::vector<Twist> screws(const Arm& arm, ScrewFrame frame) {
  Pose link = arm.base();
  if (frame == ScrewFrame::body) link = home_pose(arm).inverse(Eigen::Isometry) * link;
  std::vector<Twist> found;
  for (const Joint& joint : arm.joints()) {
    link = link * joint.offset;
    found.push_back(adjoint(link, joint.screw));
  }
  return found;
}

}  // namespace beeline
