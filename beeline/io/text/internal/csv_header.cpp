#include <algorithm>
#include <unordered_set>

#include <beeline/error.h>
#include <beeline/io/text/internal/comment_header.h>
#include <beeline/io/text/internal/csv_header.h>
#include <beeline/io/text/internal/csv_items.h>
#include <beeline/io/text/internal/csv_number.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/numbers.h>

namespace beeline::internal {
namespace {

constexpr std::size_t max_columns = 100'000;

/// Whether csv_number() reads the text where it may have a decimal comma; also infinity and nan.
bool is_number(std::string text) {
  if (text.empty()) return false;
  text = with_plain_minus(text);
  std::replace(text.begin(), text.end(), ',', '.');
  double value = 0;
  const char* const last = text.data() + text.size();
  return parse_double(text.data() + (text.starts_with('+') ? 1 : 0), last, value).ptr == last;
}

/// Whether the text has digits, and otherwise only what may be beside them: also `1.2.3`.
bool has_only_digits(std::string text) {
  text = with_plain_minus(text);
  return text.find_first_not_of("0123456789+-.,eE") == std::string::npos &&
         text.find_first_of("0123456789") != std::string::npos;
}

}  // namespace

void check_column_count(std::size_t count) {
  if (count <= max_columns) return;
  throw Error("there are more than " + std::to_string(max_columns) + " columns");
}

std::size_t item_count(std::string_view line, char separator) {
  std::size_t count = 1;
  for (std::string item; take_item(line, item, separator);) ++count;
  return count;
}

CsvNames parse_header(std::string_view line, char separator, bool has_index) {
  check_column_count(item_count(line, separator));
  CsvNames columns = csv_items(line, separator);
  while (columns.size() > 1 && columns.back().empty()) columns.pop_back();
  if (has_index && columns.size() > 1 && columns[0].empty()) columns[0] = index_name;
  if (columns.size() > 1 && columns[0].empty()) {
    throw Error("the name of column 1 is empty, as of an index of pandas; remove this column");
  }
  std::unordered_set<std::string_view> seen;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    check_name(columns[i], "the name of column " + std::to_string(i + 1));
    if (!seen.insert(columns[i]).second) {
      throw Error("column " + in_quotes(columns[i]) + " is given twice");
    }
  }
  return columns;
}

FirstLine first_line(std::string_view line, char separator) {
  FirstLine found;
  std::string item;
  for (bool more = true; more;) {
    more = take_item(line, item, separator);
    ++found.all_items;
    if (!item.empty()) found.count = found.all_items;
    const bool number = is_number(item);
    found.any_number = found.any_number || number;
    found.all_numbers = found.all_numbers && (number || item.empty() || has_only_digits(item));
  }
  return found;
}

const CsvNames* form_of(std::size_t count, const std::vector<CsvNames>& forms) {
  const auto form = std::find_if(forms.begin(), forms.end(),
                                 [count](const auto& names) { return names.size() == count; });
  if (form != forms.end()) return &*form;
  return forms.size() == 1 ? &forms.front() : nullptr;
}

std::string form_text(const CsvNames& form) {
  constexpr std::size_t most = 7;
  const bool all = form.size() <= most;
  const CsvNames shown = all ? form : CsvNames{form[0], form[1], "...", form.back()};
  return std::to_string(form.size()) + " (" + listed(shown) + ")";
}

void refuse_numbers(std::size_t count, const std::vector<CsvNames>& forms,
                    const std::vector<Comment>& comments) {
  for (const Comment& comment : comments) {
    if (words_without_units(comment.text).size() != count) continue;
    throw Error("the first line must be a header of names; the comment " + in_quotes(comment.text) +
                " is none, as not all of its names are known or needed");
  }
  std::string choices;
  std::vector<std::size_t> counts;
  for (const CsvNames& form : forms) {
    if (std::find(counts.begin(), counts.end(), form.size()) != counts.end()) continue;
    counts.push_back(form.size());
    choices += (choices.empty() ? "" : ", ") + form_text(form);
  }
  throw Error("the first line must be a header of names" +
              (choices.empty() ? ""
                               : "; it has " + std::to_string(count) +
                                     " numbers, and a row without a header has one of " + choices));
}

}  // namespace beeline::internal
