#include <algorithm>

#include <beeline/collision/internal/reduced_hull.h>
#include <beeline/collision/scene.h>
#include <beeline/io/text/internal/mesh_file.h>

#include <tests/fuzz/target.h>

// A mesh that is read has corners, and its grown hull reaches as far as they do along the axes.
BEELINE_FUZZ_TARGET(mesh) {
  using namespace beeline;
  for (const char* path : {"fuzzed.stl", "fuzzed.obj"}) {
    fuzz::may_refuse([&] {
      const std::vector<Vector3> corners = internal::mesh_from_text(input, path);
      fuzz::require(!corners.empty(), "a mesh has corners");
      const bool is_shape = std::all_of(corners.begin(), corners.end(), [](const Vector3& corner) {
        return corner.cwiseAbs().maxCoeff() <= max_shape_size;
      });
      if (!is_shape) return;
      const internal::ReducedHull hull = internal::reduced_hull(corners);
      for (int axis = 0; axis < 3; ++axis) {
        const auto before = [axis](const Vector3& a, const Vector3& b) {
          return a[axis] < b[axis];
        };
        const auto furthest = [&](const std::vector<Vector3>& points) {
          return (*std::max_element(points.begin(), points.end(), before))[axis];
        };
        fuzz::require(furthest(corners) <= furthest(hull.vertices) + hull.growth,
                      "the same extent");
      }
    });
  }
}
