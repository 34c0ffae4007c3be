#include <cmath>

#include <beeline/error.h>
#include <beeline/internal/utf8.h>
#include <beeline/io/text/internal/json_write.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/json.h>
#include <beeline/io/text/numbers.h>

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

/// The text as a JSON string, in quotes.
std::string string_literal(std::string_view text) {
  std::string quoted = "\"";
  while (!text.empty()) {
    const auto [bytes, valid] = take_character(text);
    quoted += !valid              ? "\xef\xbf\xbd"
              : bytes.size() == 1 ? escaped(bytes.front())
                                  : std::string(bytes);
  }
  return quoted + '"';
}

std::string scalar_text(std::nullptr_t) { return "null"; }
std::string scalar_text(bool truth) { return truth ? "true" : "false"; }
std::string scalar_text(std::int64_t number) { return std::to_string(number); }
std::string scalar_text(double number) {
  if (!std::isfinite(number)) return "null";
  const std::string digits = exact(number);
  return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
}
std::string scalar_text(const std::string& text) { return string_literal(text); }

/// Appends a list or an object, each item on a line of its own.
template <class Items, class Write>
void write_items(const Items& items, const char* brackets, const std::string& line,
                 std::string& text, const Write& write) {
  text += brackets[0];
  for (const auto& item : items) {
    text += (&item == &items.front() ? "" : ",") + line + "  ";
    write(item);
  }
  text += (items.empty() ? "" : line) + brackets[1];
}

/// Appends a value whose lines begin with `line`, a line break and blanks.
void write_json(const Json& json, const std::string& line, std::string& text) {
  if (const auto* items = std::get_if<Json::Items>(&json.value)) {
    write_items(*items, "[]", line, text,
                [&](const Json& item) { write_json(item, line + "  ", text); });
  } else if (const auto* members = std::get_if<Json::Members>(&json.value)) {
    write_items(*members, "{}", line, text, [&](const Json::Member& member) {
      text += string_literal(member.key) + ": ";
      write_json(member.value, line + "  ", text);
    });
  } else {
    std::visit(
        [&text](const auto& value) {
          if constexpr (requires { scalar_text(value); }) text += scalar_text(value);
        },
        json.value);
  }
}

}  // namespace

std::string json_string(std::string_view text) {
  if (!is_utf8(text)) throw Error(in_quotes(text) + " is not UTF-8 text; JSON cannot hold it");
  return string_literal(text);
}

std::string json_numbers(const double* values, std::size_t count) {
  std::string text = "[";
  for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "" : ", ") + exact(values[i]);
  return text + "]";
}

}  // namespace beeline::internal

std::string beeline::Json::text() const {
  std::string text;
  internal::write_json(*this, "\n", text);
  return text;
}
