#include <algorithm>
#include <filesystem>
#include <system_error>

#include <beeline/collision/internal/reduced_hull.h>
#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/mesh_file.h>
#include <beeline/io/text/internal/mesh_hull.h>
#include <beeline/io/text/internal/mesh_path.h>
#include <beeline/io/text/internal/name.h>

namespace beeline::internal {
namespace {

/// A path for a message. Of a very long one the end remains, which tells the format.
std::string shown_path(const std::string& path) {
  constexpr std::size_t longest = 300, end = 80;
  if (path.size() <= longest) return with_escaped_bytes(path);
  return "..." + with_escaped_bytes(std::string_view(path).substr(path.size() - end));
}

std::string quoted(const std::string& filename) { return "\"" + shown_path(filename) + "\""; }

}  // namespace

Shape hull_of_corners(std::vector<Vector3> corners, const std::string& path) {
  for (const Vector3& corner : corners) {
    if (corner.cwiseAbs().maxCoeff() <= max_shape_size) continue;
    throw Error("has a corner, multiplied by scale, beyond " + number(max_shape_size) + " m");
  }
  ReducedHull hull = reduced_hull(std::move(corners));
  return {.body = ConvexHull{std::move(hull.vertices)},
          .padding = hull.growth,
          .hull_of = with_escaped_bytes(path)};
}

std::string MeshHulls::find(const std::string& filename) {
  const std::string ending = extension(filename);
  const std::vector<std::string>& known = mesh_endings();
  if (std::find(known.begin(), known.end(), ending) == known.end()) {
    throw Error(
        "the mesh " + quoted(filename) + " is not of a format that is read; known endings: " +
        listed(known) + (is_scene_mesh(filename) ? scene_mesh_advice() : "") +
        "; convert it, or give its hull as \"convex_hull\" in the \"shapes\" of an arm file "
        "or a scene");
  }
  const MeshPlaces places = mesh_places(filename, path_, packages_);
  for (const std::string& path : places.paths) {
    std::error_code missing;
    if (std::filesystem::is_regular_file(path, missing)) return path;
  }
  std::vector<std::string> at;
  for (const std::string& path : places.paths) at.push_back(shown_path(path));
  std::string message =
      "the mesh " + quoted(filename) + " is not found; looked for at " + listed(at);
  if (!places.package.empty()) {
    const std::string name = printable(places.package);
    message += "; package={\"" + name + "\": FOLDER} (--package " + name +
               "=FOLDER) gives the folder of the package";
  }
  throw Error(message);
}

Shape MeshHulls::read(const std::string& filename, const Vector3& scale) {
  for (const double factor : scale) {
    if (factor == 0) throw Error("the mesh " + quoted(filename) + " has a scale of 0");
  }
  const std::string path = find(filename);
  const std::vector<double> factors(scale.begin(), scale.end());
  const auto known = hulls_.find({path, factors});
  if (known != hulls_.end()) return known->second;
  double rounding = 0;
  std::vector<Vector3> corners = read_mesh(path, &rounding);
  for (Vector3& corner : corners) corner = corner.cwiseProduct(scale);
  try {
    Shape hull = hull_of_corners(std::move(corners), path);
    hull.padding += rounding * scale.cwiseAbs().maxCoeff();
    return hulls_.emplace(std::pair(path, factors), std::move(hull)).first->second;
  } catch (const Error& error) {
    throw FileError(path, 0, error.what());
  }
}

}  // namespace beeline::internal
