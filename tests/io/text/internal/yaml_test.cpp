#include <gtest/gtest.h>

#include <beeline/io/text/internal/yaml.h>

#include <tests/refusal.h>

namespace beeline::internal {
namespace {

/// The tree in one line: {key: value, ...}, [item, ...].
std::string shown(const Yaml& yaml) {
  std::string text;
  if (const auto* scalar = std::get_if<std::string>(&yaml.value)) return *scalar;
  if (const auto* items = std::get_if<Yaml::Items>(&yaml.value)) {
    for (const Yaml& item : *items) text += (text.empty() ? "" : ", ") + shown(item);
    return "[" + text + "]";
  }
  for (const YamlMember& member : std::get<Yaml::Members>(yaml.value)) {
    text += (text.empty() ? "" : ", ") + member.key + ": " + shown(member.value);
  }
  return "{" + text + "}";
}

std::string parsed(const std::string& text) { return shown(parse_yaml(text, "a.yaml")); }

std::string repeated(const std::string& text, std::size_t times) {
  std::string all;
  for (std::size_t i = 0; i < times; ++i) all += text;
  return all;
}

TEST(Yaml, ReadsMapsListsAndScalars) {
  EXPECT_EQ(parsed("a: 1\nb:\n  - x\n  - {c: \"y z\", d: ~}\n"), "{a: 1, b: [x, {c: y z, d: }]}");
  EXPECT_EQ(parsed("# nothing\n"), "");
  EXPECT_EQ(parsed("--- {a: 1}\n...\n"), "{a: 1}");
}

TEST(Yaml, KeepsTagsAndLines) {
  const Yaml root = parse_yaml("a: !degrees 3\n\nb: 'x'\n", "a.yaml");
  const auto& members = std::get<Yaml::Members>(root.value);
  EXPECT_EQ(members[0].value.tag, "!degrees");
  EXPECT_EQ(members[1].value.tag, "!");
  EXPECT_EQ(members[1].line, 3);
  EXPECT_EQ(members[1].value.line, 3);
}

TEST(Yaml, CopiesAliasesAndMergesMaps) {
  EXPECT_EQ(parsed("a: &n [1, 2]\nb: *n"), "{a: [1, 2], b: [1, 2]}");
  EXPECT_EQ(parsed("a: &n {x: 1, y: 2}\nb:\n  <<: *n\n  y: 3"),
            "{a: {x: 1, y: 2}, b: {y: 3, x: 1}}");
  EXPECT_EQ(parsed("b: {<<: [{x: 1}, {x: 2, z: 3}], y: 3}"), "{b: {y: 3, x: 1, z: 3}}");
  EXPECT_REFUSED(parsed("b:\n  <<: 3"), "a.yaml:2: the key << must have maps");
  EXPECT_REFUSED(parsed("a: &n [1, *n]"), "an alias is inside its own anchor");
  EXPECT_REFUSED(parsed("a: *n"), "a.yaml:1: is not YAML");
}

TEST(Yaml, RefusesWhatIsAmbiguous) {
  EXPECT_REFUSED(parsed("a: 1\nb: 2\na: 3"), "a.yaml:3: the key \"a\" is given twice");
  EXPECT_REFUSED(parsed("[1]: 2"), "a key must be a name");
  EXPECT_REFUSED(parsed("a: 1\n---\nb: 2"), "has a second document");
  EXPECT_REFUSED(parsed("a: 1\n---\n---\nb: 2"), "has a second document");
  EXPECT_EQ(testing::refusal([] { (void)parsed("a: 1\n---\n"); }), "accepted");
  EXPECT_REFUSED(parsed("a: 'x"), "a.yaml:1: is not YAML");
  EXPECT_REFUSED(parsed("a: 1\n b: 2"), "a.yaml:2: is not YAML");
}

TEST(Yaml, BoundsDepthSizeAndCopies) {
  const std::size_t deep = 20000;
  EXPECT_EQ(parsed(repeated("[", 64) + "1" + repeated("]", 64)).size(), 129u);
  for (const char* level : {"[", "{a: ", "- ", "? ", "[{a: [", "!t [", "{? "}) {
    EXPECT_REFUSED(parsed(repeated(level, deep)), "a.yaml:");
  }
  std::string indented;
  for (std::size_t i = 0; i < 200; ++i) indented += std::string(i, ' ') + "a:\n";
  EXPECT_REFUSED(parsed(indented), "a.yaml:65: is nested deeper than 64 levels");
  EXPECT_REFUSED(parsed(std::string((1 << 20) + 1, ' ')), "a.yaml: is larger than 1 MiB");
  EXPECT_REFUSED(parsed("[" + repeated("1,", 150'000) + "1]"), "more than 100000 values");
  std::string bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n", nested = "b0: &b0 1\n";
  for (int i = 1; i < 40; ++i) {
    const std::string last = std::to_string(i - 1), next = std::to_string(i);
    bomb += "a" + next + ": &a" + next + " [" + repeated("*a" + last + ", ", 9) + "1]\n";
    nested += "b" + next + ": &b" + next + " [[*b" + last + "]]\n";
  }
  EXPECT_REFUSED(parsed(bomb), "more than 100000 values");
  EXPECT_REFUSED(parsed(nested), "is nested deeper than 64 levels");
  const std::string text = "a: &a " + std::string(100'000, 'x') + "\nb: [";
  EXPECT_REFUSED(parsed(text + repeated("*a, ", 100) + "1]\n"), "more than 100000 values");
  const YamlBounds large{.bytes = std::size_t{1} << 24};
  EXPECT_REFUSED(parse_yaml("a: 1\nb: [" + repeated("1,", 1 << 19) + "1]", "a.yaml", large),
                 "a.yaml:2: is longer than 1 MiB");
}

}  // namespace
}  // namespace beeline::internal
