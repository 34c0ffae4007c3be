#pragma once

#include <map>
#include <string>
#include <vector>

#include <beeline/collision/scene.h>
#include <beeline/io/text/internal/package_folder.h>

namespace beeline::internal {

/// Returns the hull of the corners of a mesh, m: the vertices of reduced_hull(), with its growth as
/// padding. `path` is the file, for Shape::hull_of. Throws Error for a coordinate beyond
/// max_shape_size.
Shape hull_of_corners(std::vector<Vector3> corners, const std::string& path);

/// Reads the meshes that a file names, as their convex hulls. Each file is read once.
class MeshHulls {
 public:
  /// `path` must outlive this object. `package`: folders of packages, by name.
  MeshHulls(const std::string& path, const std::map<std::string, std::string>& package)
      : path_(path), packages_(path, package) {}

  /// Returns hull_of_corners() of the mesh that `filename` names (mesh_places()), its coordinates
  /// multiplied by `scale`, with the bound of their rounding added to its padding. Throws Error for
  /// a mesh that is not found or has another format, and a scale of 0; FileError of the mesh's file
  /// for one that cannot be read.
  Shape read(const std::string& filename, const Vector3& scale);

 private:
  /// Returns the path of the mesh.
  std::string find(const std::string& filename);

  const std::string& path_;
  PackageFolders packages_;
  std::map<std::pair<std::string, std::vector<double>>, Shape> hulls_;  ///< by path and scale
};

}  // namespace beeline::internal
