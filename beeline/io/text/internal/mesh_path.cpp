#include <algorithm>
#include <filesystem>

#include <beeline/error.h>
#include <beeline/io/text/internal/mesh_path.h>
#include <beeline/io/text/internal/name.h>

namespace beeline::internal {
namespace {

using Path = std::filesystem::path;

/// Removes the scheme from the front of a text, if it has it.
bool take_scheme(std::string& text, const std::string& scheme) {
  if (!text.starts_with(scheme)) return false;
  text.erase(0, scheme.size());
  return true;
}

}  // namespace

MeshPlaces mesh_places(const std::string& filename, const std::string& urdf_path,
                       PackageFolders& packages) {
  std::string rest = filename;
  MeshPlaces places;
  const auto add = [&places](const Path& at) {
    const std::string text = at.lexically_normal().string();
    if (std::find(places.paths.begin(), places.paths.end(), text) == places.paths.end()) {
      places.paths.push_back(text);
    }
  };
  if (take_scheme(rest, "package://") || take_scheme(rest, "model://")) {
    const std::size_t slash = rest.find('/');
    places.package = rest.substr(0, slash);
    if (slash == std::string::npos || slash == 0 || slash + 1 == rest.size()) {
      throw Error(in_quotes(filename) + " must be package://NAME/PATH");
    }
    const std::string inside = rest.substr(slash + 1);
    for (const Path& folder : packages.of(places.package)) add(folder / inside);
    return places;
  }
  take_scheme(rest, "file://");
  if (rest.empty() || rest.find("://") != std::string::npos) {
    throw Error(in_quotes(filename) +
                " is not a file; known are package://NAME/PATH, file://PATH and paths relative to "
                "the URDF file");
  }
  add(Path(urdf_path).parent_path() / rest);
  return places;
}

}  // namespace beeline::internal
