#pragma once

#include <vector>

#include <beeline/draw/scene.h>
#include <beeline/model/arm.h>

namespace beeline {

struct ArmStyle {
  bool frames = false;  ///< every link's frame, named {0} to {n}
  bool faded = false;   ///< behind everything else, as a state of the past
  bool tool = true;     ///< the tool's frame
};

/// The arm at configuration q. Throws Error when q does not fit the arm.
void add_arm(Scene& scene, const Arm& arm, const ConfigurationRef& q, const ArmStyle& style = {});

/// Where the tool went: a thin line, and dots that lie closer where it went slower. Of more than
/// `most_dots` points every m-th gets a dot; the line keeps the extremes between them.
void add_trail(Scene& scene, const std::vector<Vector3>& points, std::size_t most_dots = 2000);

/// Column k's linear velocity at the tool (the chapter's Figure 1.8), times `scale`, in
/// distinct_colour(k). With `levers`, a dashed line from each revolute joint to the tool.
void add_jacobian_arrows(Scene& scene, const Arm& arm, const ConfigurationRef& q, double scale,
                         bool levers = false);

/// A scale at which the longest arrow is as long as 2/5 of the arm's greatest distance from its
/// base.
double jacobian_arrow_scale(const Arm& arm, const ConfigurationRef& q);

/// Goals: a ring and a little frame at each, with its name from `names` where there is one.
void add_poses(Scene& scene, const std::vector<Pose>& poses,
               const std::vector<std::string>& names = {});

/// For a planar arm: each revolute joint's angle as an arc of `radius` metres from the link before
/// (dashed, prolonged) to its own link, named θ₁, θ₂, ...; angles below one degree are left out.
void add_joint_angles(Scene& scene, const Arm& arm, const ConfigurationRef& q, double radius);

/// The tool's positions over a motion.
std::vector<Vector3> tool_positions(const Arm& arm, const std::vector<Configuration>& motion);

}  // namespace beeline
