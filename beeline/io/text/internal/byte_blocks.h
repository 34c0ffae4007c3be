#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <beeline/io/text/file.h>

namespace beeline::internal {

/// The bytes of a file of any size, which is read in blocks, or of a text.
class ByteBlocks {
 public:
  /// `bytes` must outlive this object. `path` names the file in messages.
  ByteBlocks(std::string_view bytes, const std::string& path);
  /// `file`, a regular file, must outlive this object.
  explicit ByteBlocks(InputFile& file);

  /// The longest block and the longest line.
  static constexpr std::size_t max_block = std::size_t{1} << 20;

  const std::string& path() const { return path_; }
  std::uint64_t size() const { return size_; }  ///< of the file

  /// Returns the next bytes, `wanted` or fewer at the end, without advancing; valid until the next
  /// call.
  std::string_view peek(std::size_t wanted);
  /// Advances by bytes that peek() has returned.
  void skip(std::size_t count) { unread_.remove_prefix(count); }

  /// Gets the next line without its end, LF or CRLF, or CR alone if the front of the file has no
  /// LF; skips a byte order mark. Returns false at the end. Throws FileError for a line longer than
  /// max_block.
  bool next_line(std::string_view& line);
  int line() const { return line_; }  ///< number of the line from next_line(), from 1

 private:
  void fill(std::size_t wanted);

  std::string path_;
  std::uint64_t size_ = 0;
  InputFile* file_ = nullptr;  ///< null: all bytes are present
  std::string buffer_;
  std::string_view unread_;
  char line_end_ = '\0';  ///< unknown before the first line
  int line_ = 0;
};

}  // namespace beeline::internal
