#pragma once

#include <beeline/pose/se2.h>
#include <beeline/pose/se3.h>

#include "record.h"

namespace beeline::python {

template <>
struct Fields<RollPitchYaw>
    : Members<&RollPitchYaw::roll, &RollPitchYaw::pitch, &RollPitchYaw::yaw> {
  static constexpr bool constructible = true;
};

template <>
struct Fields<Quaternion>
    : Members<&Quaternion::qw, &Quaternion::qx, &Quaternion::qy, &Quaternion::qz> {
  static constexpr bool constructible = true;
};

template <>
struct Fields<Pose2> : Members<&Pose2::x, &Pose2::y, &Pose2::theta> {
  static constexpr bool constructible = true;
};

}  // namespace beeline::python
