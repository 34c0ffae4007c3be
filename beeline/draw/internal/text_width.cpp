#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>

#include <beeline/draw/internal/text_width.h>
#include <beeline/internal/utf8.h>

namespace beeline::internal {
namespace {

/// The advance widths of DejaVu Sans 2.37 for Basic Latin from the blank on, in 1/2048 of the font
/// size.
constexpr std::array<std::uint16_t, 95> basic_latin{
    651,  821,  942,  1716, 1303, 1946, 1597, 563,  799,  799,  1024, 1716, 651,  739,  651,  690,
    1303, 1303, 1303, 1303, 1303, 1303, 1303, 1303, 1303, 1303, 690,  690,  1716, 1716, 1716, 1087,
    2048, 1401, 1405, 1430, 1577, 1294, 1178, 1587, 1540, 604,  604,  1343, 1141, 1767, 1532, 1612,
    1235, 1612, 1423, 1300, 1251, 1499, 1401, 2025, 1403, 1251, 1403, 799,  690,  799,  1716, 1024,
    1024, 1255, 1300, 1126, 1300, 1260, 721,  1300, 1298, 569,  569,  1186, 569,  1995, 1298, 1253,
    1300, 1300, 842,  1067, 803,  1298, 1212, 1675, 1212, 1212, 1075, 1303, 690,  1303, 1716};

/// Characters of one width, in units of the font size. It is the width of most of them, or a little
/// more, so that texts that contain them do not overlap.
struct CharacterRange {
  char32_t first, last;
  double width;
};
constexpr CharacterRange ranges[] = {{0xA0, 0x17F, 0.63},     // Latin-1, Latin Extended-A
                                     {0x300, 0x36F, 0},       // accents of the character before
                                     {0x370, 0x3FF, 0.64},    // Greek
                                     {0x400, 0x52F, 0.7},     // Cyrillic
                                     {0x1100, 0x115F, 1},     // Hangul
                                     {0x200B, 0x200F, 0},     // marks without width
                                     {0x2010, 0x203A, 0.6},   // punctuation
                                     {0x2070, 0x209C, 0.41},  // superscripts and subscripts
                                     {0x2190, 0x22FF, 0.84},  // arrows, mathematical operators
                                     {0x2E80, 0xA4CF, 1},     // Chinese, Japanese
                                     {0xAC00, 0xD7A3, 1},     // Hangul
                                     {0xF900, 0xFAFF, 1},     // Chinese
                                     {0xFE00, 0xFE0F, 0},     // variants of the character before
                                     {0xFE30, 0xFE6F, 1},     // Chinese punctuation
                                     {0xFF00, 0xFF60, 1},     // full-width Latin
                                     {0x1F300, 0x1FAFF, 1},   // pictures
                                     {0x20000, 0x3FFFD, 1}};  // Chinese

/// Returns the advance width of a regular character, in units of the font size.
double advance(char32_t character) {
  if (character >= 0x20 && character <= 0x7E) return basic_latin[character - 0x20] / 2048.0;
  const auto* const range =
      std::find_if(std::begin(ranges), std::end(ranges),
                   [character](const CharacterRange& each) { return character <= each.last; });
  return range != std::end(ranges) && character >= range->first ? range->width : 0.7;
}

}  // namespace

double text_width(std::string_view text, double size, bool bold) {
  double width = 0;
  while (!text.empty()) width += advance(take_character(text).code());
  constexpr double bold_width = 1.13;  // ratio to the regular width, on average
  return width * size * (bold ? bold_width : 1);
}

}  // namespace beeline::internal
