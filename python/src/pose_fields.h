#pragma once

#include <beeline/pose/se2.h>
#include <beeline/pose/se3.h>

#include "record.h"

namespace beeline::python {

template <>
struct Fields<RollPitchYaw> {
  static constexpr const char* name = "RollPitchYaw";
  static constexpr const char* doc =
      "Roll, pitch and yaw as in URDF: rotations about the fixed axes X, then Y, then Z, rad.";
  static constexpr bool constructible = true;
  static constexpr auto all() {
    return std::tuple(field("roll", &RollPitchYaw::roll, "About X, rad."),
                      field("pitch", &RollPitchYaw::pitch, "About Y, rad."),
                      field("yaw", &RollPitchYaw::yaw, "About Z, rad."));
  }
};

template <>
struct Fields<Quaternion> {
  static constexpr const char* name = "Quaternion";
  static constexpr const char* doc = "The quaternion qw + qx i + qy j + qz k.";
  static constexpr bool constructible = true;
  static constexpr auto all() {
    return std::tuple(field("qw", &Quaternion::qw, "The real part."),
                      field("qx", &Quaternion::qx, "Of i."), field("qy", &Quaternion::qy, "Of j."),
                      field("qz", &Quaternion::qz, "Of k."));
  }
};

template <>
struct Fields<Pose2> {
  static constexpr const char* name = "Pose2";
  static constexpr const char* doc =
      "A planar pose as in Dellaert, *Serial Link Manipulators*. `a @ b` composes two.";
  static constexpr bool constructible = true;
  static constexpr auto all() {
    return std::tuple(field("x", &Pose2::x, "Metres."), field("y", &Pose2::y, "Metres."),
                      field("theta", &Pose2::theta, "Radians."));
  }
};

}  // namespace beeline::python
