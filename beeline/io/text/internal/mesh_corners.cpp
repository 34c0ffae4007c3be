#include <algorithm>

#include <beeline/error.h>
#include <beeline/io/text/internal/mesh_corners.h>

namespace beeline::internal {

std::vector<Vector3> TriangleCorners::take() {
  if (corners_.empty()) throw FileError(path_, 0, "has no triangles");
  return std::move(corners_);
}

void TriangleCorners::drop_repeated() {
  std::sort(corners_.begin(), corners_.end(), [](const Vector3& a, const Vector3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  });
  corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
  if (corners_.size() > max_mesh_corners) {
    throw FileError(path_, 0,
                    "has more than " + std::to_string(max_mesh_corners) +
                        " different corners of triangles; reduce the mesh");
  }
  next_drop_ = std::min(2 * corners_.size() + first_drop, max_mesh_corners + first_drop);
}

}  // namespace beeline::internal
