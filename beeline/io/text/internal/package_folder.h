#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace beeline::internal {

/// Returns the folders that may be the ROS package `name` for the file `path`, in this order:
///   - each folder of ROS_PACKAGE_PATH that is called `name` or contains `name`
///   - share/`name` of each folder of AMENT_PREFIX_PATH
///   - the folders above the file, from below, that are called `name` or contain `name`
///   - if none of these exists, the folders with a package.xml of that name: those above the file,
///     and at most 200 in folder_around_package().
std::vector<std::filesystem::path> package_folders(const std::string& name,
                                                   const std::string& path);

/// The folders of the packages that one file names. Each package is looked for once.
class PackageFolders {
 public:
  /// `path`: the file; `given`: folders of packages, by name, which are not looked for.
  PackageFolders(const std::string& path, const std::map<std::string, std::string>& given);

  const std::vector<std::filesystem::path>& of(const std::string& name);

 private:
  std::string path_;
  std::map<std::string, std::vector<std::filesystem::path>> folders_;  ///< by name
};

/// Returns the names of the lowest six folders above a file, of the folders of ROS_PACKAGE_PATH,
/// and of up to 100 folders in them.
std::vector<std::string> names_of_folders(const std::string& path);

/// Returns the parent of the lowest folder above a file that has a package.xml; empty if none has.
std::filesystem::path folder_around_package(const std::string& path);

}  // namespace beeline::internal
