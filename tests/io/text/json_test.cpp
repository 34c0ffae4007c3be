#include <cmath>
#include <gtest/gtest.h>

#include <beeline/io/text/internal/json_write.h>
#include <beeline/io/text/json.h>
#include <beeline/io/text/numbers.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline::internal {
namespace {

JsonDocument parse(std::string_view text) { return {text, "a.json"}; }

TEST(Json, ValuesKeepTheirKindsAndLines) {
  const JsonDocument document = parse(
      "{\"a\": [1,\n -2.5e1\n],\n\"b\": {\"c\": \"t\\u00e4xt\", \"d\": true,\n\"e\": null}}\n");
  const Json& root = document.root();
  const Json::Items& a = document.items(document.need(root, "a"));
  EXPECT_EQ(document.number(a.at(0)), 1);
  EXPECT_EQ(a.at(0).line, 1);
  EXPECT_EQ(document.number(a.at(1)), -25);
  EXPECT_EQ(a.at(1).line, 2);
  const Json& b = document.need(root, "b");
  EXPECT_EQ(b.line, 4);
  EXPECT_EQ(document.text(document.need(b, "c")), "t\xc3\xa4xt");
  EXPECT_TRUE(std::get<bool>(document.need(b, "d").value));
  EXPECT_EQ(document.need(b, "e").line, 5);
  EXPECT_EQ(document.find(b, "f"), nullptr);
}

TEST(Json, NumbersReadBackExactly) {
  testing::Random random;
  for (int i = 0; i < 20000; ++i) {
    const double value = random.uniform(-1, 1) * std::pow(10, random.integer(-300, 300));
    const JsonDocument document = parse(json_numbers(&value, 1));
    ASSERT_EQ(document.numbers(document.root(), 1).at(0), value) << exact(value);
  }
  const double zero = -0.0;
  const JsonDocument document = parse(json_numbers(&zero, 1));
  EXPECT_TRUE(std::signbit(document.numbers(document.root(), 1).at(0)));
}

TEST(Json, AnyTextReadsBack) {
  for (const std::string& text :
       {std::string("a"), std::string("\"\\/\b\n\t"), std::string("\0x", 2),
        std::string("gr\xc3\xbc\xc3\x9f \xf0\x9f\xa4\x96")}) {
    const JsonDocument document = parse(json_string(text));
    EXPECT_EQ(document.text(document.root()), text);
  }
  EXPECT_REFUSED(json_string("a\xff"), "\"a?\" is not UTF-8 text");
}

TEST(Json, ErrorsNameLineAndPath) {
  const JsonDocument document = parse("{\"joints\": [{}, {\n\"limits\": {\"lower\": \"x\"}}]}");
  const Json& joint = document.items(document.need(document.root(), "joints")).at(1);
  const Json& limits = document.need(joint, "limits");
  const Json& lower = document.need(limits, "lower");
  EXPECT_REFUSED(document.number(lower),
                 "a.json:2: joints[1].limits.lower must be a number, not text");
  EXPECT_REFUSED(document.items(lower), "joints[1].limits.lower must be a list, not text");
  EXPECT_REFUSED(document.members(lower), "must be an object, not text");
  EXPECT_REFUSED(document.text(limits), "joints[1].limits must be text, not an object");
  EXPECT_REFUSED(document.need(limits, "upper"), "joints[1].limits needs the key \"upper\"");
  EXPECT_REFUSED(document.numbers(document.need(document.root(), "joints"), 3),
                 "joints must be a list of 3 numbers; it has 2");
  EXPECT_REFUSED(document.text(document.root()), "a.json:1: the document must be text");
  EXPECT_REFUSED(document.check_keys(limits, {"low", "upper"}),
                 "a.json:2: joints[1].limits: unknown key \"lower\"; did you mean \"low\"? "
                 "(known: low, upper)");
}

TEST(Json, OtherTextIsRefusedWithItsLine) {
  EXPECT_REFUSED(parse(""), "a.json:1: is not JSON");
  EXPECT_REFUSED(parse("{\"a\": 1,\n\n  \"b\": }"), "a.json:3: is not JSON");
  EXPECT_REFUSED(parse("[1, 2"), "unexpected end of input");
  EXPECT_REFUSED(parse("[1] x"), "is not JSON");
  for (const std::string text : {"NaN", "nan", "Infinity", "-Infinity", "inf", "-inf"}) {
    EXPECT_REFUSED(parse("[1,\n" + text + "]"), "a.json:2: is not JSON: its numbers have no NaN");
  }
  EXPECT_REFUSED(parse("[1e999]"), "number overflow");
  EXPECT_REFUSED(parse("\"\xff\""), "a.json:1: is not UTF-8 text");
  EXPECT_REFUSED(parse("[1]//"), "is not JSON");
  EXPECT_REFUSED(parse("{\"a\": 1,\n\"a\": 2}"), "a.json:2: the key \"a\" is given twice");
}

TEST(Json, HostileTextsNeitherOverflowNorHang) {
  for (const char* open : {"[", "{\"a\":"}) {
    std::string deep;
    for (int i = 0; i < 1'000'000; ++i) deep += open;
    EXPECT_REFUSED(parse(deep), "nested deeper than 64 levels");
  }
  std::string deepest = std::string(64, '[') + std::string(64, ']');
  EXPECT_NO_THROW(parse(deepest));
  std::string keys = "{\"k0\": 0";
  for (int i = 1; i < 200000; ++i) keys += ",\"k" + std::to_string(i) + "\": 0";
  EXPECT_REFUSED(parse(keys + "}"), "more than 32 keys");
  std::string many = "[";
  for (int i = 0; i < 8'000'000; ++i) many += "0,";
  EXPECT_REFUSED(parse(many + "0]"), "holds more than 8 million values");
}

}  // namespace
}  // namespace beeline::internal
