#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace beeline::internal {

/// Returns the folders that may be the ROS package `name` for the file `path`, in this order:
///   - each folder of ROS_PACKAGE_PATH that is called `name` or contains `name`
///   - share/`name` of each folder of AMENT_PREFIX_PATH
///   - the folders above the file, from below, that are called `name` or contain `name`
///   - if none of these exists, the folders with a package.xml of that name: those above the file,
///     and those in folder_around_package(), at most 1,000.
std::vector<std::filesystem::path> package_folders(const std::string& name,
                                                   const std::string& path);

/// Returns the names of the lowest six folders above a file, and of the folders that the folders of
/// ROS_PACKAGE_PATH contain, at most 100.
std::vector<std::string> names_of_folders(const std::string& path);

/// Returns the folder that contains the package of a file: the folder beside package.xml's. Empty
/// if no folder above the file has a package.xml.
std::filesystem::path folder_around_package(const std::string& path);

}  // namespace beeline::internal
