#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace beeline {

/// What the path "-" stands for: a file of that name, or the standard input or output.
enum class Dash { file, standard };

/// A file that is too large to be taken in at once, read from front to end. All functions throw
/// FileError for what the system refuses.
class InputFile {
 public:
  explicit InputFile(const std::string& path, Dash dash = Dash::file);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Reads `most` bytes, or fewer where the file ends; returns how many.
  std::size_t read(char* bytes, std::size_t most);

  std::uint64_t position() const { return position_; }         ///< bytes read
  std::optional<std::uint64_t> size() const { return size_; }  ///< none for pipes and devices
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int descriptor_ = -1;
  std::uint64_t position_ = 0;
  std::optional<std::uint64_t> size_;
};

/// A file that is written piece by piece and then takes its place at once: readers see the old file
/// or the new one, never a half. Without put_in_place() nothing is left behind. Pipes, devices and
/// the standard output cannot be replaced: what they were given, they have.
/// All functions throw FileError for what the system refuses.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path, Dash dash = Dash::file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  bool replaces() const { return replaces_; }  ///< false for pipes and devices
  void append(std::string_view bytes);
  /// Writes over the first bytes. Requires replaces().
  void overwrite_front(std::string_view bytes);
  void put_in_place();

 private:
  std::string path_, target_, beside_;  ///< `beside_` is empty while the file has no name
  bool replaces_ = true;
  int descriptor_ = -1;
};

}  // namespace beeline
