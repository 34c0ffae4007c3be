#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/model/arm.h>
#include <beeline/pose/se3.h>

namespace beeline::fuzz {

/// Turns bytes into arms and numbers, special ones often; zero when the bytes are used up.
class Bytes {
 public:
  explicit Bytes(std::string_view input) : rest_(input) {}

  int integer(int low, int high) { return low + next() % (high - low + 1); }
  bool flag() { return next() % 2 == 1; }

  /// From -1 to 1, in steps of 2^-23.
  double unit() {
    const int number = (next() << 16) + (next() << 8) + next();
    return number / 8388608.0 - 1;
  }

  /// From -pi to pi: a multiple of 45 degrees, next to one, or any.
  double angle() {
    constexpr std::array<double, 8> offsets{0, 0, 1e-15, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3};
    const int choice = next();
    if (choice % 4 == 3) return std::numbers::pi * unit();
    const double offset = offsets[static_cast<std::size_t>(choice / 8 % 8)];
    return (choice / 64 - 2) * std::numbers::pi / 4 + (choice % 4 == 1 ? -offset : offset);
  }

  /// Metres: 0, tiny, or up to 1.
  double length() {
    constexpr std::array<double, 4> special{0, 1e-9, 1e-4, 0.3};
    const int choice = next();
    return choice % 2 == 0 ? special[static_cast<std::size_t>(choice / 2 % 4)] : unit();
  }

  Pose pose() {
    Pose pose = make_pose({length(), length(), length()});
    const double roll = angle(), pitch = angle(), yaw = angle();
    pose.linear() =
        (Eigen::AngleAxisd(yaw, Vector3::UnitZ()) * Eigen::AngleAxisd(pitch, Vector3::UnitY()) *
         Eigen::AngleAxisd(roll, Vector3::UnitX()))
            .toRotationMatrix();
    return pose;
  }

  Arm arm() {
    std::vector<Joint> joints(static_cast<std::size_t>(integer(1, 7)));
    for (std::size_t i = 0; i < joints.size(); ++i) {
      Joint& joint = joints[i];
      joint.name = "j" + std::to_string(i + 1);
      joint.offset = pose();
      const int kind = integer(0, 15);
      if (kind == 0) joint.screw = translation_screw(Vector3::UnitZ());
      if (kind == 1) joint.screw = rotation_screw(Vector3::UnitZ(), Vector3::Zero(), 0.1);
      if (flag()) joint.limits = {.lower = -3 + unit(), .upper = unit() + 2};
    }
    return {"fuzzed", joints, flag() ? pose() : Pose::Identity()};
  }

  /// A configuration within the limits.
  Configuration configuration(const Arm& arm) {
    Configuration q(arm.dof());
    for (int k = 0; k < arm.dof(); ++k) {
      const Limits& limits = arm.limits(k);
      const int choice = integer(0, 15);
      q[k] = std::min(std::max(angle(), limits.lower), limits.upper);
      if (choice == 0 && std::isfinite(limits.lower)) q[k] = limits.lower;
      if (choice == 1 && std::isfinite(limits.upper)) q[k] = limits.upper;
    }
    return q;
  }

 private:
  int next() {
    if (rest_.empty()) return 0;
    const auto byte = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    return byte;
  }

  std::string_view rest_;
};

}  // namespace beeline::fuzz
