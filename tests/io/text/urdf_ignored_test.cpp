#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>

#include <beeline/io/text/urdf.h>

#include <tests/io/text/urdf_reading.h>
#include <tests/random.h>
#include <tests/refusal.h>

// What a joint contains and the reader does not read: names that URDF does not define, second
// elements of one name, and multipliers of 0.

namespace beeline {
namespace {

using testing::arm;
using testing::joint;
using testing::Kinds;
using testing::link;
using testing::Read;
using testing::read;
using Kind = ReadWarningKind;

/// Another spelling of a name: one letter in the other case, left out, or written twice.
std::string misspelt(testing::Random& random, const std::string& name) {
  const auto at = static_cast<std::size_t>(random.integer(0, static_cast<int>(name.size()) - 1));
  std::string other = name;
  switch (random.integer(0, 2)) {
    case 0:
      other[at] = static_cast<char>(other[at] - 32);
      return other;
    case 1:
      return other.erase(at, 1);
    default:
      return other.insert(at, 1, other[at]);
  }
}

const std::map<std::string, std::map<std::string, std::string>>& known_parts() {
  static const std::map<std::string, std::map<std::string, std::string>> parts{
      {"origin", {{"xyz", "0 0 1"}, {"rpy", "0 0 0"}}},
      {"axis", {{"xyz", "0 0 1"}}},
      {"limit",
       {{"lower", "-1"},
        {"upper", "1"},
        {"velocity", "2"},
        {"effort", "3"},
        {"acceleration", "4"},
        {"jerk", "5"}}},
      {"mimic", {{"joint", "ab"}, {"multiplier", "2"}, {"offset", "0.5"}}}};
  return parts;
}

/// Random elements of a joint, of which some names are misspelt, compared with the names that were
/// misspelt.
TEST(UrdfIgnored, EveryMisspeltNameOnTheChainIsNamed) {
  testing::Random random;
  int found = 0;
  for (int i = 0; i < testing::cases(600); ++i) {
    std::string inside;
    std::multiset<std::string> expected;
    for (const auto& [element, attributes] : known_parts()) {
      if (random.integer(0, 4) == 0) {
        const std::string other = misspelt(random, element);
        inside += "<" + other + " any=\"1\"/>";
        expected.insert("<" + other + "> ");
        continue;
      }
      inside += "<" + element;
      bool kept = false;  // an element with other attributes only cannot be read
      for (const auto& [attribute, value] : attributes) {
        const bool needed =
            (!kept && attribute == attributes.rbegin()->first) || attribute == "joint";
        const std::string as =
            needed || random.integer(0, 3) > 0 ? attribute : misspelt(random, attribute);
        kept = kept || as == attribute;
        if (as != attribute) expected.insert("<" + element + "> " + as);
        inside += " " + as + "=\"" + value + "\"";
      }
      inside += "/>";
    }
    const std::string type = random.integer(0, 1) == 0 ? "revolute" : "prismatic";
    const Read result = read(arm + link("x") + joint("f", type, "c", "x", inside), {.tip = "x"});
    std::multiset<std::string> named;
    for (const ReadWarning& warning : result.warnings) {
      ASSERT_TRUE(warning.kind == Kind::unknown_element || warning.kind == Kind::unknown_attribute);
      EXPECT_EQ(warning.joint, "f");
      EXPECT_EQ(warning.line, 8);
      named.insert(warning.element + " " + warning.attribute);
      EXPECT_TRUE(sentence(warning).starts_with("a.urdf:8: joint f has an unknown "));
      ++found;
    }
    EXPECT_EQ(named, expected) << inside;
  }
  EXPECT_GT(found, testing::cases(600));
}

TEST(UrdfIgnored, TheNameThatIsMeantIsSuggested) {
  const auto said = [](const std::string& inside) {
    const Read result = read(arm + link("x") + joint("f", "revolute", "c", "x", inside));
    return result.warnings.empty() ? "" : sentence(result.warnings.front());
  };
  EXPECT_EQ(said("<Limit Lower=\"-1\" Upper=\"1\"/>"),
            "a.urdf:8: joint f has an unknown element \"<Limit>\"; did you mean \"<limit>\"? "
            "(known: <origin>, <parent>, <child>, <axis>, <limit>, <mimic>, <dynamics>, "
            "<safety_controller>, <calibration>); it is ignored");
  EXPECT_EQ(said("<limit min=\"-1\" max=\"1\" velocity=\"2\"/>"),
            "a.urdf:8: joint f has an unknown attribute of <limit> \"min\" (known: lower, upper, "
            "velocity, effort, acceleration, deceleration, jerk); it is ignored");
  EXPECT_EQ(said("<limit Lower=\"-1\" upper=\"1\"/>"),
            "a.urdf:8: joint f has an unknown attribute of <limit> \"Lower\"; did you mean "
            "\"lower\"? (known: lower, upper, velocity, effort, acceleration, deceleration, jerk); "
            "it is ignored");
  EXPECT_REFUSED(said("<axis XYZ=\"0 0 1\"/>"),
                 "a.urdf:8: <axis> needs the attribute xyz; it has XYZ");
  EXPECT_REFUSED(
      read(arm + link("x") +
               "<joint name=\"f\" type=\"revolute\"><Parent link=\"c\"/><child link=\"x\"/>"
               "</joint>",
           {.tip = "x"}),
      "a.urdf:8: joint \"f\" needs a <parent link=...>; it has <Parent>");
}

/// Other programs' own: names with a prefix, elements that URDF defines and the kinematics do not
/// need, and what a joint without motion contains.
TEST(UrdfIgnored, WhatIsOfOtherProgramsIsNotNamed) {
  for (const auto& [type, inside] : std::vector<std::pair<std::string, std::string>>{
           {"revolute", "<dynamics damping=\"1\" spring=\"2\"/><calibration rising=\"0\"/>"},
           {"revolute", "<safety_controller k_velocity=\"1\"/><drake:controller_gains p=\"1\"/>"},
           {"revolute", "<limit lower=\"-1\" upper=\"1\" drake:acceleration=\"2\"/>"},
           {"fixed", "<axis XYZ=\"1\"/><limit min=\"1\"/><limit/><axis/>"}}) {
    EXPECT_EQ(read(arm + link("x") + joint("f", type, "c", "x", inside), {.tip = "x"}).kinds,
              Kinds{})
        << inside;
  }
  const std::string own =
      "<joint name=\"f\" type=\"fixed\" dont_collapse=\"true\">"
      "<parent link=\"c\"/><child link=\"x\"/></joint>";
  EXPECT_EQ(read(arm + link("x") + own, {.tip = "x"}).kinds, Kinds{});
  EXPECT_EQ(read(arm + "<gazebo reference=\"a\"/><sensor name=\"s\"/>").kinds, Kinds{});
}

/// An element that is given several times: the first one counts.
TEST(UrdfIgnored, RepeatedElementsAreNamedAndTheFirstCounts) {
  const std::string twice =
      "<limit lower=\"-1\" upper=\"1\"/>\n<limit lower=\"-2\" upper=\"2\"/><limit/>";
  std::vector<ReadWarning> warnings;
  const Arm chain =
      arm_from_urdf(testing::robot(arm + link("x") + joint("f", "revolute", "c", "x", twice)),
                    "a.urdf", {}, &warnings);
  EXPECT_EQ(chain.joints().back().limits.upper, 1);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].kind, Kind::repeated_element);
  EXPECT_EQ(warnings[0].count, 3u);
  EXPECT_EQ(sentence(warnings[0]),
            "a.urdf:9: joint f has 3 elements <limit>; the first one counts");
  for (const std::string element : {"<origin/>", "<axis/>", "<mimic joint=\"ab\"/>"}) {
    EXPECT_EQ(read(arm + link("x") + joint("f", "revolute", "c", "x", element + element)).kinds,
              Kinds{Kind::repeated_element});
  }
  EXPECT_EQ(
      read(arm + link("x") + joint("f", "fixed", "c", "x", "<parent link=\"a\"/>"), {.tip = "x"})
          .kinds,
      Kinds{Kind::repeated_element});
}

