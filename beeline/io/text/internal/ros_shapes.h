#pragma once

#include <array>

#include <beeline/collision/scene.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {

// The shapes of ROS (shape_msgs, geometric_shapes) that no Shape::Body is.

/// Returns a convex hull that contains a cone about the z axis, its tip at length / 2, its base at
/// -length / 2: a pyramid of 64 sides. Throws as check_shape().
Shape cone(double radius, double length);

/// Returns the plane a x + b y + c z + d = 0 as a box without thickness, max_shape_size long.
/// Throws Error for a normal (a, b, c) without direction, and a plane farther away than that.
Shape plane(double a, double b, double c, double d);

/// Returns the pose of a position and a quaternion qx, qy, qz, qw. As in MoveIt, a quaternion of
/// zeros is the identity. Throws as rotation_from_quaternion().
Pose ros_pose(const Vector3& position, const std::array<double, 4>& quaternion);

}  // namespace beeline::internal
