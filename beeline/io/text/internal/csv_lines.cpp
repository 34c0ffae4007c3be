#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/text/internal/csv_header.h>
#include <beeline/io/text/internal/csv_items.h>
#include <beeline/io/text/internal/csv_lines.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/internal/text_encoding.h>

namespace beeline::internal {
namespace {

/// The separator of a line `sep=;`, in any case; none in another line.
std::optional<char> separator_given_by(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  constexpr std::string_view begin = "sep=";
  if (line.size() != begin.size() + 1) return std::nullopt;
  if (!same_ignoring_case(line.substr(0, begin.size()), begin)) return std::nullopt;
  const char separator = line.back();
  if (std::string_view(",;\t |").find(separator) == std::string_view::npos) return std::nullopt;
  return separator;
}

/// Whether a line separates parts of a table, as in Markdown, psql and reStructuredText: `|---|`.
bool is_rule(std::string_view line) {
  if (line.find_first_not_of("-=|+: \t") != std::string_view::npos) return false;
  const bool framed = line.starts_with('|') && line.ends_with('|');
  const auto has = [line](const char* text) { return line.find(text) != std::string_view::npos; };
  return has("---") || has("===") || (framed && (has("--") || has(":-") || has("-:")));
}

/// Whether a line has nothing but separators, as in Excel's empty rows.
bool has_only_separators(std::string_view line) {
  return line.find_first_not_of(",;| \t") == std::string_view::npos;
}

bool begins_as_comment(std::string_view line) {
  return line.starts_with('#') || line.starts_with('%') || line.starts_with("//");
}

/// Whether a line has two items, separated by a semicolon, one of them a number at least.
bool is_row_of_two(std::string_view line) {
  if (csv_separator(line) != ';') return false;
  try {
    const FirstLine items = first_line(line, ';');
    return items.count == 2 && items.any_number;
  } catch (const Error&) {
    return false;  // the line is refused when it is read
  }
}

/// Removes the signs of a comment, and blanks, in front of its text.
std::string_view text_of_comment(std::string_view line) {
  for (std::size_t size = 1; size > 0; line.remove_prefix(size)) {
    const bool slashes = line.starts_with("//");
    const bool sign =
        !line.empty() && std::string_view("#%; \t").find(line.front()) != std::string_view::npos;
    size = slashes ? 2 : sign ? 1 : 0;
  }
  return line;
}

}  // namespace

CsvLines::CsvLines(std::string_view text, const std::string& path) : unread_(text_in(text, path)) {}

CsvLines::CsvLines(InputFile& file, std::size_t max_line)
    : file_(&file), buffer_(max_line), ended_(false) {
  begin_text(file);
}

/// Moves the unread text to the front of the buffer and fills the remainder from the file.
void CsvLines::read_more() {
  if (unread_.size() == buffer_.size()) {
    const std::int64_t line = taken_ + static_cast<std::int64_t>(ahead_.size()) + 1;
    throw FileError(file_->path(), 0,
                    "line " + std::to_string(line) + " is longer than " +
                        std::to_string(buffer_.size()) + " bytes; is this a CSV file?");
  }
  const std::size_t kept = unread_.size(), wanted = buffer_.size() - kept;
  if (kept > 0) std::memmove(buffer_.data(), unread_.data(), kept);
  const std::size_t count = file_->read(buffer_.data() + kept, wanted);
  ended_ = count < wanted;
  unread_ = {buffer_.data(), kept + count};
}

/// Lines end at CR alone where the text, or the first block of a file, has no LF.
void CsvLines::find_line_end() {
  if (unread_.empty() && !ended_) read_more();
  const bool alone =
      unread_.find('\n') == std::string_view::npos && unread_.find('\r') != std::string_view::npos;
  line_end_ = alone ? '\r' : '\n';
}

bool CsvLines::read_raw(std::string_view& line) {
  if (line_end_ == '\0') find_line_end();
  std::size_t searched = 0;  // bytes of `unread_` that hold no line break
  for (;;) {
    const std::size_t end = unread_.find(line_end_, searched);
    if (end != std::string_view::npos || (ended_ && !unread_.empty())) {
      line = unread_.substr(0, end);
      unread_.remove_prefix(std::min(line.size() + 1, unread_.size()));
      return true;
    }
    if (ended_) return false;
    searched = unread_.size();
    read_more();
  }
}

bool CsvLines::next_raw(std::string_view& line) {
  if (ahead_.empty()) {
    if (!read_raw(line)) return false;
  } else {
    line_ = std::move(ahead_.front());
    ahead_.pop_front();
    line = line_;
  }
  number_ = ++taken_;
  return true;
}

std::vector<CsvLines::Line> CsvLines::look_ahead(std::size_t count) {
  constexpr std::size_t most = 100, most_bytes = 1'000'000;
  std::size_t bytes = 0;
  for (const std::string& line : ahead_) bytes += line.size();
  for (std::string_view line; ahead_.size() < most && bytes < most_bytes && read_raw(line);) {
    bytes += line.size();
    ahead_.emplace_back(line);
  }
  std::vector<Line> lines;
  std::int64_t number = taken_;
  if (row_below_ends_) lines.push_back({*row_below_ends_, number});
  for (const std::string& raw : ahead_) {
    ++number;
    if (lines.size() == count) break;
    const std::string_view line = trimmed(raw);
    if (has_only_separators(line) || is_rule(line) || begins_as_comment(line)) continue;
    lines.push_back({std::string(line), number});
  }
  return lines;
}

void CsvLines::keep_comment(std::string_view line) {
  constexpr std::size_t most = 100, longest = 10'000;  // a header, which comes last, may be longer
  line = text_of_comment(line);
  const bool full = comments_.size() == most;
  if (!comments_.empty() && (full || comments_.back().text.size() > longest)) comments_.pop_back();
  constexpr std::int64_t last = std::numeric_limits<int>::max();
  comments_.push_back({std::string(line), static_cast<int>(std::min(number_, last))});
}

bool CsvLines::next(std::string_view& line) {
  if (row_below_ends_) {
    take_kept(line);
    return true;
  }
  while (next_raw(line)) {
    if (number_ == 1 && (separator_ = separator_given_by(line))) continue;
    line = trimmed(line);
    if (line.empty()) continue;
    if (is_comment(line)) {
      keep_comment(line);
      continue;
    }
    if (skips(line) || keeps_for_end(line)) continue;
    if (!has_begun_) is_framed_ = is_framed(line);
    has_begun_ = true;
    below_rule_ = false;
    if (!ends_.empty()) {
      row_below_ends_ = std::string(line);
      take_kept(line);
    }
    return true;
  }
  ends_.clear();
  return false;
}

/// Whether a line is a comment. `line` stays valid.
bool CsvLines::is_comment(std::string_view& line) {
  if (begins_as_comment(line)) return true;
  const bool remark =
      !has_begun_ && line.starts_with(';') && line.find(';', 1) == std::string_view::npos;
  if (!remark) return false;
  line_ = std::string(line);
  line = line_;
  const std::vector<Line> below = look_ahead(1);
  return below.empty() || !is_row_of_two(below.front().text);
}

/// Whether a line is none of the table's rows, whatever follows.
bool CsvLines::skips(std::string_view line) {
  const bool rule = is_rule(line);
  if (!has_begun_) {
    if (!rule && !has_only_separators(line)) return false;
    begins_in_rule_ = begins_in_rule_ || rule;
    const bool is_row = !rule || line.find_first_of("+|") == std::string_view::npos;
    if (is_row && row_above_ == 0) row_above_ = number_;
    return true;
  }
  if (!rule) return false;
  // In a frame `| --- | --- |` is a row without numbers, except below the header.
  if (rows_begun_) return is_framed_ && line.find(' ') == std::string_view::npos;
  return is_framed_ || !std::exchange(below_rule_, true);
}

/// Keeps a line that is no row if no other row follows; returns false for another line, and when
/// there are too many.
bool CsvLines::keeps_for_end(std::string_view line) {
  constexpr std::size_t most = 100, longest = 10'000;
  const bool end = has_only_separators(line) || (begins_in_rule_ && is_rule(line));
  if (!end || line.size() > longest) return false;
  if (!ends_.empty() && ends_.back().text == line &&
      ends_.back().first + ends_.back().count == number_) {
    ++ends_.back().count;
    return true;
  }
  if (ends_.size() == most) return false;
  ends_.push_back({std::string(line), number_, 1});
  return true;
}

/// Takes the first of the lines that were kept, or the row below them.
void CsvLines::take_kept(std::string_view& line) {
  if (!ends_.empty() && ends_.front().count == 0) ends_.pop_front();
  if (ends_.empty()) {
    line_ = std::move(*row_below_ends_);
    line = line_;
    row_below_ends_.reset();
    number_ = taken_;
    return;
  }
  Ends& first = ends_.front();
  line = first.text;
  number_ = first.first++;
  --first.count;
}

}  // namespace beeline::internal
