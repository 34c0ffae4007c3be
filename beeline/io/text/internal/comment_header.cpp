#include <algorithm>
#include <iterator>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/text/internal/column_unit.h>
#include <beeline/io/text/internal/comment_header.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/numbers.h>

namespace beeline::internal {
namespace {

constexpr std::string_view opening = "[(";

/// Words, with one in brackets as `[deg / s]` whole.
std::vector<std::string> words_of(std::string_view text) {
  constexpr std::string_view gaps = " \t,;|", closing = "])";
  std::vector<std::string> words;
  for (std::size_t begin = 0; (begin = text.find_first_not_of(gaps, begin)) != text.npos;) {
    const std::size_t bracket = opening.find(text[begin]);
    std::size_t end = text.npos;
    if (bracket != opening.npos) end = text.find(closing[bracket], begin);
    if (end != text.npos) ++end;
    if (end == text.npos) end = std::min(text.find_first_of(gaps, begin), text.size());
    words.emplace_back(text.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

/// The name of a column in lower case, without a unit in brackets behind it.
std::string stem_of(const std::string& word) {
  const std::size_t bracket = word.find_first_of(opening);
  const bool unit = bracket != word.npos && states_unit(std::string_view(word).substr(bracket));
  return lower_case(unit ? word.substr(0, bracket) : word);
}

/// Whether a word, in lower case, is one of the known names or names a column of other tables.
/// Other words may be prose: `x and y`.
bool is_name(const std::string& word, const std::vector<std::string>& known) {
  static const std::vector<std::string> others{
      "alpha", "angle", "beta",  "gamma", "heading", "index", "phi", "pitch",
      "psi",   "qw",    "qx",    "qy",    "qz",      "roll",  "rot", "rx",
      "ry",    "rz",    "theta", "vx",    "vy",      "vz",    "yaw"};
  const auto has = [&word](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), word) != names.end();
  };
  return has(known) || has(others) || is_time_name(word) || (word.size() == 1 && word != "a") ||
         word.find_first_of("_0123456789") != word.npos;
}

/// The number of texts in a comment between commas, semicolons, tabs or pipes.
std::size_t separated_count(std::string_view comment) {
  constexpr std::string_view separators = ",;\t|";
  std::size_t count = 0;
  for (std::size_t begin = 0; begin < comment.size();) {
    const std::size_t end = std::min(comment.find_first_of(separators, begin), comment.size());
    if (!trimmed(comment.substr(begin, end - begin)).empty()) ++count;
    begin = end + 1;
  }
  return count;
}

}  // namespace

std::vector<std::string> words_without_units(std::string_view comment) {
  const std::vector<std::string> all = words_of(comment);
  std::vector<std::string> words;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool is_unit = opening.find(all[i].front()) != opening.npos && states_unit(all[i]);
    const bool is_title = i == 0 && all[i].ends_with(':');
    if (is_unit || is_title) continue;
    if (lower_case(all[i]) == "in" && i + 1 < all.size() && states_unit(all[i + 1])) {
      ++i;
    } else {
      words.push_back(all[i]);
    }
  }
  return words;
}

void check_comment_on_columns(const Comment& comment, const std::vector<std::string>& columns,
                              const std::string& path) {
  std::vector<std::string> known, named;
  for (const std::string& column : columns) known.push_back(lower_case(column));
  const std::vector<std::string> words = words_without_units(comment.text);
  for (const std::string& word : words) {
    std::string stem = stem_of(word);
    if (std::find(known.begin(), known.end(), stem) != known.end()) named.push_back(stem);
  }
  const bool all = std::is_permutation(named.begin(), named.end(), known.begin(), known.end());
  const bool others =
      !all && named.size() > 1 && words.size() == columns.size() &&
      (std::all_of(words.begin(), words.end(),
                   [&](const auto& word) { return is_name(stem_of(word), known); }) ||
       separated_count(comment.text) == columns.size());
  if ((!all && !others) || named == known) return;
  throw FileError(path, comment.line,
                  "rows without a header are read as " + listed(columns) + "; the comment " +
                      in_quotes(comment.text) + " names " +
                      (all ? "them in another order" : "other columns") +
                      "; write a header of names that are known");
}

}  // namespace beeline::internal
