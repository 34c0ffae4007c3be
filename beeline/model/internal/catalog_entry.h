#pragma once

#include <numbers>
#include <span>
#include <string>

#include <beeline/model/arm.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {

/// An arm of beeline/model/arms/, compiled in.
struct CatalogEntry {
  BuiltInArm about;
  Arm (*build)();
};

/// The files of beeline/model/arms/ in the order of their names. cmake/catalog.cmake writes the
/// source of this function; it calls the following ones, with the numbers of the files.
std::span<const CatalogEntry> catalog_entries();

constexpr double degree = std::numbers::pi / 180;

inline Joint dh_joint(const char* name, DhConvention convention, const DhRow& row,
                      const Limits& limits) {
  Joint joint = beeline::dh_joint(row, convention);
  joint.name = name;
  joint.limits = limits;
  return joint;
}

inline Joint joint(const char* name, const Pose& offset, const Twist& screw, const Limits& limits) {
  Joint joint;
  joint.name = name;
  joint.offset = offset;
  joint.screw = screw;
  joint.limits = limits;
  return joint;
}

}  // namespace beeline::internal
