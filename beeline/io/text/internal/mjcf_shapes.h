#pragma once

#include <map>
#include <string>
#include <string_view>

#include <beeline/io/text/internal/urdf_collision.h>

namespace beeline::internal {

/// What the bodies of an MJCF file are.
enum class MjcfUse { links, obstacles };

/// Reads the geoms of an MJCF text that can collide (contype or conaffinity is not 0): spheres,
/// capsules, cylinders, boxes and meshes, and of obstacles planes, as half spaces without bounds.
/// Planes that joints do not move are no links: `planes` has their bodies. A
/// mesh becomes its hull, as in MuJoCo; it is a file in `meshdir`, relative to the folder of the
/// model, or vertices. A body with other geoms alone is in `only_visual`. `may_touch` has the pairs
/// of `<contact><exclude>` and those that several joints connect. Throws FileError for geoms of
/// another type, which it names with the line, for a mesh that cannot be read, and for a size that
/// check_shape() refuses.
UrdfShapes mjcf_shapes(std::string_view text, const std::string& path,
                       const std::map<std::string, std::string>& package, MjcfUse use);

}  // namespace beeline::internal