TEST(UrdfIgnored, TheSameOfSeveralJointsIsOneWarning) {
  std::string text = link("l0");
  for (int i = 0; i < 5; ++i) {
    const std::string from = "l" + std::to_string(i), to = "l" + std::to_string(i + 1);
    text += link(to) + joint("j" + std::to_string(i), "revolute", from, to,
                             "<limit velocity=\"1\" current=\"2\" max=\"3\"/>");
  }
  const Read result = read(text);
  ASSERT_EQ(result.warnings.size(), 2u);
  EXPECT_EQ(result.warnings[0].count, 4u);
  EXPECT_TRUE(sentence(result.warnings[0]).ends_with("; it is ignored, in 4 more joints too"));
  EXPECT_TRUE(result.warnings[0].lists_known);
  EXPECT_FALSE(result.warnings[1].lists_known);
}

TEST(UrdfIgnored, AMultiplierOfZeroIsNamed) {
  const std::string mimic = "<mimic joint=\"ab\" multiplier=\"0\" offset=\"0.25\"/>";
  const Read result = read(arm + link("x") + joint("f", "revolute", "c", "x", mimic));
  EXPECT_EQ(result.dof, 2);
  ASSERT_EQ(result.kinds, Kinds{Kind::zero_multiplier});
  EXPECT_EQ(sentence(result.warnings[0]),
            "a.urdf:8: joint f mimics joint ab with multiplier 0: it is constant at 0.25");
}

