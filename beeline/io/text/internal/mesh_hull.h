#pragma once

#include <map>
#include <string>
#include <vector>

#include <beeline/collision/scene.h>

namespace beeline::internal {

/// Reads the meshes that a URDF file names, as their convex hulls. Each file is read once.
class MeshHulls {
 public:
  /// Both arguments must outlive this object. `package`: folders of packages, by name.
  MeshHulls(const std::string& urdf_path, const std::map<std::string, std::string>& package)
      : urdf_path_(urdf_path), package_(package) {}

  /// Returns the hull of the mesh that `filename` names (mesh_places()), its coordinates multiplied
  /// by `scale`: the vertices of reduced_hull(), with its growth as padding. Throws Error for a
  /// mesh that is not found or has another format, a scale of 0, and a coordinate that
  /// check_shape() refuses; FileError of the mesh's file for one that cannot be read.
  Shape read(const std::string& filename, const Vector3& scale);

 private:
  /// Returns the path of the mesh.
  std::string find(const std::string& filename) const;

  const std::string& urdf_path_;
  const std::map<std::string, std::string>& package_;
  std::map<std::pair<std::string, std::vector<double>>, Shape> hulls_;  ///< by path and scale
};

}  // namespace beeline::internal
