#pragma once

#include <map>
#include <string>
#include <vector>

namespace beeline::internal {

/// The paths at which a mesh may be, the first one that exists counts.
struct MeshPlaces {
  std::vector<std::string> paths = {};
  std::string package = {};  ///< of package://PACKAGE/...; otherwise empty
};

/// Returns where to look for a mesh that a URDF file names. `filename` is
///   - package://NAME/PATH, also model://NAME/PATH: in the folder `package` gives for NAME or, if
///     it has none, in package_folders()
///   - file://PATH
///   - a path, relative to the folder of the URDF file.
/// Throws Error for another scheme, and for a text without a path.
MeshPlaces mesh_places(const std::string& filename, const std::string& urdf_path,
                       const std::map<std::string, std::string>& package);

}  // namespace beeline::internal
