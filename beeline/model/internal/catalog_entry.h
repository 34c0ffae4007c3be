#pragma once

#include <numbers>
#include <optional>
#include <span>

#include <beeline/model/joint.h>

namespace beeline::internal {

/// A pose in the numbers of a file.
struct CatalogPose {
  double xyz[3] = {};  ///< m
  double rpy[3] = {};  ///< roll, pitch, yaw, rad
};

/// A joint of a file: a row of DH parameters, or a joint that is placed by its offset and its axis.
struct CatalogJoint {
  const char* name = "";
  Limits limits;
  DhRow row = {};
  // Without rows; the axis and a point on it are in the joint's link frame.
  JointKind kind = JointKind::revolute;  ///< revolute or prismatic
  CatalogPose offset = {};
  double axis[3] = {}, point[3] = {};
};

/// A file of beeline/model/arms/, compiled in: the members of BuiltInArm, and the arm's numbers.
struct CatalogEntry {
  const char *name, *maker, *model, *source, *note, *shapes_source;
  const char* joint_names;  ///< a line for each description, with spaces between the names
  std::optional<DhConvention> convention = {};  ///< of the rows, if the joints have rows
  std::span<const CatalogJoint> joints;
  CatalogPose tool, base;
  std::optional<CatalogPose> controller_base = {}, flange = {};
};

/// The files of beeline/model/arms/ in the order of their names. cmake/catalog.cmake writes the
/// source of this function.
std::span<const CatalogEntry> catalog_entries();

constexpr double degree = std::numbers::pi / 180;  // in that source

}  // namespace beeline::internal
