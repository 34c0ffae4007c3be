#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/io/text/arm.h>
#include <beeline/model/joint.h>

namespace beeline::internal {

/// A fault of a URDF file. On the chain it is an error, beside the chain a warning.
struct UrdfFault {
  ReadWarning warning;                    ///< without its path; warnings_of() completes it
  std::optional<std::size_t> index = {};  ///< of the joint in `UrdfFile::joints`
  bool moves = false;                     ///< the chain that the file's author meant may need it
};

/// The links and joints of a URDF file, in the file's order, with their lines. Inertias, meshes,
/// transmissions and everything else that does not affect kinematics are ignored. An MJCF file is
/// read into the same, see mjcf_file.h.
struct UrdfFile {
  struct Link {
    std::string name;
    int line = 0;
    bool site = false;  ///< a site of MJCF: a frame that is no end of the tree unless it is named
  };
  struct Joint {
    std::string name, type, parent, child;
    Pose origin = Pose::Identity();   ///< parent_T_child at q = 0
    Vector3 rpy = Vector3::Zero();    ///< of the origin, as written: rad
    Vector3 axis = Vector3::UnitX();  ///< in the child's frame, of any length
    Vector3 point = Vector3::Zero();  ///< of the axis, in the child's frame; URDF has its origin
    Limits limits;                    ///< a continuous joint has no position limits
    std::optional<beeline::Mimic> mimic;
    int line = 0, axis_line = 0, limit_line = 0, mimic_line = 0;
    std::string included_from = {};  ///< file that has the joint; empty: the file itself
  };

  std::string path;
  std::string name;  ///< of the robot; the file's name when the robot has none
  bool is_mjcf = false;
  std::vector<Link> links;
  std::vector<Joint> joints;      ///< those with a name, a type, a parent and a child
  std::vector<UrdfFault> faults;  ///< of elements in the file's order, then of joints
  /// The number of further ones that no chain can have: beyond 10,000, elements without a name.
  std::size_t further_faults = 0;
};

/// Whether the joint has one degree of freedom: revolute, continuous or prismatic.
bool has_one_dof(const UrdfFile::Joint& joint);

/// Returns the unit screw of a joint with one degree of freedom, in the child's frame.
Twist screw_of(const UrdfFile::Joint& joint);

/// Returns the path of the file that has the joint.
const std::string& path_of(const UrdfFile& file, const UrdfFile::Joint& joint);

/// The types of joints that URDF defines.
const std::vector<std::string>& urdf_joint_types();

/// Whether the joint is floating or planar, with several degrees of freedom.
bool is_free(const UrdfFile::Joint& joint);

/// Parses a URDF text. Records its faults: elements that xacro should have replaced, an attribute
/// that is missing or not a number, a name that is missing, not UTF-8 or given twice, what is not
/// read, see ignored_parts(), and the faults of find_joint_faults(). Does not check that the links
/// form a tree. Names have with_escaped_bytes(). Throws FileError for text that is not XML or has
/// no <robot>.
UrdfFile parse_urdf(std::string_view text, const std::string& path);

}  // namespace beeline::internal
