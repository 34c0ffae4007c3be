#include <algorithm>
#include <unordered_map>

#include <beeline/internal/letter_case.h>
#include <beeline/io/text/internal/comment_words.h>

namespace beeline::internal {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80; }

/// The text with single blanks, none of them beside a slash.
std::string normalised(std::string_view comment) {
  std::string text;
  for (const char c : comment) {
    const bool blank = c == ' ' || c == '\t' || c == '\r';
    if (blank && (text.empty() || text.back() == ' ' || text.back() == '/')) continue;
    if (c == '/' && text.ends_with(' ')) text.pop_back();
    text += blank ? ' ' : c;
  }
  return text;
}

/// A run of letters, letters and digits or digits, or a mark.
struct RawWord {
  std::size_t begin = 0, end = 0;
};

std::vector<RawWord> raw_words(std::string_view text) {
  std::vector<RawWord> words;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t begin = i++;
    const char first = text[begin];
    if (first == ' ') continue;
    const auto at = [&](std::size_t k) { return k < text.size() ? text[k] : ' '; };
    if (is_digit(first)) {
      while (is_digit(at(i))) ++i;
    } else if (is_letter(first)) {
      while (is_letter(at(i)) || is_digit(at(i)) || (at(i) == '\'' && is_letter(at(i + 1)))) ++i;
    }
    words.push_back({begin, i});
  }
  return words;
}

/// Whether a word between blanks names a file or a folder: `data_deg.csv`, `c:\data`, `../deg/`.
bool is_path(std::string_view word) {
  while (!word.empty() && std::string_view(",;:.!?)]}\"'").find(word.back()) != word.npos) {
    word.remove_suffix(1);
  }
  if (word.find('\\') != word.npos || word.ends_with('/')) return true;
  if (word.starts_with('/') || word.starts_with("./") || word.starts_with("../")) return true;
  const std::size_t dot = word.find_last_of('.');
  if (dot == word.npos || dot == 0 || is_digit(word[dot - 1])) return false;
  const std::string_view ending = word.substr(dot + 1);
  constexpr std::size_t longest_ending = 5;
  return ending.size() >= 2 && ending.size() <= longest_ending &&
         std::all_of(ending.begin(), ending.end(), is_letter);
}

/// Letters and digits of a name in lower case.
std::string letters_of(std::string_view name) {
  std::string letters;
  for (const char c : lower_case(name)) {
    if (is_letter(c) || is_digit(c)) letters += c;
  }
  return letters;
}

/// Whether the name of a column, or its last part, says that it has times: `header/stamp_ns`,
/// `sec`, and `dwell` of programs.
bool has_times(const std::string& name) {
  const NameInUnit split = split_at_time_unit(name);
  const std::string last = lower_case(split.stem.substr(split.stem.find_last_of("/.") + 1));
  const Unit* const unit = unit_called(last);
  return is_time_name(last) || last == "dwell" ||
         (unit != nullptr && unit->quantity == Quantity::time);
}

using ColumnIndices = std::unordered_map<std::string, std::optional<std::size_t>>;

/// Splits a comment into words.
class WordReader {
 public:
  /// `written` is the text before it was converted to lower case.
  WordReader(std::string_view text, std::string_view written, const ColumnIndices& columns,
             bool poses)
      : text_(text), written_(written), columns_(columns), poses_(poses), raw_(raw_words(text)) {}

  std::vector<CommentWord> read() {
    while (at_ < raw_.size()) {
      if (!take_column()) take_word();
    }
    return std::move(words_);
  }

 private:
  std::string_view raw(std::size_t i) const {
    return i < raw_.size() ? text_.substr(raw_[i].begin, raw_[i].end - raw_[i].begin)
                           : std::string_view();
  }

  /// Whether a name goes on at this place of the text.
  bool goes_on_at(std::size_t i) const {
    return i < text_.size() && (text_[i] == '_' || is_letter(text_[i]) || is_digit(text_[i]));
  }

  /// Takes the longest name of a column that begins here.
  bool take_column() {
    constexpr std::size_t longest = 16;
    const std::size_t begin = raw_[at_].begin;
    if (begin > 0 && goes_on_at(begin) && goes_on_at(begin - 1)) return false;
    std::string letters;
    std::size_t taken = 0, column = 0;
    for (std::size_t k = at_; k < std::min(at_ + longest, raw_.size()); ++k) {
      if (std::string_view(",;:=&|+").find(raw(k).front()) != std::string_view::npos) break;
      const std::string more = letters_of(raw(k));
      letters += more;
      if (more.empty() || goes_on_at(raw_[k].end)) continue;
      const auto found = columns_.find(letters);
      if (found == columns_.end() || !found->second) continue;
      taken = k + 1 - at_;
      column = *found->second;
    }
    if (taken == 0) return false;
    words_.push_back({.kind = WordKind::column, .text = std::string(raw(at_)), .column = column});
    if (taken > 1) words_.back().text.clear();
    at_ += taken;
    return true;
  }

