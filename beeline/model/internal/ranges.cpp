#include <cmath>
#include <utility>

#include <beeline/error.h>
#include <beeline/model/internal/ranges.h>

namespace beeline::internal {
namespace {

std::string plus_minus(double largest, const char* unit) {
  return "-" + number(largest) + " to " + number(largest) + " " + unit;
}

void check_position_limit(double limit, const std::string& what) {
  if (std::isnan(limit)) throw Error(what + " has a position limit that is NaN");
  if (std::isinf(limit) || std::abs(limit) <= Limits::max_position) return;
  throw Error(what + ": position limit " + number(limit) + " is outside " +
              plus_minus(Limits::max_position, "rad or m") + "; omit it if there is no limit");
}

}  // namespace

void check_count(std::size_t joints, const std::string& arm) {
  if (joints == 0) throw Error("arm " + arm + " has no joints; it needs at least one");
  if (joints <= max_joints) return;
  throw Error("arm " + arm + " has " + std::to_string(joints) + " joints; at most " +
              std::to_string(max_joints) + " are accepted");
}

void check_limits(const Limits& limits, const std::string& what) {
  check_position_limit(limits.lower, what);
  check_position_limit(limits.upper, what);
  if (limits.lower > limits.upper) {
    throw Error(what + ": lower limit " + number(limits.lower) + " exceeds upper limit " +
                number(limits.upper));
  }
  if (limits.lower == Limits::none || limits.upper == -Limits::none) {
    throw Error(what + " has limits " + number(limits.lower) + " to " + number(limits.upper) +
                "; no finite value lies between them");
  }
  const std::pair<const char*, double> rates[] = {
      {"velocity", limits.velocity}, {"acceleration", limits.acceleration}, {"jerk", limits.jerk}};
  for (const auto& [quantity, rate] : rates) {
    if (rate == Limits::none || (rate >= Limits::min_rate && rate <= Limits::max_rate)) continue;
    throw Error(what + ": " + quantity + " limit " + number(rate) + " is " +
                (rate > Limits::max_rate ? "above " + number(Limits::max_rate)
                                         : "below " + number(Limits::min_rate)) +
                "; omit it if there is no limit");
  }
}

void check_joint(Joint& joint, std::size_t index) {
  constexpr double rounding = 1e-9;  // of a screw's unit length
  const std::string what =
      "joint " + std::to_string(index + 1) + (joint.name.empty() ? "" : " (" + joint.name + ")");
  if (joint.name.empty()) throw Error(what + " has no name");
  joint.offset = checked_placement(joint.offset, what + ": the offset");
  if (!joint.screw.allFinite()) throw Error(what + " has a screw that is not finite");
  if (joint.screw.cwiseAbs().maxCoeff() > max_length) {
    throw Error(what + " has a screw with the number " + number(joint.screw.cwiseAbs().maxCoeff()) +
                "; accepted are " + plus_minus(max_length, "m"));
  }
  const double rotation = joint.screw.tail<3>().norm();
  const double unit = rotation == 0 ? joint.screw.head<3>().norm() : rotation;
  if (std::abs(unit - 1) > rounding) {
    throw Error(what + " has a screw of length " + number(unit) +
                "; it must be 1: [vx vy vz wx wy wz] with w of length 1, or 0 and v of length 1");
  }
  check_limits(joint.limits, what);
}

void check_coupling(const Arm::JointCoupling& coupling, const std::string& joint) {
  if (std::abs(coupling.ratio) <= max_mimic && std::abs(coupling.shift) <= max_mimic) return;
  throw Error("joint " + joint + ": its mimic multiplier " + number(coupling.ratio) +
              " or offset " + number(coupling.shift) + " is outside " + plus_minus(max_mimic, "") +
              "(multiplied along its leaders)");
}

Pose checked_placement(const Pose& pose, const std::string& what) {
  const double largest = pose.translation().cwiseAbs().maxCoeff();
  if (!pose.translation().allFinite() || largest <= max_length) return checked_pose(pose, what);
  throw Error(what + " has the length " + number(largest) + " m; accepted are " +
              plus_minus(max_length, "m"));
}

}  // namespace beeline::internal
