#pragma once

#include <span>
#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/model/arm.h>
#include <beeline/pose/se2.h>

namespace beeline {

/// Returns world_T_tool at configuration q: base * T_1(q_1) ... T_n(q_n) * tool (Dellaert, *Serial
/// Link Manipulators*, eq. 1.1). q may be outside its limits. Throws Error when it does not have
/// arm.dof() finite values.
Pose forward_kinematics(const Arm& arm, const ConfigurationRef& q);

/// Returns the pose of the tool of a planar arm that is `pose` in the arm's plane, z included.
/// Throws Error when the arm is not planar.
Pose pose_in_plane(const Arm& arm, const Pose2& pose);

/// Throws Error for a pose outside the plane of a planar arm, whose default task ignores height and
/// tilt: its origin is 1e-6 m or more off the plane, or its z axis 1e-6 rad or more off the
/// world's. The message calls the pose `what` and, if `offers_task`, offers the argument `task`.
void check_in_plane(const Arm& arm, const Pose& pose, const std::string& what = "the pose",
                    bool offers_task = true);

/// Returns the poses of all links in the world, from link 0 (the base) to link n: n + 1 poses for n
/// joints, mimic joints included. The pose of the tool is the last one times arm.tool().
/// Throws Error as forward_kinematics() does.
std::vector<Pose> link_poses(const Arm& arm, const ConfigurationRef& q);

/// The same into the caller's buffer of n + 1 poses, without allocation. Throws Error for another
/// size.
void link_poses(const Arm& arm, const ConfigurationRef& q, std::span<Pose> world_T_link);

}  // namespace beeline
