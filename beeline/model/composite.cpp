#include <beeline/error.h>
#include <beeline/model/composite.h>

namespace beeline {
namespace {

Joint revolute(const std::string& name, const Vector3& axis, double pitch = 0) {
  Joint joint;
  joint.name = name;
  joint.screw = rotation_screw(axis, Vector3::Zero(), pitch);
  return joint;
}

Joint prismatic(const std::string& name, const Vector3& axis) {
  Joint joint;
  joint.name = name;
  joint.screw = translation_screw(axis);
  return joint;
}

}  // namespace

std::vector<Joint> composite_joint(char letter, const std::string& name, double pitch) {
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();
  switch (letter) {
    case 'R':
      return {revolute(name, z)};
    case 'P':
      return {prismatic(name, x)};
    case 'H':
      return {revolute(name, z, pitch)};
    case 'S':
      return {revolute(name + "_z", z), revolute(name + "_y", y), revolute(name + "_x", x)};
    case 'U':
      return {revolute(name + "_z", z), revolute(name + "_y", y)};
    case 'C':
      return {revolute(name + "_z", z), prismatic(name + "_slide_z", z)};
    case 'E':
      return {prismatic(name + "_slide_x", x), prismatic(name + "_slide_y", y),
              revolute(name + "_z", z)};
    default:
      throw unknown_name("joint type", std::string(1, letter), {"R", "P", "H", "S", "C", "E", "U"});
  }
}

}  // namespace beeline
