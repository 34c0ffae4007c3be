#pragma once

#include <beeline/draw/scene.h>
#include <beeline/model/arm.h>

namespace beeline {

/// Column k's linear velocity at the tool (the chapter's Figure 1.8), times `scale`, in
/// distinct_colour(k). With `levers`, a dashed line from each revolute joint to the tool.
void add_jacobian_arrows(Scene& scene, const Arm& arm, const ConfigurationRef& q, double scale,
                         bool levers = false);

/// A scale at which the longest arrow is as long as 2/5 of the arm's greatest distance from its
/// base.
double jacobian_arrow_scale(const Arm& arm, const ConfigurationRef& q);

/// For a planar arm: each revolute joint's angle as an arc of `radius` metres from the link before
/// (dashed, prolonged) to its own link, named θ₁, θ₂, ...; angles below one degree are left out.
void add_joint_angles(Scene& scene, const Arm& arm, const ConfigurationRef& q, double radius);

}  // namespace beeline
