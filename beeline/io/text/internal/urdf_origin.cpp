#include <algorithm>
#include <tinyxml2.h>

#include <beeline/error.h>
#include <beeline/io/text/internal/urdf_origin.h>

namespace beeline::internal {
namespace {

using tinyxml2::XMLElement;

/// The orientation of an origin: rpy, or the quaternion of URDF 1.2. Both are refused.
Rotation read_orientation(const XmlElements& elements, const XMLElement& origin, Vector3& rpy) {
  constexpr const char* quaternion = "quat_xyzw";
  rpy = elements.vector(origin, "rpy", Vector3::Zero());
  const char* text = origin.Attribute(quaternion);
  if (text == nullptr) return rotation(RollPitchYaw{rpy.x(), rpy.y(), rpy.z()});
  if (origin.Attribute("rpy") != nullptr) {
    elements.refuse(origin, quaternion, ElementFault::two_orientations);
  }
  const std::vector<double> q = elements.numbers(origin, quaternion);
  if (q.size() != 4) {
    throw XmlError({.path = elements.path(),
                    .line = origin.GetLineNum(),
                    .element = described(origin),
                    .element_fault = ElementFault::not_four_numbers,
                    .attribute = quaternion,
                    .count = q.size()});
  }
  try {
    return rotation_from_quaternion(q[3], q[0], q[1], q[2]);
  } catch (const Error&) {
    elements.refuse(origin, quaternion, ElementFault::not_unit_length, text);
  }
}

}  // namespace

void check_attributes(const XmlElements& elements, const XMLElement& element,
                      std::initializer_list<const char*> known) {
  const bool written = std::any_of(known.begin(), known.end(), [&](const char* attribute) {
    return element.Attribute(attribute) != nullptr;
  });
  const bool empty = element.FirstAttribute() == nullptr &&
                     element.FirstChildElement() == nullptr && element.GetText() == nullptr;
  if (!written && !empty) {
    elements.refuse(element, *known.begin(), ElementFault::missing_attribute);
  }
}

UrdfOrigin read_origin(const XmlElements& elements, const XMLElement& element) {
  UrdfOrigin read;
  const XMLElement* origin = element.FirstChildElement("origin");
  if (origin == nullptr) return read;
  check_attributes(elements, *origin, {"xyz", "rpy", "quat_xyzw"});
  const Vector3 position = elements.vector(*origin, "xyz", Vector3::Zero());
  read.pose = make_pose(position, read_orientation(elements, *origin, read.rpy));
  return read;
}

}  // namespace beeline::internal
