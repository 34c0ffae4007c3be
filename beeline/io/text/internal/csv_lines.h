#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/io/text/file.h>

namespace beeline::internal {

/// Iterates over the lines of a CSV text that hold data: skips empty lines, comments (lines that
/// begin with # or %) and a first line `sep=;`, by which Excel knows the separator; removes blanks
/// around each line. The text begins as text_in() describes. Its
/// lines end in LF or CRLF, or all in CR.
class CsvLines {
 public:
  /// Lines of `text`, which must outlive this object. `path` names its file in messages.
  CsvLines(std::string_view text, const std::string& path);

  /// Lines of a file of any size, read in blocks of `max_line` bytes. next() throws FileError for a
  /// longer line. `file` must outlive this object.
  CsvLines(InputFile& file, std::size_t max_line);

  /// Gets the next line, which is valid until the next call; returns false at the end.
  bool next(std::string_view& line);
  std::int64_t number() const { return number_; }  ///< of the line from next(), from 1
  /// The comments before the first line of data, without their # or %: the last one and, if there
  /// are many, the first ones of the others, as far as they are short.
  const std::vector<std::string>& comments() const { return comments_; }
  /// The separator that the first line gives, once a line has been read.
  std::optional<char> separator() const { return separator_; }

 private:
  bool next_raw(std::string_view& line);
  void keep_comment(std::string_view line);
  void read_more();
  void find_line_end();

  InputFile* file_ = nullptr;  ///< null: all text is present
  std::vector<char> buffer_;
  std::string_view unread_;
  bool ended_ = true;     ///< no text follows `unread_`
  char line_end_ = '\0';  ///< unknown before the first line
  std::int64_t number_ = 0;
  std::vector<std::string> comments_;
  std::optional<char> separator_;
  bool in_front_ = true;  ///< no line of data has been returned
};

}  // namespace beeline::internal
