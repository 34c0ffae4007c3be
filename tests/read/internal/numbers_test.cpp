#include <bit>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>

#include <beeline/read/internal/numbers.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline::internal {
namespace {

TEST(Numbers, EveryFormIsRead) {
  EXPECT_EQ(parse_numbers("1,2,-3e-1", "q"), (std::vector<double>{1, 2, -0.3}));
  EXPECT_EQ(parse_numbers(" 1 ,\t+2.5 , .5,5.,+.25,-1E+2 ", "q"),
            (std::vector<double>{1, 2.5, 0.5, 5, 0.25, -100}));
  EXPECT_EQ(parse_number("0.1", "q"), 0.1);
}

TEST(Numbers, ExactTextReadsBackToTheLastBit) {
  testing::Random random;
  std::mt19937_64 bits(static_cast<std::uint64_t>(random.integer(0, 1 << 30)));
  int finite = 0;
  for (int i = 0; i < 200000; ++i) {
    const double value = std::bit_cast<double>(bits());
    if (!std::isfinite(value)) continue;
    ++finite;
    const std::string text = exact(value);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(parse_number(text, "q")),
              std::bit_cast<std::uint64_t>(value))
        << text;
    ASSERT_EQ(std::strtod(text.c_str(), nullptr), value) << text;
  }
  EXPECT_GT(finite, 190000);
}

TEST(Numbers, ExactTextIsShort) {
  EXPECT_EQ(exact(0.1), "0.1");
  EXPECT_EQ(exact(-3.5), "-3.5");
  EXPECT_EQ(exact(2), "2");
  EXPECT_EQ(exact(0), "0");
  EXPECT_TRUE(std::signbit(parse_number(exact(-0.0), "q")));
  EXPECT_EQ(parse_number(exact(std::numeric_limits<double>::denorm_min()), "q"),
            std::numeric_limits<double>::denorm_min());
}

TEST(Numbers, WhatIsNoNumberIsNamedWithItsPlace) {
  EXPECT_REFUSED(parse_numbers("1,x,3", "--q"), "--q: item 2: \"x\" is not a number");
  EXPECT_REFUSED(parse_numbers("1,2 3", "--q"), "item 2: \"2 3\" is not a number");
  EXPECT_REFUSED(parse_numbers("1,,3", "--q"), "item 2: a number is missing");
  EXPECT_REFUSED(parse_numbers("1,2,", "--q"), "item 3: a number is missing");
  EXPECT_REFUSED(parse_numbers("", "--q"), "item 1: a number is missing");
  for (const char* text : {"1e", "0x10", "1f", "--1", "+-1", "++1", "1,5 ", "e5", "1 2", "-", "+",
                           "1_000", "\xd9\xa1"}) {
    EXPECT_REFUSED(parse_number(text, "q"), "is not a number");
  }
}

TEST(Numbers, OnlyFiniteNumbersAreRead) {
  for (const char* text : {"nan", "NaN", "inf", "-inf", "+inf", "Infinity", "-nan"}) {
    EXPECT_REFUSED(parse_number(text, "q"), "must be finite");
  }
  EXPECT_REFUSED(parse_number("1e999", "q"), "\"1e999\" is out of the range of numbers");
  EXPECT_REFUSED(parse_number("1e-999", "q"), "out of the range");
}

TEST(Numbers, LocaleDoesNotMatter) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C"}) {
    if (std::setlocale(LC_ALL, name) == nullptr) continue;
    EXPECT_EQ(parse_number("1.5", "q"), 1.5);
    EXPECT_EQ(exact(1.5), "1.5");
  }
  std::setlocale(LC_ALL, before.c_str());
}

TEST(Numbers, DegreesBecomeRadians) {
  EXPECT_EQ(to_radians(180, AngleUnit::degrees), std::numbers::pi);
  EXPECT_EQ(to_radians(90, AngleUnit::degrees), std::numbers::pi / 2);
  EXPECT_EQ(to_radians(1.25, AngleUnit::radians), 1.25);
}

}  // namespace
}  // namespace beeline::internal
