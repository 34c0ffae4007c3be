#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <beeline/pose/so3.h>

namespace beeline::internal {

/// The bound of different corners of triangles in a file, or of vertices.
constexpr std::size_t max_mesh_corners = 5'000'000;

/// The corners of triangles. Repeated ones are dropped now and then: each is in six triangles.
class TriangleCorners {
 public:
  /// `path` names the file in messages.
  explicit TriangleCorners(std::string path) : path_(std::move(path)) {}

  /// Throws FileError for more than max_mesh_corners different corners.
  void add(const Vector3& corner) {
    if (corners_.size() >= next_drop_) drop_repeated();
    corners_.push_back(corner);
  }

  /// Returns the corners, possibly repeated. Throws FileError if there are none.
  std::vector<Vector3> take();

 private:
  void drop_repeated();

  static constexpr std::size_t first_drop = std::size_t{1} << 20;
  std::string path_;
  std::vector<Vector3> corners_;
  std::size_t next_drop_ = first_drop;
};

}  // namespace beeline::internal
