#pragma once

#include <optional>
#include <vector>

#include <beeline/model/arm.h>
#include <beeline/model/dh.h>

namespace beeline::internal {

/// The largest length of an arm, in metres, at most 1: of its offsets, base, tool, and of the
/// moments and pitches of its screws. Lengths below zero_length times it are taken as zero.
double length_unit(const Arm& arm);
constexpr double zero_length = 1e-12;

/// Returns the Denavit-Hartenberg row that gives the joint, or nothing if none does within
/// `tolerance` (rad; lengths zero_length, both times `unit`, see length_unit()).
std::optional<DhRow> dh_row(const Joint& joint, DhConvention convention, double tolerance,
                            double unit = 1);

/// The same for a planar link: a rotation `theta` about z, the joint (R about z or P along x), and
/// a translation `a` along x.
std::optional<DhRow> planar_row(const Joint& joint, double tolerance, double unit = 1);

/// A rotation about an axis of the current frame: 0, 1, 2 for x, y, z.
struct AxisRotation {
  int axis = 2;
  double angle = 0;  ///< rad
};

/// Writes a rotation as at most three rotations about axes of the current frame, with as few as
/// possible angles that are not multiples of 15 degrees. Preferred are yaw, pitch and roll;
/// otherwise the first rotation is about `before` and the last about `after`, the axes of the
/// joints on both sides.
std::vector<AxisRotation> axis_rotations(const Rotation& rotation, int before, int after,
                                         double tolerance);

/// The product of rotations about axes of the current frame.
Rotation product(const std::vector<AxisRotation>& rotations);

/// The multiple of 15 degrees within `tolerance` of an angle, or nothing.
std::optional<int> fifteenths(double angle, double tolerance);

}  // namespace beeline::internal
