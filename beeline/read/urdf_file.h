#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/model/joint.h>

namespace beeline {

/// A URDF file as it stands: links and joints in the file's order, with their lines. Inertias,
/// meshes, transmissions and everything else that does not move are passed over.
struct UrdfFile {
  struct Link {
    std::string name;
    int line = 0;
  };
  struct Joint {
    std::string name, type, parent, child;
    Pose origin = Pose::Identity();   ///< the child's frame in the parent's, at rest
    Vector3 axis = Vector3::UnitX();  ///< in the child's frame, of any length
    Limits limits;                    ///< without those of a continuous joint's position
    std::optional<beeline::Mimic> mimic;
    int line = 0, axis_line = 0, limit_line = 0, mimic_line = 0;
  };

  std::string path;
  std::string name;  ///< the robot's; the file's where it has none
  std::vector<Link> links;
  std::vector<Joint> joints;
};

/// Whether the type has one degree of freedom: revolute, continuous or prismatic.
bool moves(const UrdfFile::Joint& joint);

/// Throws FileError for text that is no XML, no <robot>, or xacro; an attribute that is missing or
/// no number; a name that is missing or given twice. Whether the links form a tree is asked later.
UrdfFile parse_urdf(std::string_view text, const std::string& path);

}  // namespace beeline
