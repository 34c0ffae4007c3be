#pragma once

#include <numbers>
#include <optional>
#include <span>

#include <beeline/model/joint.h>

namespace beeline::internal {

/// A position and roll, pitch, yaw, as a file has them.
struct CatalogPose {
  double xyz[3] = {};  ///< m
  double rpy[3] = {};  ///< roll, pitch, yaw, rad
};

/// A joint of a file: a row of DH parameters, or a joint that is placed by its offset and its axis.
struct CatalogJoint {
  const char* name = "";
  Limits limits;
  DhRow row = {};
  // The following members describe a joint without a row of DH parameters.
  JointKind kind = JointKind::revolute;  ///< revolute or prismatic
  CatalogPose offset = {};
  double axis[3] = {}, point[3] = {};  ///< the axis and a point on it, in the joint's link frame
};

/// The members of ControllerFrames.
struct CatalogFrames {
  CatalogPose base, flange;
};

/// A file of beeline/model/arms/, compiled in: the members of BuiltInArm, and the arm's numbers.
struct CatalogEntry {
  const char *name, *maker, *model, *source, *note, *shapes_source;
  const char* joint_names;  ///< a line for each description, a tab behind each name
  std::optional<DhConvention> convention = {};  ///< of the rows, if the joints have rows
  std::span<const CatalogJoint> joints;
  CatalogPose tool, base;
  std::optional<CatalogFrames> controller = {};
};

/// The files of beeline/model/arms/ in the order of their names. cmake/catalog.cmake writes the
/// source of this function.
std::span<const CatalogEntry> catalog_entries();

constexpr double degree = std::numbers::pi / 180;  ///< rad, for the numbers in that source

}  // namespace beeline::internal
