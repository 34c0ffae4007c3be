#pragma once

#include <string>
#include <string_view>

namespace beeline::internal {

/// Returns the number of bytes of the UTF-8 character at the front of `text`, which is not empty; 0
/// if there is none. Unicode 15, table 3-7: no overlong forms, no surrogates, nothing beyond
/// U+10FFFF.
std::size_t utf8_length(std::string_view text);

bool is_utf8(std::string_view text);

/// A character of a text. If it is not valid UTF-8, it is one byte.
struct Utf8Character {
  std::string_view bytes;
  bool valid = false;

  char32_t code() const;  ///< code point of a valid character
};

/// Removes the first character from `text`, which is not empty, and returns it.
Utf8Character take_character(std::string_view& text);

/// Whether a byte of valid UTF-8 text is not the first of its character.
constexpr bool continues_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

/// Whether a byte is an ASCII control character.
bool is_control(char c);

/// The length of a message of an error, at about which it is cut off.
inline constexpr std::size_t max_message_bytes = 900;

/// Returns `text` as one line of UTF-8 of about `max_bytes` at most: a control character becomes a
/// space, a byte that is not UTF-8 a question mark, and what is cut off `...`.
std::string one_line(std::string_view text, std::size_t max_bytes = max_message_bytes);

}  // namespace beeline::internal
