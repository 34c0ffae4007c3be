#pragma once

#include <string>
#include <vector>

#include <beeline/io/text/internal/package_folder.h>

namespace beeline::internal {

/// The paths at which a mesh may be, the first one that exists counts.
struct MeshPlaces {
  std::vector<std::string> paths = {};
  std::string package = {};  ///< of package://PACKAGE/...; otherwise empty
};

/// Returns where to look for a mesh that a URDF file names. `filename` is
///   - package://NAME/PATH, also model://NAME/PATH: in a folder of the package
///   - file://PATH
///   - a path, relative to the folder of the URDF file.
/// Throws Error for another scheme, and for a text without a path.
MeshPlaces mesh_places(const std::string& filename, const std::string& urdf_path,
                       PackageFolders& packages);

}  // namespace beeline::internal
