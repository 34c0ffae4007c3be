#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/comment.h>

namespace beeline::internal {

/// Iterates over the lines of a CSV text that hold data: skips blank lines, comments (lines that
/// begin with #, % or //, before the first data also `;remark`), a first line `sep=;`, by which
/// Excel knows the separator, and
/// - above the header: lines of separators alone and rules, as `--- ---`
/// - below it: rules; also among the rows if the table has a frame, `|---|`
/// - at the end: lines of separators alone, as Excel writes them, and a rule if one began the table
///
/// `;joint1` above a row of two items, separated by a semicolon, is the header of pandas, not a
/// remark. Removes blanks around each line. The text begins as text_in() describes. Its lines
/// end in LF or CRLF, or all in CR.
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

  struct Line {
    std::string text;
    std::int64_t number = 0;
  };
  /// Returns the next lines with data, `count` and some hundred at most; next() returns them all
  /// the same. A line that it returned before is no longer valid.
  std::vector<Line> look_ahead(std::size_t count);

  /// From now on, rules are rows unless the table has a frame.
  void begin_rows() { rows_begun_ = true; }
  /// The first line skipped above the first data that would be a row of a table without a header: a
  /// line of separators alone or a rule; 0: none.
  std::int64_t row_above() const { return row_above_; }
  /// Returns the comments that were skipped since the last call: the last one and, if there are
  /// many, the first ones of the others, as far as they are short.
  std::vector<Comment> take_comments() { return std::exchange(comments_, {}); }
  /// The separator that the first line gives, once a line has been read.
  std::optional<char> separator() const { return separator_; }

 private:
  /// Lines in succession that may be the end of the table.
  struct Ends {
    std::string text;
    std::int64_t first = 0, count = 0;
  };

  bool next_raw(std::string_view& line);
  bool read_raw(std::string_view& line);
  bool is_comment(std::string_view& line);
  void keep_comment(std::string_view line);
  bool skips(std::string_view line);
  bool keeps_for_end(std::string_view line);
  void take_kept(std::string_view& line);
  void read_more();
  void find_line_end();

  InputFile* file_ = nullptr;  ///< null: all text is present
  std::vector<char> buffer_;
  std::string_view unread_;
  bool ended_ = true;       ///< no text follows `unread_`
  char line_end_ = '\0';    ///< unknown before the first line
  bool has_begun_ = false;  ///< a line with data was returned
  bool rows_begun_ = false;
  bool is_framed_ = false;       ///< the first data
  bool begins_in_rule_ = false;  ///< a rule above the first data
  bool below_rule_ = false;      ///< the line before was a rule
  std::int64_t row_above_ = 0;
  std::int64_t number_ = 0;        ///< of the line from next()
  std::int64_t taken_ = 0;         ///< lines from next_raw()
  std::deque<std::string> ahead_;  ///< lines from read_raw() that next_raw() gets first
  std::string line_;               ///< memory of a line that is not in the buffer
  std::deque<Ends> ends_;          ///< lines that are rows if another row follows
  std::optional<std::string> row_below_ends_;
  std::vector<Comment> comments_;
  std::optional<char> separator_;
};

}  // namespace beeline::internal
