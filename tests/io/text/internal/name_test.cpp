#include <gtest/gtest.h>

#include <beeline/io/text/internal/name.h>

#include <tests/refusal.h>

namespace beeline::internal {
namespace {

TEST(Name, TextIsPrintableWhateverItHolds) {
  EXPECT_EQ(printable("panda"), "panda");
  EXPECT_EQ(printable("gr\xc3\xbc\xc3\x9f"), "gr\xc3\xbc\xc3\x9f");
  EXPECT_EQ(printable("a\nb\x01\x7f"), "a?b??");
  EXPECT_EQ(printable("a\xff\xc3"), "a??");
  EXPECT_EQ(in_quotes("x"), "\"x\"");
  const std::string cut = printable(std::string(1000, 'x'));
  EXPECT_LT(cut.size(), 100u);
  EXPECT_TRUE(cut.ends_with("..."));
}

TEST(Name, NamesAreCleanText) {
  for (const char* name : {"a", "joint 1", "\xe6\xa9\x9f", "\xf0\x9f\xa4\x96", "a,b\"c"}) {
    EXPECT_NO_THROW(check_name(name, "it")) << name;
  }
  EXPECT_REFUSED(check_name("", "the name"), "the name is empty");
  EXPECT_REFUSED(check_name("a\tb", "the name"), "contains a control character");
  EXPECT_REFUSED(check_name(std::string(1001, 'a'), "the name"), "longer than 1000 bytes");
}

TEST(Name, BrokenUtf8IsRefused) {
  for (const char* name :
       {"\xff", "\x80", "\xc3", "\xc0\x80", "\xe0\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80",
        "\xf0\x80\x80\x80", "\xf5\x80\x80\x80", "\xe6\xa9", "\xe6\xa9z"}) {
    EXPECT_REFUSED(check_name(name, "it"), "is not UTF-8 text");
  }
}

}  // namespace
}  // namespace beeline::internal
