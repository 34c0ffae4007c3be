#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>

namespace beeline {

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

/// Returns text, such as a path, as one word of a command line, to be pasted into a shell: in
/// single quotes unless it has only letters, digits and `_ - . , / : + @ %`.
std::string shell_word(std::string_view text);

/// The meaning of the path "-": a file of that name, or the standard input or output.
enum class Dash { file, standard };

/// The standard output is a pipe that its reader has closed, as `head` does when it has read
/// enough.
class ClosedPipe : public FileError {
 public:
  explicit ClosedPipe(const std::string& path)
      : FileError(path, 0, "cannot be written: its reader has closed the pipe") {}
};

/// Reads a file from front to end in blocks. All functions throw FileError for errors of the
/// system.
class InputFile {
 public:
  explicit InputFile(const std::string& path, Dash dash = Dash::file);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Reads `wanted` bytes, or fewer at the end of the file; returns the number read.
  std::size_t read(char* bytes, std::size_t wanted);

  /// Returns the bytes that read() returns next, at most `wanted`, without advancing; valid until
  /// the next call of either.
  std::string_view peek(std::size_t wanted);

  std::uint64_t position() const { return position_; }         ///< bytes read
  std::optional<std::uint64_t> size() const { return size_; }  ///< none for pipes and devices
  const std::string& path() const { return path_; }

 private:
  std::size_t read_from_system(char* bytes, std::size_t wanted);

  std::string path_;
  int descriptor_ = -1;
  std::string peeked_;  ///< read from the system but not by read()
  std::uint64_t position_ = 0;
  std::optional<std::uint64_t> size_;
};

/// Writes a temporary file in blocks; commit() then renames it to `path`: a reader finds the old
/// content or the new one, never a part. Without commit() the temporary file is deleted. Pipes,
/// devices and the standard output are written directly.
/// All functions throw FileError for errors of the system, append() ClosedPipe for a
/// standard output that its reader has closed.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path, Dash dash = Dash::file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Whether commit() replaces a file at `path`; false for pipes, devices and standard output.
  bool replaces() const { return replaces_; }
  void append(std::string_view bytes);
  /// Overwrites the first bytes of the file. Requires replaces().
  void overwrite_front(std::string_view bytes);
  void commit();

 private:
  std::string path_, target_, temporary_;  ///< `temporary_` is empty while the file has no name
  bool replaces_ = true, standard_ = false;
  int descriptor_ = -1;
};

}  // namespace beeline