  void take_word() {
    if (take_unit()) return;
    const std::string_view text = raw(at_);
    const char first = text.front();
    CommentWord word{.kind = WordKind::unknown, .text = std::string(text)};
    if (is_digit(first)) {
      word.kind = is_number_of_joint() ? WordKind::subject : WordKind::number;
      word.subject = word.kind == WordKind::subject ? single_subject : 0u;
    } else if (first == '.' || first == '!') {
      const std::size_t next = raw_[at_].end;
      word.kind = next == text_.size() || text_[next] == ' ' ? WordKind::end : WordKind::filler;
    } else {
      const Meaning meaning = meaning_of(text, poses_);
      word.kind = meaning.kind;
      word.subject = meaning.subject;
    }
    words_.push_back(std::move(word));
    ++at_;
  }

  /// Whether a number follows `joint`, or is an ordinal.
  bool is_number_of_joint() const {
    const std::string_view next = raw(at_ + 1);
    const bool touches = at_ + 1 < raw_.size() && raw_[at_ + 1].begin == raw_[at_].end;
    if (touches && (next == "st" || next == "nd" || next == "rd" || next == "th")) return true;
    for (auto word = words_.rbegin(); word != words_.rend(); ++word) {
      if (word->kind == WordKind::filler) continue;
      return word->kind == WordKind::subject &&
             (word->subject & (joint_subject | single_subject)) != 0;
    }
    return false;
  }

  /// Whether the text at this place is a part of a path, or the value of a command's option.
  bool is_quoted_from_elsewhere(std::size_t at) const {
    const std::size_t before = at == 0 ? text_.npos : text_.find_last_of(' ', at - 1);
    const std::size_t begin = before == text_.npos ? 0 : before + 1;
    if (is_path(text_.substr(begin, std::min(text_.find(' ', at), text_.size()) - begin))) {
      return true;
    }
    const auto is_option = [this](std::size_t from) {
      return text_.substr(from).starts_with("--") && from + 2 < text_.size() &&
             is_letter(text_[from + 2]);
    };
    if (is_option(begin)) return true;
    if (begin < 2) return false;
    const std::size_t earlier = text_.find_last_of(' ', begin - 2);
    return is_option(earlier == text_.npos ? 0 : earlier + 1);
  }

  bool take_unit() {
    const std::size_t begin = raw_[at_].begin;
    if (take_other_unit(begin)) return true;
    if (!is_letter(text_[begin])) return false;
    const std::string_view word = raw(at_);
    std::size_t size = 0;
    CommentWord found{.kind = WordKind::unit};
    for (const Unit& candidate : all_units()) {
      for (const std::string_view name : candidate.names) {
        if (name.size() <= size || !text_.substr(begin).starts_with(name)) continue;
        if (name.size() < word.size() && !has_rate(begin + name.size())) continue;
        if (name.size() > word.size()) continue;
        size = name.size();
        found.unit = &candidate;
      }
    }
    if (found.unit == nullptr) {
      found.foreign = foreign_unit(word);
      if (found.foreign == nullptr || !may_be_unit(word)) return false;
      found.kind = WordKind::unread_unit;
      found.power = found.foreign->power;
      size = word.size();
    }
    if (is_no_unit(word) || is_initial(begin + size)) return false;
    if (found.unit == nullptr || found.unit->quantity != Quantity::time) {
      const RateText rate = rate_at_front(text_.substr(begin + size));
      found.power += rate.power;
      size += rate.size;
      if (rate.size == 0) size = with_other_rate(begin, size, found);
    }
    found.text = std::string(text_.substr(begin, size));
    words_.push_back(std::move(found));
    if (is_quoted_from_elsewhere(begin)) words_.push_back({.kind = WordKind::doubt});
    while (at_ < raw_.size() && raw_[at_].begin < begin + size) ++at_;
    return true;
  }

  /// Whether a word with another meaning, as `min`, stands where a unit may: behind a link, or
  /// first or further in a list.
  bool may_be_unit(std::string_view word) const {
    if (meaning_of(word, poses_).kind == WordKind::unknown || words_.empty()) return true;
    const WordKind before = words_.back().kind;
    return before == WordKind::link || before == WordKind::separator;
  }

  bool has_rate(std::size_t at) const { return rate_at_front(text_.substr(at)).size > 0; }

  /// Whether a unit of one or two letters is the beginning of a name: `M. Meier`, `Ms. Jones`.
  bool is_initial(std::size_t end) const {
    if (end - raw_[at_].begin > 2 || end + 2 >= text_.size()) return false;
    if (text_[end] != '.' || text_[end + 1] != ' ') return false;
    const auto is_capital = [this](std::size_t at) { return written_[at] != text_[at]; };
    return is_capital(raw_[at_].begin) && is_capital(end + 2) &&
           unit_called(raw(at_ + 2)) == nullptr;
  }

