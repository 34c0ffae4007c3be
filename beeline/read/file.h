#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace beeline {

/// No description of an arm or a motion that a person would write is larger.
constexpr std::size_t largest_file = std::size_t{64} << 20;

/// The whole file. Throws FileError when it cannot be read, is a folder, or exceeds `largest_file`.
std::string read_file(const std::string& path);

/// Writes beside `path`, then renames: readers see the old file or the new one, never a half.
/// Throws FileError when the folder is missing or not writable; then nothing is left behind.
void write_file(const std::string& path, std::string_view content);

struct NewFile {
  std::string path;
  std::string content;
};

/// Writes all or none: every content is on the disk before the first takes its place.
void write_files(const std::vector<NewFile>& files);

/// The part behind the last dot of the file's name, in lower case: "urdf"; empty when there is
/// none.
std::string extension(std::string_view path);

}  // namespace beeline