/// A <Joint> that moves is lost, unless the user names the tip.
TEST(UrdfIgnored, AMisspeltJointIsNamed) {
  const std::string text =
      arm + link("x") + "<Joint name=\"cx\" type=\"revolute\"><parent link=\"c\"/></Joint>\n";
  EXPECT_REFUSED(read(text),
                 "a.urdf:8: has an unknown element \"<Joint>\"; did you mean \"<joint>\"?");
  EXPECT_EQ(read(text, {.tip = "c"}).kinds.front(), Kind::unknown_element);
}

/// Limits of acceleration and jerk, which are extensions of URDF: the smaller of acceleration and
/// deceleration, and the share of a follower whose leader is beside the chain.
TEST(UrdfIgnored, LimitsOfAccelerationAndJerkAreRead) {
  testing::Random random;
  for (int i = 0; i < testing::cases(200); ++i) {
    const double velocity = random.uniform(0.1, 5), acceleration = random.uniform(0.1, 5);
    const double deceleration = random.uniform(0.1, 5), jerk = random.uniform(0.1, 5);
    const std::string sign = random.integer(0, 1) == 0 ? "-" : "";
    const std::string limit =
        "<limit lower=\"-1\" upper=\"1\" velocity=\"" + std::to_string(velocity) +
        "\" acceleration=\"" + std::to_string(acceleration) + "\" deceleration=\"" + sign +
        std::to_string(deceleration) + "\" jerk=\"" + std::to_string(jerk) + "\"/>";
    const Arm own = arm_from_urdf(
        testing::robot(link("a") + link("b") + joint("ab", "revolute", "a", "b", limit)), "a.urdf");
    const Limits& limits = own.joints().front().limits;
    EXPECT_NEAR(limits.velocity, velocity, 1e-6);
    EXPECT_NEAR(limits.acceleration, std::min(acceleration, deceleration), 1e-6);
    EXPECT_NEAR(limits.jerk, jerk, 1e-6);
    const double factor = random.uniform(0.2, 3);
    const Arm follower = arm_from_urdf(
        testing::robot(
            link("a") + link("b") + link("x") + joint("ax", "revolute", "a", "x", limit) +
            joint("ab", "revolute", "a", "b",
                  "<mimic joint=\"ax\" multiplier=\"" + std::to_string(factor) + "\"/>")),
        "a.urdf", {.tip = "b"});
    EXPECT_NEAR(follower.joints().front().limits.acceleration, factor * limits.acceleration, 1e-5);
    EXPECT_NEAR(follower.joints().front().limits.jerk, factor * limits.jerk, 1e-5);
  }
}

}  // namespace
}  // namespace beeline
