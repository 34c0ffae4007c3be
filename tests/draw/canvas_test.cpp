#include <gtest/gtest.h>

#include <beeline/draw/arm_figure.h>
#include <beeline/draw/figure.h>
#include <beeline/model/catalog.h>

#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline {
namespace {

constexpr Format formats[] = {Format::svg, Format::png, Format::pdf};

/// A big-endian number of four bytes, as PNG writes sizes.
int big_endian(const std::string& bytes, std::size_t at) {
  int value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value * 256 + static_cast<unsigned char>(bytes[at + i]);
  return value;
}

TEST(Canvas, WritesEveryFormat) {
  for (const std::string& number : chapter_figures()) {
    const Picture picture = compose(chapter_figure(number));
    const std::string svg = render(picture, Format::svg);
    EXPECT_EQ(svg.rfind("<?xml", 0), 0u);
    EXPECT_NE(svg.find("<svg "), std::string::npos);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
    const std::string png = render(picture, Format::png);
    EXPECT_EQ(png.rfind("\x89PNG\r\n\x1a\n", 0), 0u);
    EXPECT_NEAR(big_endian(png, 16), 2.5 * picture.width, 1);  // 180 pixels an inch
    EXPECT_NEAR(big_endian(png, 20), 2.5 * picture.height, 1);
    const std::string pdf = render(picture, Format::pdf);
    EXPECT_EQ(pdf.rfind("%PDF-", 0), 0u);
    EXPECT_NE(pdf.find("%%EOF"), std::string::npos);
  }
}

TEST(Canvas, WritesTheSameBytesTwice) {
  const Figure figure = arm_figure(built_in("panda"), middle_configuration(built_in("panda")));
  for (const Format format : formats) {
    const std::string first = render(figure, format);
    EXPECT_GT(first.size(), 1000u);
    EXPECT_TRUE(first == render(figure, format));
  }
}

TEST(Canvas, TellsTheFormatByTheExtension) {
  EXPECT_EQ(format_of("a.svg"), Format::svg);
  EXPECT_EQ(format_of("dir.pdf/a.PNG"), Format::png);
  EXPECT_EQ(format_of("a.b.pdf"), Format::pdf);
  for (const char* path : {"a.jpg", "a", "svg", "dir.svg/a", ""}) {
    EXPECT_REFUSED(format_of(path), ".svg, .png or .pdf");
  }
}

TEST(Canvas, SavesWholeFilesOnly) {
  const testing::TemporaryFolder folder;
  const Figure figure = chapter_figure("1.6");
  save(figure, folder.file("arm.svg"));
  EXPECT_TRUE(folder.content("arm.svg") == render(figure, Format::svg));
  EXPECT_EQ(folder.count(), 1u);
  EXPECT_REFUSED(save(figure, folder.file("arm.gif")), "arm.gif");
  EXPECT_REFUSED(save(figure, folder.file("missing/arm.svg")), "missing");
  EXPECT_EQ(folder.count(), 1u);
}

}  // namespace
}  // namespace beeline
