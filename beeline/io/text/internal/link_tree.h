#pragma once

#include <map>
#include <string>
#include <string_view>

#include <beeline/io/text/internal/mjcf_shapes.h>
#include <beeline/io/text/internal/urdf_collision.h>
#include <beeline/io/text/internal/urdf_file.h>

namespace beeline::internal {

/// Whether the first element of an XML text is `<mujoco>`: MJCF, not URDF.
bool is_mjcf(std::string_view text);

/// Returns the links and joints of a text: read_mjcf() or parse_urdf(), by its root element.
UrdfFile parse_link_tree(std::string_view text, const std::string& path);

/// Returns the shapes of the same text: mjcf_shapes() or collision_shapes().
UrdfShapes link_tree_shapes(std::string_view text, const std::string& path,
                            const std::map<std::string, std::string>& package, MjcfUse use);

}  // namespace beeline::internal
