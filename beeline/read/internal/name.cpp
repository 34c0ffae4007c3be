#include <beeline/error.h>
#include <beeline/model/arm.h>
#include <beeline/read/internal/name.h>

namespace beeline::internal {
namespace {

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte == 0x7f;
}

/// Returns the number of bytes of the UTF-8 character at the front of `text`; 0 if there is none.
/// Unicode 15, table 3-7: no overlong forms, no surrogates, nothing beyond U+10FFFF.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  if ((first == 0xe0 && byte(1) < 0xa0) || (first == 0xed && byte(1) > 0x9f)) return 0;
  if ((first == 0xf0 && byte(1) < 0x90) || (first == 0xf4 && byte(1) > 0x8f)) return 0;
  return length;
}

}  // namespace

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
