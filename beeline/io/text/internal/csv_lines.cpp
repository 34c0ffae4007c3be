#include <algorithm>
#include <cstring>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
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
  if (std::string_view(",;\t ").find(separator) == std::string_view::npos) return std::nullopt;
  return separator;
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
    throw FileError(file_->path(), 0,
                    "line " + std::to_string(number_ + 1) + " is longer than " +
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

bool CsvLines::next_raw(std::string_view& line) {
  if (line_end_ == '\0') find_line_end();
  std::size_t searched = 0;  // bytes of `unread_` that hold no line break
  for (;;) {
    const std::size_t end = unread_.find(line_end_, searched);
    if (end != std::string_view::npos || (ended_ && !unread_.empty())) {
      line = unread_.substr(0, end);
      unread_.remove_prefix(std::min(line.size() + 1, unread_.size()));
      ++number_;
      return true;
    }
    if (ended_) return false;
    searched = unread_.size();
    read_more();
  }
}

void CsvLines::keep_comment(std::string_view line) {
  constexpr std::size_t most = 100, longest = 10'000;  // a header, which comes last, may be longer
  const std::size_t text = line.find_first_not_of("#% \t");
  line = text == std::string_view::npos ? std::string_view() : line.substr(text);
  const bool full = comments_.size() == most;
  if (!comments_.empty() && (full || comments_.back().size() > longest)) comments_.pop_back();
  comments_.emplace_back(line);
}

bool CsvLines::next(std::string_view& line) {
  while (next_raw(line)) {
    if (number_ == 1 && (separator_ = separator_given_by(line))) continue;
    line = trimmed(line);
    const bool comment = line.starts_with('#') || line.starts_with('%');
    if (!line.empty() && !comment) {
      in_front_ = false;
      return true;
    }
    if (in_front_ && comment) keep_comment(line);
  }
  return false;
}

}  // namespace beeline::internal
