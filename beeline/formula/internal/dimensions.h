#pragma once

#include <optional>
#include <vector>

#include <beeline/model/arm.h>
#include <beeline/model/internal/dh_row.h>
#include <beeline/model/joint.h>

namespace beeline::internal {

/// Returns the planar link that gives the joint, as dh_row() does: a rotation `theta` about z, the
/// joint (R about z or P along x), and a translation `a` along x.
std::optional<DhRow> planar_row(const Joint& joint, double tolerance, double unit = 1);

/// A rotation about an axis of the current frame: 0, 1, 2 for x, y, z.
struct AxisRotation {
  int axis = 2;
  double angle = 0;  ///< angle, rad
};

/// Writes a rotation as at most three rotations about axes of the current frame, with as few angles
/// as possible that are not multiples of 15 degrees. Yaw, pitch and roll are preferred. Otherwise
/// the first rotation is about `before` and the last about `after`, the axes of the joints on both
/// sides.
std::vector<AxisRotation> axis_rotations(const Rotation& rotation, int before, int after,
                                         double tolerance);

/// Returns the product of rotations about axes of the current frame.
Rotation product(const std::vector<AxisRotation>& rotations);

/// Returns k if the angle is within `tolerance` of k * 15 degrees, otherwise nothing.
std::optional<int> multiple_of_15_degrees(double angle, double tolerance);

}  // namespace beeline::internal
