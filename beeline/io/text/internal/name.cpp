#include <algorithm>

#include <beeline/error.h>
#include <beeline/internal/utf8.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/text_fault.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

std::string printable(std::string_view text) {
  constexpr std::size_t max_shown = 80;
  std::string shown;
  while (!text.empty() && shown.size() < max_shown) {
    const auto [bytes, valid] = take_character(text);
    shown += valid && !is_control(bytes.front()) ? bytes : "?";
  }
  return text.empty() ? shown : shown + "...";
}

std::string in_quotes(std::string_view text) { return '"' + printable(text) + '"'; }

std::string with_escaped_bytes(std::string_view text) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string escaped;
  while (!text.empty()) {
    const auto [bytes, valid] = take_character(text);
    if (valid) {
      escaped += bytes;
    } else {
      const auto byte = static_cast<unsigned char>(bytes.front());
      escaped += "\\x";
      escaped += {digits[byte / 16], digits[byte % 16]};
    }
  }
  return escaped;
}

ElementFault name_fault(std::string_view name) {
  constexpr std::size_t max_length = 1000;
  if (name.empty()) return ElementFault::empty_name;
  if (name.size() > max_length) return ElementFault::long_name;
  if (!is_utf8(name)) return ElementFault::not_utf8;
  const bool controls = std::any_of(name.begin(), name.end(), [](char c) { return is_control(c); });
  return controls ? ElementFault::control_character : ElementFault::none;
}

void check_name(std::string_view name, std::string_view what) {
  const ElementFault fault = name_fault(name);
  if (fault != ElementFault::none) throw Error(std::string(what) + " " + clause(fault, name));
}

std::string recommended(const std::string& option, const std::string& value) {
  return option + "=" + in_quotes(value) + " (--" + option + " " + shell_word(value) + ")";
}

}  // namespace beeline::internal

void beeline::check_names(const Arm& arm) {
  internal::check_name(arm.name(), "the arm's name");
  for (const Joint& joint : arm.joints()) {
    internal::check_name(joint.name, "a joint's name");
    if (!joint.link.empty()) internal::check_name(joint.link, "a link's name");
  }
}
