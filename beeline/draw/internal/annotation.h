#pragma once

#include <string>

#include <beeline/draw/drawing.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

/// Draws the linear velocity of each Jacobian column at the tool, times `scale` (metres of arrow
/// for each metre per unit of the coordinate), in the style of joint_curve(); Figure 1.8 of
/// Dellaert, *Serial Link Manipulators*. An arrow along a shorter one is wider and below it; the
/// eight longest have labels. With `levers`,
/// adds a dashed line from each revolute joint to the tool.
void add_jacobian_arrows(Drawing& drawing, const Arm& arm, const ConfigurationRef& q, double scale,
                         bool levers = false);

/// Returns the scale at which the longest arrow is 2/5 of the greatest distance of the arm from its
/// base; 1 when no column has a linear velocity.
double jacobian_arrow_scale(const Arm& arm, const ConfigurationRef& q);

/// Draws the angle of each revolute joint of a planar arm as an arc of `radius` metres, from the
/// extension of the previous link (dashed) to the joint's own link, labelled θ₁, θ₂, ... Angles
/// below one degree are omitted.
void add_joint_angles(Drawing& drawing, const Arm& arm, const ConfigurationRef& q, double radius);

/// Formats the joint angles: "θ₁ = 0°, θ₂ = 90°".
std::string angles_text(const ConfigurationRef& q);

/// Formats the tool's pose: "(2.44, 6.28, 0°)" for a planar arm, otherwise the position,
/// "(0.31, 0.00, 0.59) m".
std::string tool_text(const Arm& arm, const ConfigurationRef& q);

}  // namespace beeline::internal
