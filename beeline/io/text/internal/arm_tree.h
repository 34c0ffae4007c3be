#pragma once

#include <string>
#include <vector>

#include <beeline/io/text/arm.h>

namespace beeline::internal {

/// A link of an arm that is written as a tree of links, and the joint above it.
struct WrittenLink {
  std::string name, parent;
  Pose pose = Pose::Identity();  ///< of the link in its parent at joint value 0
  const Joint* joint = nullptr;  ///< null: the link is fixed
  Vector3 axis = Vector3::Zero(), point = Vector3::Zero();  ///< of the joint, in the link
};

/// An arm as URDF and MJCF describe it.
struct WrittenTree {
  std::string root;                ///< the link that is the world or the base
  std::vector<WrittenLink> links;  ///< the others, each behind its parent
  std::vector<ArmGap> gaps = {};
};

/// Returns the tree of an arm, which must outlive it: the links of its joints, with names; `base`
/// and `tool0` where the arm states frames of the controller or readers would assume others; and
/// the tool. For URDF the frame of each link lies on its joint's axis.
WrittenTree written_tree(const Arm& arm, ArmFileFormat format);

/// Returns a coordinate or a component of a direction, which reads back exactly; 0 if it is
/// rounding of 0.
std::string coordinate_text(double value);
/// Returns three of them with blanks between.
std::string coordinates_text(const Vector3& values);

/// Returns `wanted`, or the first of `wanted_`, `wanted__` and so on that is not in `taken`, and
/// adds it there.
std::string new_name(std::string wanted, std::vector<std::string>& taken);

/// The texts of both formats, for an arm without gaps.
std::string urdf_text(const Arm& arm, const WrittenTree& tree);
std::string mjcf_text(const Arm& arm, const WrittenTree& tree);

}  // namespace beeline::internal
