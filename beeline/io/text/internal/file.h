#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace beeline::internal {

/// Limit on files that are read as a whole. Descriptions of arms and lists of poses take kilobytes;
/// trajectories and tables of any length are read row by row.
constexpr std::size_t max_file_size = std::size_t{64} << 20;

/// Returns the content of a file. Throws FileError when the file cannot be read, is a folder, or is
/// larger than `max_file_size`.
std::string read_file(const std::string& path);

/// Writes a temporary file beside `path`, then renames it: a reader finds the old content or the
/// new one, never a part. Throws FileError when the folder is missing or not writable, and leaves
/// no temporary file then.
void write_file(const std::string& path, std::string_view content);

struct NewFile {
  std::string path;
  std::string content;
};

/// Writes all files or none: all are written beside their paths before the first is renamed.
void write_files(const std::vector<NewFile>& files);

/// Returns the part of the file's name after its last dot, in lower case: "urdf"; empty when there
/// is no dot.
std::string extension(std::string_view path);

}  // namespace beeline::internal
