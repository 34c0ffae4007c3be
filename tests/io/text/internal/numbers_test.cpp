#include <bit>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/numbers.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline::internal {
namespace {

TEST(Numbers, EveryFormIsRead) {
  EXPECT_EQ(parse_numbers("1,2,-3e-1", "q"), (std::vector<double>{1, 2, -0.3}));
  EXPECT_EQ(parse_numbers("[1, 2,-3e-1]", "q"), (std::vector<double>{1, 2, -0.3}));
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

TEST(Numbers, OtherTextIsRefusedWithItsItem) {
  EXPECT_REFUSED(parse_numbers("1,x,3", "--q"), "--q: item 2: \"x\" is not a number");
  EXPECT_REFUSED(parse_numbers("1,2 3", "--q"), "item 2: \"2 3\" is not a number");
  EXPECT_REFUSED(parse_numbers("[1,2", "--q"), "item 1: \"[1\" is not a number");
  EXPECT_REFUSED(parse_numbers("[]", "--q"), "item 1: a number is missing");
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

TEST(Numbers, ScansTheFrontOfAText) {
  double value = 0;
  const std::string_view text = "-2.5e1,3";
  const auto [end, fault] = parse_double(text.data(), text.data() + text.size(), value);
  EXPECT_EQ(fault, std::errc());
  EXPECT_EQ(value, -25);
  EXPECT_EQ(*end, ',');
  const auto fault_of = [&](std::string_view given) {
    return parse_double(given.data(), given.data() + given.size(), value).ec;
  };
  for (const char* zero : {"0", "-0.000", "0e-999", "0.0e999"}) {
    EXPECT_EQ(fault_of(zero), std::errc()) << zero;
    EXPECT_EQ(value, 0) << zero;
  }
  for (const char* far : {"1e999", "-1e309", "1e-999", "0.001e-400"}) {
    EXPECT_EQ(fault_of(far), std::errc::result_out_of_range) << far;
  }
  for (const char* none : {"", "+1", " 1", "e5", "-"}) {
    EXPECT_EQ(fault_of(none), std::errc::invalid_argument) << none;
  }
}

TEST(Numbers, AreWrittenWithinTheirLength) {
  char text[max_number_length + 1];
  for (const double value : {-std::numeric_limits<double>::min(), -0.00012345678901234567,
                             -1234567890123456.7, -std::numeric_limits<double>::max()}) {
    EXPECT_LE(static_cast<std::size_t>(write_double(text, value) - text), max_number_length)
        << value;
  }
  for (const double value : {std::nan(""), -std::nan("")}) {
    EXPECT_EQ(std::string(text, write_double(text, value)), "nan");
  }
}

TEST(Numbers, AreRoundedToDigits) {
  EXPECT_EQ(fixed_point(-1.005, 1), "-1.0");
  EXPECT_EQ(fixed_point(1e20, 0), "100000000000000000000");
  EXPECT_EQ(rounded(1.5707963267948966, 4), 1.571);
  EXPECT_FALSE(std::signbit(rounded(-0.0, 4)));
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    const double value = random.uniform(-1, 1) * std::pow(10, random.integer(-300, 300));
    EXPECT_EQ(rounded(value, 17), value);
    EXPECT_NEAR(rounded(value, 6), value, 5e-6 * std::abs(value));
  }
}

}  // namespace
}  // namespace beeline::internal
