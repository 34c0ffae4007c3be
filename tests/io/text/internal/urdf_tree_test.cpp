#include <algorithm>
#include <gtest/gtest.h>

#include <beeline/io/text/internal/urdf_chain.h>

#include <tests/io/text/urdf_samples.h>
#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline::internal {
namespace {

using testing::joint;
using testing::link;
using testing::robot;

std::vector<std::string> chain(const std::string& text, const ChainEnds& ends = {}) {
  const UrdfFile file = parse_urdf(text, "a.urdf");
  std::vector<std::string> names;
  for (const ChainJoint& place : cut_chain(file, ends)) {
    names.push_back((place.reversed ? "-" : "") + file.joints[place.index].name);
  }
  return names;
}

using Names = std::vector<std::string>;

/// a - b - c and a - d
const std::string fork =
    robot(link("c") + link("a") + link("b") + link("d") + joint("bc", "revolute", "b", "c") +
          joint("ab", "revolute", "a", "b") + joint("ad", "revolute", "a", "d"));

TEST(UrdfTree, ChainsRunFromBaseToTip) {
  EXPECT_EQ(chain(fork, {.base = "", .tip = "c"}), (Names{"ab", "bc"}));
  EXPECT_EQ(chain(fork, {.base = "", .tip = "b"}), (Names{"ab"}));
  EXPECT_EQ(chain(fork, {.base = "a", .tip = "d"}), (Names{"ad"}));
  EXPECT_EQ(chain(fork, {.base = "b", .tip = ""}), (Names{"bc"}));
  EXPECT_EQ(chain(fork, {.base = "b", .tip = "b"}), Names{});
}

TEST(UrdfTree, ChainsRunUpAndDown) {
  EXPECT_EQ(chain(fork, {.base = "c", .tip = "d"}), (Names{"-bc", "-ab", "ad"}));
  EXPECT_EQ(chain(fork, {.base = "c", .tip = "a"}), (Names{"-bc", "-ab"}));
  EXPECT_EQ(chain(fork, {.base = "b", .tip = "d"}), (Names{"-ab", "ad"}));
}

/// Links below random earlier ones: the chain to each is the path from the root.
TEST(UrdfTree, RandomTreesGiveTheChainFromTheRoot) {
  testing::Random random;
  for (int i = 0; i < 100; ++i) {
    const int links = random.integer(2, 30);
    std::vector<int> parent{-1};
    std::vector<std::string> elements{link("0")};
    for (int k = 1; k < links; ++k) {
      parent.push_back(random.integer(0, k - 1));
      elements.push_back(link(std::to_string(k)));
      elements.push_back(joint("to" + std::to_string(k), "revolute", std::to_string(parent.back()),
                               std::to_string(k)));
    }
    for (std::size_t k = elements.size() - 1; k > 0; --k) {  // any order of elements will do
      std::swap(elements[k], elements[random.integer(0, int(k))]);
    }
    std::string text;
    for (const std::string& element : elements) text += element;
    for (int tip = 1; tip < links; ++tip) {
      Names expected;
      for (int k = tip; k != 0; k = parent[k]) {
        expected.insert(expected.begin(), "to" + std::to_string(k));
      }
      EXPECT_EQ(chain(robot(text), {.base = "", .tip = std::to_string(tip)}), expected);
    }
  }
}

TEST(UrdfTree, SeveralTipsAndRootsMustBeChosenFrom) {
  EXPECT_REFUSED(chain(fork), "a.urdf: has 2 tips below a; choose one as the tip: c, d");
  const std::string two_roots =
      robot(link("a") + link("b") + link("c") + link("d") + joint("ab", "revolute", "a", "b") +
            joint("cd", "revolute", "c", "d"));
  EXPECT_REFUSED(chain(two_roots), "a.urdf: has 2 roots; choose the base: a, c");
  EXPECT_EQ(chain(two_roots, {.base = "c", .tip = ""}), (Names{"cd"}));
  EXPECT_REFUSED(chain(two_roots, {.base = "c", .tip = "b"}), "tip b is not connected to base c");
}

TEST(UrdfTree, EndsThatAreNotThereAreNamed) {
  EXPECT_REFUSED(chain(fork, {.base = "", .tip = "tool0"}),
                 "a.urdf: unknown tip link \"tool0\" (known: c, a, b, d)");
  EXPECT_REFUSED(chain(fork, {.base = "e", .tip = ""}), "unknown base link \"e\"");
}

TEST(UrdfTree, OtherGraphsAreRefused) {
  EXPECT_REFUSED(chain(robot(link("a") + joint("j", "revolute", "a", "b"))),
                 "a.urdf:3: joint j has an unknown child link \"b\" (known: a)");
  EXPECT_REFUSED(chain(robot(link("b") + joint("j", "revolute", "a", "b"))),
                 "a.urdf:3: joint j has an unknown parent link \"a\"");
  EXPECT_REFUSED(chain(robot(link("a") + link("a"))), "a.urdf:3: two links have the name a");
  EXPECT_REFUSED(chain(robot(link("a") + link("b") + link("c") + joint("j", "fixed", "a", "b") +
                             joint("j", "fixed", "a", "c"))),
                 "a.urdf:6: two joints have the name j");
  EXPECT_REFUSED(chain(robot(link("a") + link("b") + link("c") + joint("ac", "fixed", "a", "c") +
                             joint("bc", "fixed", "b", "c"))),
                 "a.urdf:6: link c has two parents, by joints ac and bc");
}

TEST(UrdfTree, CyclesAreFoundAnywhere) {
  const std::string whole = robot(link("a") + link("b") + joint("ab", "revolute", "a", "b") +
                                  joint("ba", "revolute", "b", "a"));
  EXPECT_REFUSED(chain(whole), "the links form a cycle through joint");
  EXPECT_REFUSED(chain(whole, {.base = "a", .tip = "b"}), "cycle");
  const std::string self = robot(link("a") + joint("aa", "revolute", "a", "a"));
  EXPECT_REFUSED(chain(self), "a.urdf:3: the links form a cycle through joint aa");
  const std::string aside =
      robot(link("r") + link("s") + link("a") + link("b") + link("c") +
            joint("rs", "revolute", "r", "s") + joint("ab", "revolute", "a", "b") +
            joint("ba", "revolute", "b", "a") + joint("bc", "revolute", "b", "c"));
  EXPECT_EQ(chain(aside, {.base = "r", .tip = "s"}), (Names{"rs"}));
  EXPECT_REFUSED(chain(aside), "cycle");  // it may be the chain that is meant
  EXPECT_REFUSED(chain(aside, {.base = "a", .tip = "c"}), "cycle");
}

}  // namespace
}  // namespace beeline::internal
