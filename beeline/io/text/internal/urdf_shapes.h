#pragma once

#include <string>
#include <string_view>

#include <beeline/io/text/scene.h>

namespace beeline::internal {

/// Returns the shapes of all links of a URDF text, see read_arm_shapes(). `states` are the states
/// of `options.srdf`. Throws FileError.
ArmShapes shapes_from_urdf(std::string_view text, const std::string& path, const ChainEnds& ends,
                           const ShapeOptions& options, const std::vector<Srdf::State>& states);

}  // namespace beeline::internal
