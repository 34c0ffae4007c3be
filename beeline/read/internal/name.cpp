#include <algorithm>

#include <beeline/error.h>
#include <beeline/internal/utf8.h>
#include <beeline/model/arm.h>
#include <beeline/read/internal/name.h>

namespace beeline::internal {

std::string shell_word(std::string_view text) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:+@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string_view::npos) {
    return std::string(text);
  }
  std::string word = "'";
  for (const char letter : text) word += letter == '\'' ? "'\\''" : std::string(1, letter);
  return word + "'";
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string printable(std::string_view text) {
  constexpr std::size_t max_shown = 80;
  std::string shown;
  while (!text.empty() && shown.size() < max_shown) {
    const std::size_t length = utf8_length(text);
    if (length == 0 || is_control(text[0])) {
      shown += '?';
    } else {
      shown += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return text.empty() ? shown : shown + "...";
}

std::string in_quotes(std::string_view text) { return '"' + printable(text) + '"'; }

std::string with_escaped_bytes(std::string_view text) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string escaped;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) {
      const auto byte = static_cast<unsigned char>(text[0]);
      escaped += "\\x";
      escaped += {digits[byte / 16], digits[byte % 16]};
    } else {
      escaped += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return escaped;
}

NameFault name_fault(std::string_view name) {
  constexpr std::size_t max_length = 1000;
  if (name.empty()) return NameFault::empty;
  if (name.size() > max_length) return NameFault::too_long;
  if (!is_utf8(name)) return NameFault::not_utf8;
  const bool controls = std::any_of(name.begin(), name.end(), [](char c) { return is_control(c); });
  return controls ? NameFault::control_character : NameFault::none;
}

std::string clause(NameFault fault, std::string_view name) {
  switch (fault) {
    case NameFault::empty:
      return "is empty";
    case NameFault::too_long:
      return in_quotes(name) + " is longer than 1000 bytes";
    case NameFault::not_utf8:
      return in_quotes(name) + " is not UTF-8 text";
    case NameFault::control_character:
      return in_quotes(name) + " contains a control character";
    case NameFault::none:
      break;
  }
  return in_quotes(name) + " is a name";
}

void check_name(std::string_view name, std::string_view what) {
  const NameFault fault = name_fault(name);
  if (fault != NameFault::none) throw Error(std::string(what) + " " + clause(fault, name));
}

void check_names(const Arm& arm) {
  check_name(arm.name(), "the arm's name");
  for (const Joint& joint : arm.joints()) {
    check_name(joint.name, "a joint's name");
    if (!joint.link.empty()) check_name(joint.link, "a link's name");
  }
}

}  // namespace beeline::internal
