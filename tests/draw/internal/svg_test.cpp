#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include <beeline/draw/internal/paper_shapes.h>
#include <beeline/draw/internal/svg.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline::internal {
namespace {

TEST(Svg, WritesNumbersToHundredths) {
  EXPECT_EQ(svg_number(0), "0");
  EXPECT_EQ(svg_number(-0.004), "0");
  EXPECT_EQ(svg_number(12.5), "12.5");
  EXPECT_EQ(svg_number(-0.25), "-.25");
  EXPECT_EQ(svg_number(0.05), ".05");
  EXPECT_EQ(svg_number(-1200), "-1200");
  testing::Random random;
  for (int trial = 0; trial < 10000; ++trial) {
    const double value = random.uniform(-1, 1) * std::pow(10, random.uniform(-3, 6));
    EXPECT_NEAR(std::stod(svg_number(value)), value, 0.005 + 1e-9);
  }
}

TEST(Svg, RefusesCoordinatesThatAreNoNumbers) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -1e10}) {
    EXPECT_REFUSED(svg_number(bad), "finite");
    Picture picture{10, 10, {line_stroke({0, 0}, {bad, 1}, ink, 1)}};
    EXPECT_REFUSED(svg_of(picture), "finite");
    picture.marks = {PaperText{"a", {0, bad}}};
    EXPECT_REFUSED(svg_of(picture), "finite");
  }
}

TEST(Svg, WritesEveryVerb) {
  PaperPath path;
  path.move({1, 2});
  path.line({3, 4});
  path.curve({1, 1}, {2, 2}, {3, 3.5});
  path.close();
  EXPECT_EQ(path_data(path), "M1 2L3 4C1 1 2 2 3 3.5Z");
}

TEST(Svg, DashesHaveButtCapsAndOpacityIsKept) {
  const std::string dashed =
      svg_element(line_stroke({0, 0}, {9, 0}, {1, 0, 0, 0.5}, 0.8, {4, 2.5}));
  EXPECT_NE(dashed.find("stroke-dasharray=\"4 2.5\" stroke-linecap=\"butt\""), std::string::npos);
  EXPECT_NE(dashed.find("stroke=\"#ff0000\" stroke-opacity=\".5\""), std::string::npos);
  const std::string filled =
      svg_element(PaperStroke{ellipse({0, 0}, {1, 0}, {0, 1}), ink, no_colour, 0, {}});
  EXPECT_EQ(filled.find("stroke"), std::string::npos);
  EXPECT_NE(filled.find("fill=\"#"), std::string::npos);
}

TEST(Svg, HoldsNoMarkupFromTexts) {
  const std::string text = svg_element(PaperText{"</text><script a=\"1\">&\x01\x7f\xff", {5, 5}});
  EXPECT_NE(text.find("&lt;/text&gt;&lt;script a=&quot;1&quot;&gt;&amp;???"), std::string::npos);
}

}  // namespace
}  // namespace beeline::internal
