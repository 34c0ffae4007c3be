#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include <beeline/draw/internal/text.h>
#include <beeline/draw/internal/text_width.h>

#ifdef BEELINE_CAIRO
#include <cairo.h>
#endif

namespace beeline::internal {
namespace {

#ifdef BEELINE_CAIRO
/// The advance width that Cairo measures, in units of the font size.
double measured(const std::string& text, bool bold) {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
  cairo_t* context = cairo_create(surface);
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context, options);
  cairo_font_options_destroy(options);
  cairo_select_font_face(context, typeface, CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, 100);
  cairo_text_extents_t extents;
  cairo_text_extents(context, text.c_str(), &extents);
  cairo_destroy(context);
  cairo_surface_destroy(surface);
  return extents.x_advance / 100;
}

TEST(TextWidth, IsAboutThatOfTheFont) {
  for (const bool bold : {false, true}) {
    for (const char* text : {"The quick brown fox jumps over the lazy dog", "{0} 3.5, −68.8°",
                             "θ₁ = 112°, θ₂ = −52°", "0123456789+-=()[]/%#@&<>\"'", "äöüßéñçøåŁŚŽ",
                             "ΑΒΓΔΩαβγδω", "Привет", "10⁻⁶ µm × 2 → 3 ≤ 4", "…–—“”‘’•"}) {
      const double ratio = text_width(text, 1, bold) / measured(text, bold);
      EXPECT_GT(ratio, 0.95) << text << bold;
      EXPECT_LT(ratio, 1.15) << text << bold;
    }
  }
}
#endif

TEST(TextWidth, IsProportionalAndAdditive) {
  EXPECT_EQ(text_width("", 9, false), 0);
  EXPECT_DOUBLE_EQ(text_width("abc", 18, true), 2 * text_width("abc", 9, true));
  EXPECT_DOUBLE_EQ(
      text_width("aθ≤", 1, false),
      text_width("a", 1, false) + text_width("θ", 1, false) + text_width("≤", 1, false));
  EXPECT_DOUBLE_EQ(text_width("漢字", 1, false), 2);                             // full width
  EXPECT_DOUBLE_EQ(text_width("e\u0301", 1, false), text_width("e", 1, false));  // an accent
  EXPECT_GT(text_width("\U0010FFFD", 1, false), 0);
  for (const char* broken : {"\xff", "a\xe2\x82", "\xf0", "\x80\x80"}) {  // no UTF-8
    EXPECT_TRUE(std::isfinite(text_size(broken, 9).x()));
  }
}

}  // namespace
}  // namespace beeline::internal
