#include <beeline/internal/utf8.h>

namespace beeline::internal {

std::size_t utf8_length(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if (!continues_character(text[i])) return 0;
  }
  if ((first == 0xe0 && byte(1) < 0xa0) || (first == 0xed && byte(1) > 0x9f)) return 0;
  if ((first == 0xf0 && byte(1) < 0x90) || (first == 0xf4 && byte(1) > 0x8f)) return 0;
  return length;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    if (!take_character(text).valid) return false;
  }
  return true;
}

char32_t Utf8Character::code() const {
  char32_t code = static_cast<unsigned char>(bytes.front());
  if (bytes.size() > 1) code &= 0xffu >> (bytes.size() + 1);
  for (const char byte : bytes.substr(1))
    code = code << 6 | (static_cast<unsigned char>(byte) & 0x3fu);
  return code;
}

Utf8Character take_character(std::string_view& text) {
  const std::size_t length = utf8_length(text);
  const Utf8Character character{text.substr(0, length == 0 ? 1 : length), length > 0};
  text.remove_prefix(character.bytes.size());
  return character;
}

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte == 0x7f;
}

std::string one_line(std::string_view text, std::size_t max_bytes) {
  std::string line;
  while (!text.empty() && line.size() < max_bytes) {
    const auto [bytes, valid] = take_character(text);
    line += !valid ? "?" : is_control(bytes.front()) ? " " : bytes;
  }
  return text.empty() ? line : line + "...";
}

}  // namespace beeline::internal
