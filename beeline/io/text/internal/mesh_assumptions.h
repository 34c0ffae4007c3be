#pragma once

#include <string>
#include <string_view>

namespace beeline::internal {

/// Refuses a Collada or glTF file whose positions depend on what assimp 5.2 ignores: extensions of
/// glTF that it does not know, quantized, compressed and sparse positions, instances, morph targets
/// and skins. `path` ends in .dae, .gltf or .glb. Throws FileError that names the first such thing.
void check_mesh_assumptions(std::string_view bytes, const std::string& path);

}  // namespace beeline::internal
