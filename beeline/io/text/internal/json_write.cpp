#include <beeline/error.h>
#include <beeline/io/text/internal/json_write.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/numbers.h>

namespace beeline::internal {
namespace {

/// RFC 8259, section 7: quotation mark, backslash and control characters must be escaped.
std::string escaped(char c) {
  constexpr std::string_view special = "\"\\\b\f\n\r\t", letters = "\"\\bfnrt";
  const std::size_t found = special.find(c);
  if (found != std::string_view::npos) return {'\\', letters[found]};
  const auto byte = static_cast<unsigned char>(c);
  if (byte >= 0x20) return {c};
  return {'\\', 'u', '0', '0', "01"[byte / 16], "0123456789abcdef"[byte % 16]};
}

}  // namespace

std::string json_string(std::string_view text) {
  if (!is_utf8(text)) throw Error(in_quotes(text) + " is not UTF-8 text; JSON cannot hold it");
  std::string quoted = "\"";
  for (const char c : text) quoted += escaped(c);
  return quoted + '"';
}

std::string json_numbers(const double* values, std::size_t count) {
  std::string text = "[";
  for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "" : ", ") + exact(values[i]);
  return text + "]";
}

}  // namespace beeline::internal
