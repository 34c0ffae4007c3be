#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include <beeline/error.h>
#include <beeline/io/text/internal/mesh_path.h>
#include <beeline/io/text/internal/name.h>

namespace beeline::internal {
namespace {

using Path = std::filesystem::path;

/// The folders of a variable of the environment, separated by colons.
std::vector<std::string> folders_of(const char* variable) {
  const char* const value = std::getenv(variable);
  std::vector<std::string> folders;
  std::string rest = value == nullptr ? "" : value;
  while (!rest.empty()) {
    const std::size_t colon = std::min(rest.find(':'), rest.size());
    if (colon > 0) folders.push_back(rest.substr(0, colon));
    rest.erase(0, colon + 1);
  }
  return folders;
}

/// The folder of the URDF file and the folders above it, from below.
std::vector<Path> folders_above(const std::string& urdf_path) {
  std::error_code unknown;
  const Path absolute = std::filesystem::absolute(urdf_path, unknown).lexically_normal();
  std::vector<Path> folders;
  for (Path at = absolute.parent_path(); !at.empty(); at = at.parent_path()) {
    folders.push_back(at);
    if (at == at.parent_path()) break;
  }
  return folders;
}

/// The folders that may be the package.
std::vector<Path> package_folders(const std::string& name, const std::string& urdf_path,
                                  const std::map<std::string, std::string>& package) {
  const auto given = package.find(name);
  if (given != package.end()) return {given->second};
  std::vector<Path> folders;
  const auto add_around = [&](const Path& folder) {
    const Path named = folder.has_filename() ? folder : folder.parent_path();
    if (named.filename() == name) folders.push_back(named);
    folders.push_back(folder / name);
  };
  for (const std::string& folder : folders_of("ROS_PACKAGE_PATH")) add_around(folder);
  for (const std::string& folder : folders_of("AMENT_PREFIX_PATH")) {
    folders.push_back(Path(folder) / "share" / name);
  }
  for (const Path& folder : folders_above(urdf_path)) add_around(folder);
  return folders;
}

/// Removes the scheme from the front of a text, if it has it.
bool take_scheme(std::string& text, const std::string& scheme) {
  if (!text.starts_with(scheme)) return false;
  text.erase(0, scheme.size());
  return true;
}

}  // namespace

MeshPlaces mesh_places(const std::string& filename, const std::string& urdf_path,
                       const std::map<std::string, std::string>& package) {
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
    for (const Path& folder : package_folders(places.package, urdf_path, package)) {
      add(folder / inside);
    }
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
