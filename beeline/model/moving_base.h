#pragma once

#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {

/// Returns a copy on a rail: a prismatic joint called `rail`, before the arm's own joints, moves
/// the whole arm along `axis`, a direction in the world of any length above 1e-9. With the rail at
/// 0 m the arm stands where it stood:
///     world_T_tool(d, q) = translation(d * axis / |axis|) * world_T_tool(q).
/// behind_joints() gives the shapes of its links. `limits`, in m and s, are the limits of the rail.
/// The root frame of the controller holds for the rail at 0. The joint is called rail2, rail3 and
/// so on if the arm has one of this name. Throws Error for an axis without a direction and for
/// limits that Arm refuses.
Arm with_rail(const Arm& arm, const Vector3& axis, const Limits& limits = {});

/// Limits of the joints of a mobile base.
struct MobileBase {
  Limits x = {};        ///< of the translation along the world's x axis, m
  Limits y = {};        ///< of the translation along the world's y axis, m
  Limits heading = {};  ///< of the rotation about the vertical axis of the base, rad
};

/// Returns a copy on a mobile base that moves in the plane z = constant: three joints, base_x,
/// base_y and base_heading, before the arm's own joints. With all three at 0 the arm stands where
/// it stood and the origin of the world is the centre of the base:
///     world_T_tool(x, y, h, q) = translation(x, y, 0) * rotation_z(h) * world_T_tool(q).
/// Each joint moves on its own, as an omnidirectional base does; a base whose wheels cannot roll
/// sideways cannot follow every motion. Shapes, names, controller and errors are as with_rail().
Arm with_mobile_base(const Arm& arm, const MobileBase& base = {});

/// Whether with_rail() or with_mobile_base() made the first joint, as the names of the joint and of
/// its link say.
bool has_moving_base(const Arm& arm);

}  // namespace beeline
