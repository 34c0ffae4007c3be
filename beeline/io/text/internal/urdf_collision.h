#pragma once

#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <beeline/collision/scene.h>
#include <beeline/io/text/urdf.h>

namespace beeline::internal {

/// The shapes of the links of a URDF or MJCF text.
struct UrdfShapes {
  /// Shapes of the `<collision>` elements, by the link's name, in the link's frame.
  std::unordered_map<std::string, std::vector<Shape>> of_link;
  std::vector<std::string> only_visual;   ///< links with `<visual>` and without `<collision>`
  std::vector<NamedPair> may_touch = {};  ///< pairs that an MJCF file excludes from contact
  std::vector<std::string> planes = {};   ///< links of an MJCF file with planes that are left out
};

/// Reads them. A mesh becomes its hull, see MeshHulls; `package` gives folders of packages. Throws
/// FileError for a `<collision>` without exactly one body or with several origins, a geometry of
/// another kind than box, cylinder, sphere, capsule and mesh, a mesh that cannot be read, and a
/// size that check_shape() refuses.
UrdfShapes collision_shapes(std::string_view text, const std::string& path,
                            const std::map<std::string, std::string>& package);

}  // namespace beeline::internal