  /// `second joint`, `degrees of freedom`, `second` alone, which numbers a row.
  bool is_no_unit(std::string_view word) const {
    const std::string_view next = raw(at_ + 1);
    const bool of_joint = (meaning_of(next, poses_).subject & joint_subject) != 0;
    if (next == "." && raw(at_ + 2) == "of") return true;  // `deg. of freedom`
    return next == "of" || (word == "second" && (of_joint || raw_.size() == 1));
  }

  /// The size of a unit with another unit of times behind a slash: `deg/min`.
  std::size_t with_other_rate(std::size_t begin, std::size_t size, CommentWord& found) const {
    if (begin + size >= text_.size() || text_[begin + size] != '/') return size;
    std::size_t last = begin + size + 1;
    while (last < text_.size() && is_letter(text_[last])) ++last;
    const std::string_view below = text_.substr(begin + size + 1, last - begin - size - 1);
    const Unit* const time = unit_called(below);
    const ForeignUnit* const foreign = foreign_unit(below);
    const bool rate = (time != nullptr && time->quantity == Quantity::time) ||
                      (foreign != nullptr && foreign->quantity == Quantity::time);
    if (!rate) return size;
    found.kind = WordKind::unread_unit;
    found.unit = nullptr;
    found.foreign = nullptr;
    found.power = 1;
    return last - begin;
  }

  /// A unit with marks, as `N*m` and `%`, and one of temperatures.
  bool take_other_unit(std::size_t begin) {
    const std::size_t size =
        std::min(text_.find_first_of(" ,;()[]{}:=", begin), text_.size()) - begin;
    std::string_view text = text_.substr(begin, size);
    if (text.size() > 1 && text.ends_with('.')) text.remove_suffix(1);
    const std::string_view next = raw(at_ + 1);
    const Unit* const degrees = unit_called(raw(at_));
    const bool temperature = degrees != nullptr && degrees->quantity == Quantity::angle &&
                             (next == "c" || next == "f" || next == "celsius" ||
                              next == "fahrenheit" || next == "centigrade");
    const bool marks = text == "%" || (text.size() > 1 && is_letter(text.front()));
    if (!temperature && !(marks && is_unit_of_other_quantity(text))) return false;
    words_.push_back(
        {.kind = WordKind::other_unit, .text = std::string(temperature ? raw(at_) : text)});
    const std::size_t behind = temperature ? raw_[at_ + 1].end : begin + text.size();
    while (at_ < raw_.size() && raw_[at_].begin < behind) ++at_;
    return true;
  }

  std::string_view text_, written_;
  const ColumnIndices& columns_;
  bool poses_;
  std::vector<RawWord> raw_;
  std::size_t at_ = 0;
  std::vector<CommentWord> words_;
};

bool is_any_unit(WordKind kind) {
  return kind == WordKind::unit || kind == WordKind::unread_unit || kind == WordKind::other_unit ||
         kind == WordKind::all_si;
}

/// Keeps the names of columns that a unit follows.
void keep_attached_columns(std::vector<CommentWord>& words, bool poses) {
  bool attached = false;
  for (std::size_t i = words.size(); i-- > 0;) {
    CommentWord& word = words[i];
    if (word.kind == WordKind::column) {
      if (attached) continue;
      const bool has_subject = i + 1 < words.size() && words[i + 1].kind == WordKind::subject;
      Meaning meaning = meaning_of(word.text, poses);
      if (meaning.kind == WordKind::unknown && has_subject) {
        meaning = {WordKind::subject, single_subject};
      }
      word.kind = meaning.kind;
      word.subject = meaning.subject;
    }
    const bool between = word.kind == WordKind::filler || word.kind == WordKind::link ||
                         word.kind == WordKind::separator;
    attached = is_any_unit(word.kind) || (attached && between);
  }
}

}  // namespace

ColumnWords::ColumnWords(const std::vector<std::string>& columns) {
  const std::vector<std::string> stems = columns_in_units(columns, {}).names;
  for (const std::string& column : columns) has_times_.push_back(has_times(column));
  bool x = false, y = false;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    for (const std::string& letters : {letters_of(columns[i]), letters_of(stems[i])}) {
      x = x || letters == "x" || letters == "m11";
      y = y || letters == "y" || letters == "m12";
      const auto [known, is_new] = columns_.emplace(letters, i);
      if (!is_new && known->second != i) known->second.reset();
    }
  }
  poses_ = x && y;
}

std::vector<CommentWord> ColumnWords::words_of(std::string_view comment) const {
  const std::string written = normalised(comment), text = lower_case(written);
  std::vector<CommentWord> words = WordReader(text, written, columns_, poses_).read();
  keep_attached_columns(words, poses_);
  for (CommentWord& word : words) {
    word.has_times = word.kind == WordKind::column && has_times_[word.column];
  }
  return words;
}

}  // namespace beeline::internal
