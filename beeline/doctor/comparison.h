#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/kinematics/task.h>
#include <beeline/model/arm.h>

namespace beeline {

/// The kind of a difference between two descriptions of an arm.
enum class DifferenceKind {
  convention,    ///< the same table, with standard and with modified Denavit-Hartenberg parameters
  unit,          ///< all lengths, or all angles, in another unit
  columns,       ///< columns of a table are exchanged or shifted
  joint_order,   ///< two joints are exchanged
  joint_count,   ///< a joint is missing
  joint_kind,    ///< a joint is revolute in one arm, and prismatic or helical in the other
  mount,         ///< the pose of the base in the world
  tool,          ///< the pose of the tool in the last link
  joint_offset,  ///< the value of a joint's coordinate at one configuration
  joint_sign,    ///< the direction that counts as positive
  length,        ///< a dimension of a link, metres
  angle,         ///< a dimension of a link, rad
  axis,          ///< the axis of a joint in the frame of its link
  orientation,   ///< the orientation of a link's frame
  mimic,         ///< the coupling of a joint to another
  name,          ///< the order of the joints' names
  limit,         ///< a joint limit
};
std::string name(DifferenceKind kind);

/// A difference, and the change of arm A that makes it describe arm B.
struct ModelDifference {
  DifferenceKind kind = DifferenceKind::length;
  int joint = -1;              ///< joint index in A, from 0; -1: the whole arm
  std::string parameter = {};  ///< parameter name, such as d, alpha, `upper limit`
  /// Short name of the parameter: `distance a` for `distance a to the axis of joint 2:`. Empty if
  /// `parameter` is already short.
  std::string dimension = {};
  bool known_unit = true;  ///< for a unit: whether the factor converts between two known units
  std::optional<double> a = {};  ///< value in A, rad or m
  std::optional<double> b = {};  ///< value in B, rad or m
  /// Pose to add to A: world_T_mount for a mount, tool_T_tcp for a tool.
  std::optional<Pose> pose = {};
  /// One clause, such as `d of joint 1 is 0.089159 in A and 0.089459 in B`.
  std::string what = {};
  /// Option of the command that removes the difference, such as `--mount 0,0,0.0003`; may be empty.
  std::string remedy = {};
};

enum class ModelComparison {
  same,        ///< the same pose of the tool for every q, within the tolerance
  reconciled,  ///< the same arm in another description: mount, tool, offsets, signs, convention,
               ///< unit
  different,   ///< dimensions or joints differ
};
std::string name(ModelComparison status);

struct ComparisonOptions {
  double tolerance = 1e-5;  ///< differences up to this size count as rounding, m and rad, above 0
  /// Number of random configurations at which the kinematics are compared, 1 or more.
  int configurations = 1000;
};

/// The differences between two descriptions of an arm.
struct ArmComparison {
  ModelComparison status = ModelComparison::different;
  /// Whether the differences explain B completely, as verified by forward kinematics.
  bool explained = false;
  std::string verdict;  ///< one sentence
  /// Differences that make A equal to B: the explanation with the fewest differences that was
  /// found.
  std::vector<ModelDifference> differences;
  /// Another explanation with the same number of differences, for example an offset of the first
  /// joint instead of a mount.
  std::vector<ModelDifference> alternative;
  /// Factor of each joint, including mimic joints: q of B = gain * q of A + offset. It is 0 for a
  /// joint that only one of the arms has.
  Configuration gain;
  Configuration offset;  ///< offset of each joint, rad or m: see `gain`
  /// Largest difference between the tool poses of the unchanged arms at one q; 0 if the numbers of
  /// joints differ.
  Deviation before;
  Deviation residual;  ///< largest difference of the tool poses with the differences applied to A
  int configurations = 0;  ///< number of configurations compared
  /// Differences that do not change the tool's pose: limits, order of names, mimic joints.
  std::vector<ModelDifference> others;

  /// Returns whether both arms move alike without changes and have equal limits.
  explicit operator bool() const { return status == ModelComparison::same && others.empty(); }
};

/// Finds the differences between two descriptions of one arm. The sequence of the joints' screw
/// axes in space determines an arm up to the base, the tool, and the signs and offsets of its
/// joints. It is compared, as are the Denavit-Hartenberg rows and the link frames of both. The
/// result is the explanation with the fewest differences: convention, units, exchanged or missing
/// joints, mount, tool, offsets, signs, dimensions of links. Each explanation is confirmed by
/// forward kinematics at random configurations. Limits are compared afterwards, with offsets and
/// signs taken into account. Throws Error for an option out of range.
ArmComparison compare_arms(const Arm& a, const Arm& b, const ComparisonOptions& options = {});

}  // namespace beeline
