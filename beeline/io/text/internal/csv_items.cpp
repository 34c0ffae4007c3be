#include <array>
#include <unordered_map>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/text/internal/csv_items.h>
#include <beeline/io/text/internal/csv_number.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/numbers.h>

namespace beeline::internal {
namespace {

/// The position of the first separator in `line`; npos if there is none.
std::size_t separator_in(std::string_view line, char separator) {
  return separator == ' ' ? line.find_first_of(" \t") : line.find(separator);
}

/// Removes the separator that begins at `end`, with the blanks that belong to it; returns false if
/// there is none.
bool remove_up_to(std::string_view& line, std::size_t end, char separator) {
  const bool more = end != std::string_view::npos;
  line.remove_prefix(more ? end + 1 : line.size());
  while (separator == ' ' && !line.empty() && is_blank(line.front())) line.remove_prefix(1);
  return more;
}

/// Whether the line is a row of numbers, and each of its commas is between two digits.
bool has_decimal_commas(std::string_view text) {
  const std::string line = with_plain_minus(text);
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (line.find_first_not_of("0123456789+-.,eE; \t|\"") != line.npos) return false;
  for (std::size_t i = line.find(','); i != line.npos; i = line.find(',', i + 1)) {
    if (i == 0 || i + 1 == line.size() || !is_digit(line[i - 1]) || !is_digit(line[i + 1])) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool is_framed(std::string_view line) {
  return line.size() > 1 && line.starts_with('|') && line.ends_with('|');
}

std::string_view without_terminators(std::string_view line) {
  while (!line.empty() && (line.back() == ';' || is_blank(line.back()))) line.remove_suffix(1);
  return line;
}

char csv_separator(std::string_view line) {
  line = trimmed(line);
  if (is_framed(line)) return '|';
  bool quoted = false;
  constexpr std::string_view separators = ",;\t| ";
  std::array<bool, separators.size()> found{};  // outside of quotes
  for (const char c : without_terminators(line)) {
    if (c == '"') quoted = !quoted;
    const std::size_t i = separators.find(c);
    if (!quoted && i != std::string_view::npos) found[i] = true;
  }
  found.front() = found.front() && !has_decimal_commas(without_terminators(line));
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i]) return separators[i];
  }
  return line.ends_with(';') && line.find(',') == std::string_view::npos ? ';' : ',';
}

bool take_item(std::string_view& line, std::string& item, char separator) {
  const std::size_t start = line.find_first_not_of(separator == '\t' ? " " : " \t");
  if (start == std::string_view::npos || line[start] != '"') {
    const std::size_t end = separator_in(line, separator);
    item = trimmed(line.substr(0, end));
    return remove_up_to(line, end, separator);
  }
  item.clear();
  std::size_t at = start + 1;
  for (;; ++at) {
    if (at >= line.size()) throw Error("a quotation mark is not closed");
    if (line[at] != '"') {
      item += line[at];
    } else if (line.substr(at + 1).starts_with('"')) {
      item += line[at++];  // a doubled quotation mark is one character
    } else {
      break;
    }
  }
  line.remove_prefix(at + 1);
  if (trimmed(line).empty()) return false;
  const std::size_t next =
      separator == ' ' ? 0 : line.find_first_not_of(separator == '\t' ? " " : " \t");
  const bool separated = separator == ' ' ? is_blank(line.front()) : line[next] == separator;
  if (!separated) {
    throw Error(in_quotes(trimmed(line)) + " follows a closing quotation mark");
  }
  return remove_up_to(line, next, separator);
}

std::vector<std::string> csv_items(std::string_view line, char separator) {
  std::vector<std::string> items(1);
  line = trimmed(line);
  while (take_item(line, items.back(), separator)) items.emplace_back();
  return items;
}

std::string csv_name(const std::string& name) {
  const bool plain = name.find_first_of(",; \t|\"") == std::string::npos &&
                     name.find_first_not_of("-=+:") != std::string::npos &&
                     !name.starts_with('#') && !name.starts_with('%') && !name.starts_with("//");
  if (plain) return name;
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + '"';
}

std::optional<std::vector<std::size_t>> positions_of(const std::vector<std::string>& header,
                                                     const std::vector<std::string>& names) {
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  if (header.size() != names.size()) return std::nullopt;
  std::unordered_map<std::string, std::size_t> exact, lower;
  for (std::size_t i = 0; i < names.size(); ++i) {
    exact.emplace(names[i], i);
    if (!lower.emplace(lower_case(names[i]), i).second) lower[lower_case(names[i])] = none;
  }
  std::vector<std::size_t> positions;
  std::vector<bool> taken(names.size());
  for (const std::string& item : header) {
    auto found = exact.find(item);
    if (found == exact.end()) {
      found = lower.find(lower_case(item));
      if (found == lower.end() || found->second == none) return std::nullopt;
    }
    if (taken[found->second]) return std::nullopt;
    taken[found->second] = true;
    positions.push_back(found->second);
  }
  return positions;
}

}  // namespace beeline::internal
