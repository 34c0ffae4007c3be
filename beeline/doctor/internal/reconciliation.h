#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <beeline/doctor/comparison.h>

namespace beeline::internal {

/// An explanation of arm B by arm A: B(gain * q + offset) = mount * arm(q) * tcp for every q.
struct Reconciliation {
  Arm arm;  ///< arm A with other numbers
  Pose mount = Pose::Identity(), tcp = Pose::Identity();
  Configuration gain, offset;  ///< one for each joint
  std::vector<ModelDifference> differences = {};

  explicit Reconciliation(const Arm& a)
      : arm(a), gain(Configuration::Ones(a.dof())), offset(Configuration::Zero(a.dof())) {}
};

/// The largest deviation of the explanation from B at `count` random configurations.
Deviation deviation(const Reconciliation& explanation, const Arm& b, int count);

/// Whether a deviation is only rounding, for two arms whose numbers differ by up to `tolerance`.
bool negligible(const Deviation& deviation, const Arm& b, double tolerance);

/// The arm without limits and with a coordinate for each joint.
Arm bare(const Arm& arm);

/// `joint 3 (elbow)`.
std::string joint_text(const Arm& arm, std::size_t joint);

/// The numbers of a vector; those below 5e-10 as 0.
std::string number_list(const Vector3& v, const std::string& separator);

/// Whether two poses are equal within the tolerance (m, rad).
bool same_pose(const Pose& a, const Pose& b, double tolerance);

/// The coordinate, rad or m, of a joint with this screw at which its motion is `motion`; nothing if
/// it is another motion.
std::optional<double> motion_of(const Twist& screw, const Pose& motion, double tolerance);

/// Returns the pose without rounding errors: lengths to 1e-9 m, and roll, pitch and yaw set exactly
/// to a multiple of 15 degrees if they are within `tolerance` (rad) of it.
Pose without_rounding(const Pose& pose, double tolerance);

/// A pose as options take it: `0,0,0.3`, or with roll, pitch and yaw `0,0,0.3,0,0,1.5708`.
std::string pose_argument(const Pose& pose);

// The differences, with the same wording in all explanations.
ModelDifference mount_difference(const Pose& mount);
ModelDifference tool_difference(const Pose& tcp);
ModelDifference offset_difference(const Arm& a, std::size_t joint, double offset);
ModelDifference sign_difference(std::size_t joint);
/// `kind` is length or angle; `where` follows the dimension's name: " to the axis of joint 2:".
ModelDifference parameter_difference(DifferenceKind kind, std::size_t joint,
                                     const std::string& dimension, double in_a, double in_b,
                                     const std::string& where = {});

/// Compares base and tool of two arms with explained links, and adds the differences.
void add_end_differences(const Arm& a, const Arm& b, double tolerance, Reconciliation& explanation);

}  // namespace beeline::internal
