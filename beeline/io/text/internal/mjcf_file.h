#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/collision/scene.h>
#include <beeline/io/text/internal/mjcf_attributes.h>
#include <beeline/io/text/internal/mjcf_pose.h>
#include <beeline/io/text/internal/urdf_file.h>

namespace beeline::internal {

/// A geom of an MJCF file, not yet read.
struct MjcfGeom {
  const tinyxml2::XMLElement* element = nullptr;
  std::size_t of_class = MjcfDefaults::main_class;
  Pose frame = Pose::Identity();  ///< pose in the link of the frame around the geom
  std::size_t link = 0;           ///< in `UrdfFile::links`
};

/// What an MJCF file describes: a tree of links, and the geoms of its links.
struct MjcfModel {
  MjcfModel(std::string_view text, const std::string& path)
      : document(text, path), defaults(document), settings(mjcf_settings(document)) {}

  MjcfDocument document;
  MjcfDefaults defaults;
  MjcfSettings settings;
  UrdfFile file;
  std::vector<MjcfGeom> geoms;
  /// The pairs of bodies that several joints connect: they touch as neighbouring links do.
  std::vector<NamedPair> touching;
};

/// Reads an MJCF text.
///   - The world is the link `world`, a body the link of its name; one without a name is `body7`,
///     by MuJoCo's index. A body's joints stand in a row: all but the last one move links of their
///     own. A body without joints is fixed. Sites with a name are links, fixed to their bodies.
///   - A hinge with limits is revolute, one without continuous, a slide prismatic, a free joint
///     floating. The axis passes through `pos` of the joint. Coordinates are MuJoCo's qpos: at
///     `ref` the body is at its pose in the file.
///   - An equality constraint of two joints makes the first one a mimic joint of the second; of one
///     joint, it fixes the joint. Other constraints, tendons, actuators and sensors are ignored.
/// Throws FileError, which names the line, for everything that MuJoCo refuses in what is read, and
/// for `<replicate>`, `<attach>`, `<composite>` and `<flexcomp>`. Faults of joints that do not
/// matter beside the chain are recorded as parse_urdf() does.
std::unique_ptr<const MjcfModel> read_mjcf(std::string_view text, const std::string& path);

/// Reads the equality constraints between joints into `model.file`. `refs` has the coordinate of
/// each joint of the file at which its body is at its pose.
void read_mjcf_couplings(MjcfModel& model, const std::vector<double>& refs);

}  // namespace beeline::internal
