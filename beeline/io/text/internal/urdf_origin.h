#pragma once

#include <initializer_list>

#include <beeline/io/text/internal/xml_elements.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {

/// The `<origin>` of an element of a URDF file.
struct UrdfOrigin {
  Pose pose = Pose::Identity();
  Vector3 rpy = Vector3::Zero();  ///< as written: rad
};

/// Reads the child `<origin>` of an element; without one the pose is the identity. Throws XmlError.
UrdfOrigin read_origin(const XmlElements& elements, const tinyxml2::XMLElement& element);

/// Refuses an element whose values stand elsewhere than in the attributes that are read, as in
/// `<axis>0 0 1</axis>` or `<axis x="0" y="0" z="1"/>`. An empty one has the defaults.
void check_attributes(const XmlElements& elements, const tinyxml2::XMLElement& element,
                      std::initializer_list<const char*> known);

}  // namespace beeline::internal
