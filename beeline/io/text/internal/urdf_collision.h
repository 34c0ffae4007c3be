#pragma once

#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <beeline/collision/scene.h>
#include <beeline/io/text/urdf.h>

namespace beeline::internal {

/// Reads the `<collision>` elements of the links of a URDF text: the shapes of each link, by its
/// name, in the link's frame. A mesh becomes its hull, see MeshHulls; `package` gives folders of
/// packages. Throws FileError for a geometry of another kind than box, cylinder, sphere, capsule
/// and mesh, for a mesh that cannot be read, and for a size that check_shape() refuses.
std::unordered_map<std::string, std::vector<Shape>> collision_shapes(
    std::string_view text, const std::string& path,
    const std::map<std::string, std::string>& package);

}  // namespace beeline::internal
