#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <system_error>
#include <tinyxml2.h>

#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/package_folder.h>

namespace beeline::internal {
namespace {

using Path = std::filesystem::path;

/// The folders of a variable of the environment, separated by colons, as absolute paths.
std::vector<std::string> folders_of(const char* variable) {
  const char* const value = std::getenv(variable);
  std::vector<std::string> folders;
  std::string rest = value == nullptr ? "" : value;
  while (!rest.empty()) {
    const std::size_t colon = std::min(rest.find(':'), rest.size());
    std::error_code unknown;
    if (colon > 0) {
      folders.push_back(std::filesystem::absolute(rest.substr(0, colon), unknown).string());
    }
    rest.erase(0, colon + 1);
  }
  return folders;
}

/// The folder of a file and the folders above it, from below.
std::vector<Path> folders_above(const std::string& path) {
  std::error_code unknown;
  const Path absolute = std::filesystem::absolute(path, unknown).lexically_normal();
  std::vector<Path> folders;
  for (Path at = absolute.parent_path(); !at.empty(); at = at.parent_path()) {
    folders.push_back(at);
    if (at == at.parent_path()) break;
  }
  return folders;
}

bool is_folder(const Path& path) {
  std::error_code missing;
  return std::filesystem::is_directory(path, missing);
}

/// The name in a folder's package.xml; empty if it has none that can be read.
std::string declared_name(const Path& folder) {
  constexpr std::uintmax_t largest = std::uintmax_t{1} << 14;
  const Path path = folder / "package.xml";
  std::error_code missing;
  if (!std::filesystem::is_regular_file(path, missing)) return "";
  const std::uintmax_t size = std::filesystem::file_size(path, missing);
  if (missing || size > largest) return "";
  tinyxml2::XMLDocument document;
  try {
    const std::string text = read_file(path.string());
    if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) return "";
  } catch (const Error&) {
    return "";
  }
  const tinyxml2::XMLElement* const package = document.FirstChildElement("package");
  const tinyxml2::XMLElement* const name = package ? package->FirstChildElement("name") : nullptr;
  const std::string text = name && name->GetText() ? name->GetText() : "";
  constexpr const char* blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string::npos ? ""
                                    : text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

/// The folders in a folder, at most 200. A workspace has fewer packages; /tmp may have more.
std::vector<Path> folders_in(const Path& folder) {
  constexpr std::size_t most = 200;
  constexpr int most_entries = 10'000;
  std::vector<Path> found;
  std::error_code fault;
  std::filesystem::directory_iterator at(folder, fault);
  for (int i = 0; i < most_entries && found.size() < most && !fault &&
                  at != std::filesystem::directory_iterator();
       ++i) {
    if (is_folder(at->path())) found.push_back(at->path());
    at.increment(fault);
  }
  std::sort(found.begin(), found.end());
  return found;
}

Path folder_around(const std::vector<Path>& above) {
  const auto package = std::find_if(above.begin(), above.end(), [](const Path& folder) {
    return !declared_name(folder).empty();
  });
  return package == above.end() ? Path() : package->parent_path();
}

/// The folders with a package.xml of that name: those above a file, and those beside its package.
std::vector<Path> declared_folders(const std::string& name, const std::vector<Path>& above) {
  std::vector<Path> candidates = above;
  if (const Path around = folder_around(above); !around.empty()) {
    const std::vector<Path> beside = folders_in(around);
    candidates.insert(candidates.end(), beside.begin(), beside.end());
  }
  std::vector<Path> found;
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(found),
               [&](const Path& folder) { return declared_name(folder) == name; });
  return found;
}

}  // namespace

std::vector<Path> package_folders(const std::string& name, const std::string& path) {
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
  const std::vector<Path> above = folders_above(path);
  for (const Path& folder : above) add_around(folder);
  if (std::any_of(folders.begin(), folders.end(), is_folder)) return folders;
  std::vector<Path> declared = declared_folders(name, above);
  declared.insert(declared.end(), folders.begin(), folders.end());
  return declared;
}

PackageFolders::PackageFolders(const std::string& path,
                               const std::map<std::string, std::string>& given)
    : path_(path) {
  for (const auto& [name, folder] : given) folders_[name] = {folder};
}

const std::vector<Path>& PackageFolders::of(const std::string& name) {
  const auto found = folders_.find(name);
  if (found != folders_.end()) return found->second;
  return folders_.emplace(name, package_folders(name, path_)).first->second;
}

std::vector<std::string> names_of_folders(const std::string& path) {
  constexpr std::size_t most_above = 6, most = 100;
  std::vector<std::string> names;
  std::vector<Path> above = folders_above(path);
  above.resize(std::min(above.size(), most_above));
  for (const Path& folder : above) names.push_back(folder.filename().string());
  for (const std::string& packages : folders_of("ROS_PACKAGE_PATH")) {
    names.push_back(Path(packages).filename().string());
    for (const Path& folder : folders_in(packages)) {
      if (names.size() < most) names.push_back(folder.filename().string());
    }
  }
  return names;
}

Path folder_around_package(const std::string& path) { return folder_around(folders_above(path)); }

}  // namespace beeline::internal
