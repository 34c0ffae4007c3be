#include <beeline/error.h>
#include <beeline/internal/utf8.h>
#include <beeline/model/arm.h>
#include <beeline/read/internal/name.h>

namespace beeline::internal {

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

void check_name(std::string_view name, std::string_view what) {
  constexpr std::size_t max_length = 1000;
  const auto refuse = [&](const std::string& why) { throw Error(std::string(what) + " " + why); };
  if (name.empty()) refuse("is empty");
  if (name.size() > max_length) refuse(in_quotes(name) + " is longer than 1000 bytes");
  if (!is_utf8(name)) refuse(in_quotes(name) + " is not UTF-8 text");
  for (const char c : name) {
    if (is_control(c)) refuse(in_quotes(name) + " contains a control character");
  }
}

void check_names(const Arm& arm) {
  check_name(arm.name(), "the arm's name");
  for (const Joint& joint : arm.joints()) {
    check_name(joint.name, "a joint's name");
    if (!joint.link.empty()) check_name(joint.link, "a link's name");
  }
}

}  // namespace beeline::internal
