#include <algorithm>
#include <cmath>
#include <locale>
#include <numbers>
#include <numeric>
#include <sstream>
#include <utility>

#include <beeline/error.h>
#include <beeline/internal/nearest_name.h>
#include <beeline/internal/utf8.h>

namespace beeline {
namespace {

constexpr std::size_t longest_compared = 100;  // a longer name is not a misspelt choice

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }

/// The number of characters inserted, left out or replaced, or of neighbours exchanged, between `a`
/// and `b`, ignoring case: the optimal string alignment distance.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  const auto equal = [&](std::size_t i, std::size_t j) { return lower(a[i]) == lower(b[j]); };
  std::vector<std::size_t> before, last, row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    before = std::exchange(last, row);
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      row[j + 1] = std::min({last[j] + (equal(i, j) ? 0 : 1), row[j] + 1, last[j + 1] + 1});
      const bool exchanged = i > 0 && j > 0 && equal(i, j - 1) && equal(i - 1, j);
      if (exchanged) row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
    }
  }
  return row.back();
}

std::string_view without_dashes(std::string_view name) {
  return name.substr(std::min(name.find_first_not_of('-'), name.size()));
}

/// Whether the whole of `a` is the beginning of `b`, ignoring case.
bool begins(std::string_view a, std::string_view b) {
  return a.size() < b.size() && edit_distance(a, b.substr(0, a.size())) == 0;
}

/// Four times the edits between a name and a choice. The distance is 2 if the name is an
/// abbreviation (the beginning of the choice). It is 5 at most if the choice is the beginning of
/// the name and at least half of it. Names of options are compared without their dashes.
std::size_t name_distance(std::string_view name, std::string_view choice) {
  const std::string_view a = without_dashes(name), b = without_dashes(choice);
  if (a.size() > 1 && begins(a, b)) return 2;
  const std::size_t edits = 4 * edit_distance(a, b);
  return b.size() > 1 && 2 * b.size() >= a.size() && begins(b, a) ? std::min(edits, std::size_t{5})
                                                                  : edits;
}

/// The number of characters with which both begin, ignoring case.
std::size_t common_beginning(std::string_view a, std::string_view b) {
  const auto same = [](char x, char y) { return lower(x) == lower(y); };
  return static_cast<std::size_t>(
      std::mismatch(a.begin(), a.end(), b.begin(), b.end(), same).first - a.begin());
}

std::string located(std::string_view path, int line, std::string_view message) {
  std::string text(path);
  if (line > 0) text += ":" + std::to_string(line);
  return text.append(": ").append(message);
}

/// Returns the position of a name behind `before` in a message; npos if a long message is cut off
/// before the name's end.
std::size_t position_behind(std::string_view before, std::size_t offset, std::string_view name) {
  const std::size_t position = internal::one_line(before).size() + offset;
  const bool is_whole = position + name.size() <= internal::max_message_bytes;
  return is_whole ? position : std::string::npos;
}

/// Returns the first `bytes` bytes, fewer if they would end within a UTF-8 character.
std::string_view front(std::string_view text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  while (bytes > 0 && internal::continues_character(text[bytes])) --bytes;
  return text.substr(0, bytes);
}

}  // namespace

Error::Error(const std::string& message) : std::runtime_error(internal::one_line(message)) {}

Error::Error(std::string_view before, std::string_view argument, std::string_view after)
    : Error(std::string(before).append(argument).append(after)) {
  argument_ = argument;
  position_ = position_behind(before, 0, argument_);
}

Error Error::of(std::string_view argument, const std::string& message) {
  Error error(message);
  error.argument_ = argument;
  return error;
}

Error Error::behind(std::string_view text) const {
  Error error(std::string(text) + what());
  error.argument_ = argument_;
  if (names_argument()) error.position_ = position_behind(text, position_, argument_);
  return error;
}

std::string Error::message_for(std::string_view name) const {
  std::string message = what();
  if (!names_argument()) return std::string(name) + ": " + message;
  return message.replace(position_, argument_.size(), name);
}

FileError::FileError(std::string_view path, int line, std::string_view message)
    : Error(located(path, line, message)),
      path_(path),
      fault_(internal::one_line(message)),
      line_(line) {}

FileError FileError::behind(std::string_view text) const {
  return {path_, line_, std::string(text) + fault_};
}

const std::string* internal::nearest_name(std::string_view name,
                                          const std::vector<std::string>& choices) {
  const std::string_view shown = front(name, longest_compared);
  const std::string* nearest = nullptr;
  // A name that needs more edits than a third of its characters is another word.
  std::size_t least = 4 * ((without_dashes(shown).size() + 1) / 3) + 2, longest = 0;
  for (const std::string& choice : choices) {
    const std::size_t distance = name_distance(shown, choice);
    const std::size_t beginning = common_beginning(shown, choice);
    if (distance < least || (nearest != nullptr && distance == least && beginning > longest)) {
      least = distance;
      longest = beginning;
      nearest = &choice;
    }
  }
  return nearest;
}

Error unknown_name(std::string_view what, std::string_view name,
                   const std::vector<std::string>& choices, bool lists_choices) {
  std::string text =
      "unknown " + std::string(what) + " \"" + std::string(front(name, longest_compared)) + "\"";
  const std::string* const nearest = internal::nearest_name(name, choices);
  if (nearest != nullptr) text += "; did you mean \"" + *nearest + "\"?";
  if (lists_choices && !choices.empty()) text += " (known: " + listed(choices) + ")";
  return Error(text);
}

std::string listed(const std::vector<std::string>& choices) {
  constexpr std::size_t longest = 24;
  std::string text;
  for (std::size_t i = 0; i < std::min(choices.size(), longest); ++i) {
    text += (i == 0 ? "" : ", ") + choices[i];
  }
  if (choices.size() > longest)
    text += " and " + std::to_string(choices.size() - longest) + " more";
  return text;
}

std::string number(double value) {
  std::ostringstream text;  // libc++ 14 has no std::to_chars for double
  text.imbue(std::locale::classic());
  text << value + 0.0;  // -0 becomes 0
  return text.str();
}

std::string angle(double radians) {
  const double degrees = radians * 180 / std::numbers::pi;
  const std::string shown = number(radians) + " rad";
  return std::isfinite(degrees) || !std::isfinite(radians)
             ? shown + " (" + number(degrees) + " deg)"
             : shown;
}

}  // namespace beeline
