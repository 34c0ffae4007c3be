#include <beeline/error.h>
#include <beeline/model/joint.h>
#include <beeline/pose/se3.h>

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

const Vector3 x_axis = Vector3::UnitX(), y_axis = Vector3::UnitY(), z_axis = Vector3::UnitZ();

struct Row {
  JointType type;
  std::vector<Joint> (*expand)(const std::string& name, double pitch);
};

JointType one_dof(JointKind kind) { return {letter(kind), name(kind), false}; }

const std::vector<Row>& table() {
  static const std::vector<Row> rows{
      {one_dof(JointKind::revolute),
       [](const std::string& name, double) { return std::vector{revolute(name, z_axis)}; }},
      {one_dof(JointKind::prismatic),
       [](const std::string& name, double) { return std::vector{prismatic(name, x_axis)}; }},
      {one_dof(JointKind::helical),
       [](const std::string& name, double pitch) {
         return std::vector{revolute(name, z_axis, pitch)};
       }},
      {{'S', "spherical", true},
       [](const std::string& name, double) {
         return std::vector{revolute(name + "_z", z_axis), revolute(name + "_y", y_axis),
                            revolute(name + "_x", x_axis)};
       }},
      {{'C', "cylindrical", true},
       [](const std::string& name, double) {
         return std::vector{revolute(name + "_z", z_axis), prismatic(name + "_slide_z", z_axis)};
       }},
      {{'E', "planar", true},
       [](const std::string& name, double) {
         return std::vector{prismatic(name + "_slide_x", x_axis),
                            prismatic(name + "_slide_y", y_axis), revolute(name + "_z", z_axis)};
       }},
      {{'U', "universal", true},
       [](const std::string& name, double) {
         return std::vector{revolute(name + "_z", z_axis), revolute(name + "_y", y_axis)};
       }},
  };
  return rows;
}

}  // namespace

const std::vector<JointType>& joint_types() {
  static const std::vector<JointType> types = [] {
    std::vector<JointType> all;
    for (const Row& row : table()) all.push_back(row.type);
    return all;
  }();
  return types;
}

std::vector<Joint> composite_joint(char letter, const std::string& name, double pitch) {
  for (const Row& row : table()) {
    if (row.type.letter == letter) return row.expand(name, pitch);
  }
  std::vector<std::string> letters;
  for (const JointType& type : joint_types()) letters.emplace_back(1, type.letter);
  throw unknown_name("joint type", std::string(1, letter), letters);
}

Joint planar_link(Joint joint, double length, double angle) {
  joint.offset = Eigen::AngleAxisd(angle, Vector3::UnitZ()) * joint.offset;
  return with_link_frame(std::move(joint), make_pose({length, 0, 0}));
}

}  // namespace beeline
