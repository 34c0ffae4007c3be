#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

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

/// Whole numbers are only in values that a program made; a document of them is read as any other.
TEST(Json, WholeNumbersOfAProgramAreNumbers) {
  testing::Random random;
  for (int i = 0; i < testing::cases(300); ++i) {
    const int small = random.integer(-1'000'000, 1'000'000);
    const std::int64_t large = (std::int64_t{1} << 53) - random.integer(0, 1000);
    const Json made{{"count", small}, {"list", Json()}, {"large", large}};
    Json with_list = made;
    Json list = Json::list();
    list.append(small);
    list.append(0.5);
    with_list.add("list", list);
    const JsonDocument document(with_list, "p.json");
    const JsonDocument again = parse(with_list.text());
    for (const JsonDocument* read : {&document, &again}) {
      EXPECT_EQ(read->number(read->need(read->root(), "count")), small);
      EXPECT_EQ(read->number(read->need(read->root(), "large")), static_cast<double>(large));
      EXPECT_EQ(read->numbers(read->need(read->root(), "list"), 2),
                (std::vector<double>{static_cast<double>(small), 0.5}));
    }
  }
  const JsonDocument document(Json{{"a", 3}}, "p.json");
  const Json& a = document.need(document.root(), "a");
  EXPECT_REFUSED(document.text(a), "p.json: a must be text, not a number");
  EXPECT_REFUSED(document.truth(a), "p.json: a must be true or false, not a number");
  EXPECT_REFUSED(document.items(a), "p.json: a must be a list, not a number");
  EXPECT_EQ(Json(std::numeric_limits<std::int64_t>::max()).text(), "9223372036854775807");
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
  if (testing::slow_build) return;
  std::string many = "[";
  for (int i = 0; i < 8'000'000; ++i) many += "0,";
  EXPECT_REFUSED(parse(many + "0]"), "holds more than 8 million values");
}

/// A random value, with at most `depth` levels of lists and objects.
Json any_json(testing::Random& random, int depth) {
  const int kind = random.integer(0, depth > 0 ? 6 : 4);
  if (kind == 0) return nullptr;
  if (kind == 1) return random.integer(0, 1) == 1;
  if (kind == 2) return random.uniform(-1, 1) * std::pow(10, random.integer(-300, 300));
  if (kind == 3) return random.integer(-1000, 1000);
  if (kind == 4) return std::string(random.integer(0, 3), '"') + "\n\x01gr\xc3\xbc\xc3\x9f";
  Json json = kind == 5 ? Json::list() : Json::object();
  for (int i = random.integer(0, 4); i > 0; --i) {
    if (kind == 5) json.append(any_json(random, depth - 1));
    if (kind == 6) json.add("key " + std::to_string(i), any_json(random, depth - 1));
  }
  return json;
}

bool same_json(const Json& a, const Json& b) {
  if (const auto* whole = std::get_if<std::int64_t>(&a.value)) {
    return std::get<double>(b.value) == static_cast<double>(*whole);
  }
  if (a.value.index() != b.value.index()) return false;
  if (const auto* items = std::get_if<Json::Items>(&a.value)) {
    return std::ranges::equal(*items, std::get<Json::Items>(b.value), same_json);
  }
  if (const auto* members = std::get_if<Json::Members>(&a.value)) {
    return std::ranges::equal(*members, std::get<Json::Members>(b.value),
                              [](const Json::Member& x, const Json::Member& y) {
                                return x.key == y.key && same_json(x.value, y.value);
                              });
  }
  if (const auto* text = std::get_if<std::string>(&a.value)) {
    return *text == std::get<std::string>(b.value);
  }
  if (const auto* number = std::get_if<double>(&a.value)) {
    return *number == std::get<double>(b.value);
  }
  const auto* truth = std::get_if<bool>(&a.value);
  return truth == nullptr || *truth == std::get<bool>(b.value);
}

TEST(Json, AnyValueThatIsWrittenReadsBack) {
  testing::Random random;
  for (int i = 0; i < 2000; ++i) {
    const Json json = any_json(random, 4);
    const JsonDocument document = parse(json.text());
    ASSERT_TRUE(same_json(json, document.root())) << json.text();
  }
}

TEST(Json, IsWrittenWithTwoBlanksForEachLevel) {
  const Json json{{"a", 1}, {"b", 1.0}, {"c", Json::list()}, {"d", {{"e", "t"}, {"f", nullptr}}}};
  EXPECT_EQ(json.text(),
            "{\n  \"a\": 1,\n  \"b\": 1.0,\n  \"c\": [],\n  \"d\": {\n    \"e\": \"t\",\n"
            "    \"f\": null\n  }\n}");
  EXPECT_EQ(Json(Eigen::VectorXd(Eigen::Vector2d(-0.0, 1e-7))).text(), "[\n  -0.0,\n  1e-07\n]");
  EXPECT_EQ(Json(std::nan("")).text() + Json(std::optional<double>()).text(), "nullnull");
  EXPECT_EQ(Json("a\xff\xc3\xbc").text(), "\"a\xef\xbf\xbd\xc3\xbc\"");
}

TEST(Json, AKeyIsInAnObjectOnce) {
  Json json{{"a", 1}, {"b", 2}};
  json.add("a", 3);
  json.add(Json{{"b", 4}, {"c", 5}});
  json.add(Json());
  EXPECT_EQ(json.text(), "{\n  \"a\": 3,\n  \"b\": 4,\n  \"c\": 5\n}");
}

TEST(JsonDocument, ReadsAWholeNumberThatAProgramMade) {
  const JsonDocument document(Json(7), "made.json");
  EXPECT_EQ(document.number(document.root()), 7);
}

}  // namespace
}  // namespace beeline::internal
