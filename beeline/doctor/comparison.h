#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/kinematics/task.h>
#include <beeline/model/arm.h>

namespace beeline {

/// What one difference between two descriptions of an arm is.
enum class DifferenceKind {
  convention,    ///< the same table, of standard and of modified Denavit-Hartenberg parameters
  unit,          ///< all lengths or all angles in another unit
  columns,       ///< columns of a table are exchanged or shifted
  joint_order,   ///< two joints are exchanged
  joint_count,   ///< a joint is missing
  joint_kind,    ///< revolute against prismatic or helical
  mount,         ///< the pose of the base in the world
  tool,          ///< the pose of the tool in the last link
  joint_offset,  ///< the value of a joint's coordinate at one configuration
  joint_sign,    ///< the direction that counts as positive
  length,        ///< a dimension of a link, metres
  angle,         ///< a dimension of a link, rad
  axis,          ///< the axis of a joint in the frame of its link
  orientation,   ///< of a link's frame
  mimic,         ///< the coupling of a joint to another
  name,          ///< the order of the joints' names
  limit,         ///< a joint limit
};
std::string name(DifferenceKind kind);

/// One difference, and what to change in arm A so that it describes arm B.
struct ModelDifference {
  DifferenceKind kind = DifferenceKind::length;
  int joint = -1;              ///< from 0, in A; -1: of the whole arm
  std::string parameter = {};  ///< such as d, alpha, `upper limit`
  /// The parameter's name alone: `distance a` of `distance a to the axis of joint 2:`; empty: the
  /// parameter is nothing else.
  std::string dimension = {};
  bool known_unit = true;        ///< unit: B is A in another unit, not by another factor
  std::optional<double> a = {};  ///< the value in A, rad or m
  std::optional<double> b = {};  ///< the value in B, rad or m
  /// Of a mount world_T_mount, of a tool tool_T_tcp, to be added to A.
  std::optional<Pose> pose = {};
  /// One clause, such as `d of joint 1 is 0.089159 in A and 0.089459 in B`.
  std::string what = {};
  /// What to write, as an option of the command: `--mount 0,0,0.0003`; may be empty.
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
  double tolerance = 1e-5;  ///< smaller differences are rounding, m and rad, above 0
  /// Number of random configurations at which the kinematics are compared, 1 or more.
  int configurations = 1000;
};

/// What two descriptions of an arm have different.
struct ArmComparison {
  ModelComparison status = ModelComparison::different;
  /// Whether the differences explain B completely, verified by forward kinematics.
  bool explained = false;
  std::string verdict;  ///< one sentence
  /// What makes A equal to B: the explanation with the fewest differences that was found.
  std::vector<ModelDifference> differences;
  /// Another explanation with as few: an offset of the first joint in place of a mount, for
  /// example.
  std::vector<ModelDifference> alternative;
  /// Factor of each joint, mimic joints included: q of B = gain * q of A + offset; 0 for a joint
  /// that one of the arms does not have.
  Configuration gain;
  Configuration offset;  ///< one for each joint, rad or m: see `gain`
  /// Largest difference of the tool's pose at one q, as the two are; 0 where the numbers of joints
  /// differ.
  Deviation before;
  Deviation residual;      ///< the same, with the differences applied to A
  int configurations = 0;  ///< number of configurations compared
  /// Differences that do not change the tool's pose: limits, order of names, mimic joints.
  std::vector<ModelDifference> others;

  /// Whether the two move alike as they are, and have equal limits.
  explicit operator bool() const { return status == ModelComparison::same && others.empty(); }
};

/// Finds what two descriptions of one arm have different. The sequence of the joints' screw axes in
/// space determines an arm up to base, tool, signs and offsets of its joints; it is compared beside
/// the Denavit-Hartenberg rows and the link frames of both, and the explanation with the fewest
/// differences is taken: convention, units, exchanged or missing joints, mount, tool, offsets,
/// signs, dimensions of links. Nothing is claimed that forward kinematics at random configurations
/// does not confirm. Limits are compared afterwards, with offsets and signs taken into account.
/// Throws Error for an option out of range.
ArmComparison compare_arms(const Arm& a, const Arm& b, const ComparisonOptions& options = {});

}  // namespace beeline
