#pragma once

#include <vector>

#include <beeline/model/arm.h>

namespace beeline::internal {

/// The screw axis of a joint in the world with all joints at 0. For a prismatic joint only the
/// direction and the kind matter.
struct JointLine {
  JointKind kind = JointKind::revolute;
  Vector3 direction = Vector3::UnitZ();  ///< unit length
  Vector3 point = Vector3::Zero();       ///< metres
  double pitch = 0;                      ///< metres per radian
};
std::vector<JointLine> joint_lines(const Arm& arm);

/// The point of line `a` that is nearest to line `b`, which is not parallel to it.
Vector3 foot_of_normal(const JointLine& a, const JointLine& b);

/// The arm with these axes; `world_T_tool` is the tool's pose where all joints are at 0. Joints
/// have the names and limits of `named`.
Arm arm_along(const std::vector<JointLine>& lines, const Pose& world_T_tool, const Arm& named);

/// The invariants of an arm: its pose at q is
///     base * product of Rz(theta_i) Tz(d_i) J(q_i) Tx(a_i) Rx(alpha_i) Ry(beta_i) * tool,
/// with J a rotation about z or a translation along it. Denavit-Hartenberg parameters between the
/// common normals of neighbouring axes, made unique so that two arms with the same motion have
/// equal tables whatever their frames are: alpha is in (0, pi) and a may be negative; theta and d
/// of the first and the last joint are 0. Axes within 1e-3 rad of parallel have d = 0 for the later
/// one and the angle between them in alpha and beta (Hayati & Mirmirani, "Improving the absolute
/// positioning accuracy of robot manipulators", 1985). A prismatic axis, whose place does not
/// matter, passes through the origin of the frame before it.
struct LinkTable {
  struct Row {
    JointKind kind = JointKind::revolute;
    double pitch = 0;
    double theta = 0, d = 0;  ///< parameters of the joint
    double a = 0, alpha = 0,
           beta = 0;        ///< parameters of the following link; zero for the last joint
    bool parallel = false;  ///< whether the next axis is parallel, within 1e-3 rad
  };
  Pose base = Pose::Identity(), tool = Pose::Identity();
  std::vector<Row> rows;
};
LinkTable link_table(const std::vector<JointLine>& lines, const Pose& world_T_tool);

/// The arm of a table, with the names of `named`.
Arm arm_of(const LinkTable& table, const Arm& named);

}  // namespace beeline::internal
