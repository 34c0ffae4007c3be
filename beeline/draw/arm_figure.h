#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/collision/collision_model.h>
#include <beeline/draw/animation.h>
#include <beeline/draw/figure.h>
#include <beeline/error.h>
#include <beeline/model/arm.h>
#include <beeline/planning/program.h>
#include <beeline/pose/se2.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// Joint i of an arm in the world. The arm's centre line meets the joint's axis at `enter` and
/// leaves it at `leave`.
struct SkeletonJoint {
  JointKind kind = JointKind::revolute;
  Vector3 direction = Vector3::UnitZ();  ///< unit direction of the axis
  Vector3 enter = Vector3::Zero();
  Vector3 leave = Vector3::Zero();
  Vector3 centre = Vector3::Zero();  ///< position of the symbol: midpoint of enter and leave, or
                                     ///< `enter` for a prismatic joint
};

/// The centre line of an arm from base to tool, metres, in the world. It follows the joint axes and
/// their common perpendiculars (the lengths d and a of Denavit & Hartenberg), so it does not depend
/// on the choice of link frames.
struct Skeleton {
  Vector3 base = Vector3::Zero();
  std::vector<SkeletonJoint> joints;
  Vector3 tool = Vector3::Zero();

  std::vector<Vector3> line() const;  ///< base, then enter and leave of every joint, then tool
  double size() const;                ///< the greatest distance of its points from the base, metres
};

/// Returns the centre line at configuration q. Throws Error when q does not fit the arm.
Skeleton skeleton(const Arm& arm, const ConfigurationRef& q);

/// Options of arm_figure(), motion_figure() and motion_animation().
struct ArmFigureOptions {
  std::string title = {};    ///< title; default: the arm's name
  std::string caption = {};  ///< caption; default: the tool's position
  bool frames = false;       ///< whether to draw the frame of every link: x red, y green, z blue
  /// Whether to draw the Jacobian's columns as arrows at the tool: joint 1 red, 2 green, 3 blue.
  bool jacobian = false;
  double azimuth = -0.87;   ///< azimuth of the viewer of a spatial arm, from x towards y, rad
  double elevation = 0.44;  ///< elevation of the viewer above the ground, rad
  /// Whether to add small views from above and from the front (spatial arms).
  bool small_views = true;
  int ghosts = 3;  ///< number of earlier configurations of a motion, drawn faded, 0 to 1000
  /// Number of dots on the trail of a motion, at equal times, up to 100,000.
  std::size_t dots = 81;
};

/// Draws the arm at configuration q: a planar arm from above, otherwise an oblique view with two
/// small views beside it. Throws Error when q does not fit the arm.
Figure arm_figure(const Arm& arm, const ConfigurationRef& q, const ArmFigureOptions& options = {});

/// Draws the arm of a model in the same way among its obstacles, with the shapes of its links and a
/// line between the nearest points of the pair with the least distance beyond its clearance. The
/// caption states that pair. Throws Error when q does not fit the arm.
Figure arm_figure(const CollisionModel& model, const ConfigurationRef& q,
                  const ArmFigureOptions& options = {});

/// Returns a configuration that shows the arm well: the middle of the position limits or, if the
/// arm is singular there, a configuration far from singularities. Of 200 configurations around the
/// middle, it has the largest inverse condition number above the plane of the base.
Configuration display_configuration(const Arm& arm);

/// Draws a motion: the trail of the tool by the trajectory's own polynomials (see sample()), the
/// arm at the end, faded arms at the start and between, and the waypoints, numbered from 1. If an
/// arm stands upright, the parts of the trail below the plane of its base are violet, and the
/// caption states the depth of the tool or the lowest joint. Throws Error for a motion without
/// samples and for a trajectory that does not fit the arm.
Figure motion_figure(const Arm& arm, const Trajectory& trajectory,
                     const std::vector<Pose>& waypoints = {}, const ArmFigureOptions& options = {});

/// Draws a motion in the same way among the obstacles of a model, with the shapes of the links at
/// the end and at the closest approach, where it draws the line between the nearest points. The
/// closest approach is the one of 201 times; prove_clearance() proves it.
Figure motion_figure(const CollisionModel& model, const Trajectory& trajectory,
                     const std::vector<Pose>& waypoints = {}, const ArmFigureOptions& options = {});

/// Draws the motion of a program in the same way, with the parts that it carries. `scenes`:
/// program_scenes(); the picture has the obstacles of the last one. Throws Error for no scenes too.
Figure motion_figure(std::span<const ProgramScene> scenes, const Trajectory& trajectory,
                     const std::vector<Pose>& waypoints = {}, const ArmFigureOptions& options = {});

/// Draws a motion as an animation in real time: the arm moves and leaves the trail of its tool.
/// There is one frame each 1/50 s, and at most 1000 frames.
Animation motion_animation(const Arm& arm, const Trajectory& trajectory,
                           const std::vector<Pose>& waypoints = {},
                           const ArmFigureOptions& options = {});

/// Draws a motion as an animation among the obstacles of a model, with the shapes of the links and
/// the line between the nearest points at each time.
Animation motion_animation(const CollisionModel& model, const Trajectory& trajectory,
                           const std::vector<Pose>& waypoints = {},
                           const ArmFigureOptions& options = {});

/// Draws the motion of a program as an animation in the same way, with the parts that it carries.
Animation motion_animation(std::span<const ProgramScene> scenes, const Trajectory& trajectory,
                           const std::vector<Pose>& waypoints = {},
                           const ArmFigureOptions& options = {});

/// Returns the figure numbers of Dellaert, *Serial Link Manipulators*, that chapter_figure() draws:
/// 1.1 to 1.9, and "splines", the waypoints of Figure 1.9 by lines and by a spline.
std::vector<std::string> chapter_figures();

/// Draws a figure of the chapter. Figures 1.3 and 1.6 to 1.9 are computed for its arm with link
/// lengths 3.5, 3.5 and 2. Throws Error for an unknown number; the message lists the known ones.
Figure chapter_figure(std::string_view number);

/// Draws Figure 1.7 or 1.9 with the arm in motion. Throws Error for any other number.
Animation chapter_animation(std::string_view number);

/// Returns the motion of Figure 1.7: proportional control (eq. 1.3) from q = 0 to
/// q_d = (99.2, -68.8, -30.4) degrees, in steps of 0.05 s.
Trajectory figure_1_7_motion();

/// Returns the start configuration of Figure 1.9, its three waypoints, and the motion of the tool
/// in straight lines through them by the inverse Jacobian (eq. 1.6), in steps of 0.005 s.
Configuration figure_1_9_start();
std::vector<Pose2> figure_1_9_waypoints();
Trajectory figure_1_9_motion();

}  // namespace beeline
