#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/draw/internal/text.h>
#include <beeline/draw/internal/text_width.h>
#include <beeline/internal/utf8.h>
#include <beeline/io/text/internal/numbers.h>

namespace beeline::internal {
namespace {

/// Returns the bytes of the printable UTF-8 character at the start of `text`; 0 when there is none.
std::size_t character_length(std::string_view text) {
  const std::size_t length = utf8_length(text);
  const bool control = is_control(text[0]) || (length == 2 && text < "\xC2\xA0");
  const bool none = text.starts_with("\xEF\xBF\xBE") || text.starts_with("\xEF\xBF\xBF");
  return control || none ? 0 : length;
}

/// Returns the part of `word` that fits, with an ellipsis when it is cut.
std::string cut(const std::string& word, double size, double width, bool bold) {
  constexpr std::size_t max_bytes = 400;  // no line on paper is longer
  std::string kept = word;
  bool whole = true;
  if (kept.size() > max_bytes) {
    kept.resize(max_bytes);
    whole = false;
  }
  while (!kept.empty() && text_size(whole ? kept : kept + "…", size, bold).x() > width) {
    whole = false;
    while (!kept.empty() && continues_character(kept.back())) kept.pop_back();
    if (!kept.empty()) kept.pop_back();
  }
  return whole ? kept : kept + "…";
}

}  // namespace

PaperPoint text_size(const std::string& text, double size, bool bold) {
  return {text_width(drawable(text), size, bold), 1.2 * size};
}

std::string drawable(std::string_view text) {
  std::string clean;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text.substr(i));
    clean += length == 0 ? "?" : text.substr(i, length);
    i += std::max<std::size_t>(length, 1);
  }
  return clean;
}

std::vector<std::string> wrapped(const std::string& text, double size, double width, bool bold) {
  constexpr std::size_t max_lines = 12;
  std::vector<std::string> lines(1);
  for (std::size_t i = 0; i < text.size();) {
    if (lines.size() > max_lines) {
      lines.pop_back();
      lines.back() += "…";
      break;
    }
    if (text[i] == '\n') lines.emplace_back();
    if (text[i] == '\n' || text[i] == ' ') {
      ++i;
      continue;
    }
    const std::size_t end = std::min(text.find_first_of(" \n", i), text.size());
    const std::string word = cut(text.substr(i, end - i), size, width, bold);
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (lines.back().empty() || text_size(longer, size, bold).x() <= width) {
      lines.back() = longer;
    } else {
      lines.push_back(word);
    }
    i = end;
  }
  if (lines.size() == 1 && lines.front().empty()) lines.clear();
  return lines;
}

std::vector<std::string> balanced(const std::string& text, double size, double width, bool bold) {
  std::vector<std::string> lines = wrapped(text, size, width, bold);
  double low = 0, high = width;
  while (lines.size() > 1 && high - low > 0.5) {
    const double middle = (low + high) / 2;
    std::vector<std::string> narrower = wrapped(text, size, middle, bold);
    const bool cut_off = std::any_of(narrower.begin(), narrower.end(),
                                     [](const auto& line) { return line.ends_with("…"); });
    if (narrower.size() == lines.size() && !cut_off) {
      lines = std::move(narrower);
      high = middle;
    } else {
      low = middle;
    }
  }
  return lines;
}

std::string cut_to(const std::string& text, double size, double width, bool bold) {
  const std::vector<std::string> lines = wrapped(text, size, width, bold);
  if (lines.empty()) return "";
  return lines.size() == 1 ? lines.front() : lines.front() + "…";
}

std::string fixed(double value, int decimals) {
  const std::string text = fixed_point(value, decimals);
  if (text.front() != '-') return text;
  const bool zero = text.find_first_of("123456789") == std::string::npos;
  return (zero ? "" : "−") + text.substr(1);
}

std::string degrees_text(double radians) {
  const double degrees = radians * 180 / std::numbers::pi;
  const bool whole = std::abs(degrees - std::round(degrees)) < 0.05;
  return fixed(degrees, whole ? 0 : 1) + "°";
}

std::string subscript(int number) {
  std::string text;
  for (const char digit : std::to_string(number)) {
    text += "\xE2\x82";
    text += static_cast<char>(0x80 + (digit - '0'));
  }
  return text;
}

std::string superscript(int number) {
  const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char digit : std::to_string(number)) text += digit == '-' ? "⁻" : digits[digit - '0'];
  return text;
}

}  // namespace beeline::internal
