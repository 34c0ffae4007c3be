#include <algorithm>
#include <gtest/gtest.h>

#include <beeline/io/text/internal/srdf_file.h>
#include <beeline/io/text/urdf.h>

#include <tests/io/text/urdf_reading.h>
#include <tests/random.h>
#include <tests/refusal.h>

// Faults of a URDF file: errors on the chain, warnings beside it.

namespace beeline {
namespace {

using testing::arm;
using testing::joint;
using testing::Kinds;
using testing::link;
using testing::Read;
using testing::read;
using testing::robot;

/// An element that is wrong, beside the arm, on line 7 or 8; `moves`: it may shorten the chain.
struct Fault {
  std::string elements;
  ReadWarningKind kind;
  bool moves = false;
};

std::vector<Fault> faults() {
  const std::string x = link("x");  // line 7
  using Kind = ReadWarningKind;
  return {
      {joint("f", "fixed", "nowhere", "x") + x, Kind::unknown_link},
      {joint("f", "fixed", "a", "nowhere"), Kind::unknown_link},
      {joint("f", "continuous", "nowhere", "x") + x, Kind::unknown_link},
      {joint("f", "continuous", "nowhere", "elsewhere"), Kind::unknown_link},
      {joint("f", "continuous", "cc", "x") + x, Kind::unknown_link, true},
      {joint("f", "continuous", "nowhere", "x") + x + joint("g", "revolute", "x", "y") + link("y"),
       Kind::unknown_link, true},
      {joint("f", "continuous", "a", "nowhere"), Kind::unknown_link, true},
      {x + joint("f", "fixed", "a", "x") + joint("g", "fixed", "b", "x"), Kind::two_parents},
      {x + joint("f", "fixed", "a", "x") + joint("g", "revolute", "b", "x"), Kind::two_parents,
       true},
      {x + link("y") + joint("f", "fixed", "x", "y") + joint("g", "fixed", "y", "x"), Kind::cycle},
      {x + joint("f", "revolute", "x", "x"), Kind::cycle, true},
      {x + x + joint("f", "fixed", "a", "x"), Kind::repeated_name},
      {x + link("y") + joint("f", "fixed", "a", "x") + joint("f", "fixed", "a", "y"),
       Kind::repeated_name},
      {x, Kind::unconnected_link},
      {link(""), Kind::malformed},
      {x + "<joint name=\"f\" type=\"fixed\"><parent link=\"a\"/></joint>\n" +
           joint("g", "fixed", "a", "x"),
       Kind::malformed},
      {"<joint name=\"f\" type=\"revolute\"><parent link=\"a\"/></joint>\n", Kind::malformed, true},
      {"<joint name=\"f\"/>\n", Kind::malformed, true},
      {x + joint("f", "fixed", "a", "x", "<origin xyz=\"1 2\"/>"), Kind::malformed},
      {x + joint("f", "fixed", "a", "x", "<xacro:insert_block name=\"origin\"/>"), Kind::xacro_tag},
      {link("\xfcx") + joint("f", "fixed", "a", "\xfcx"), Kind::malformed},
      {x + joint("\xfc", "fixed", "a", "x"), Kind::malformed},
      {"<xacro:include filename=\"gripper.xacro\"/>\n", Kind::xacro_tag},
      {"<xacro:property name=\"x\" value=\"1\"/>\n", Kind::xacro_tag},
  };
}

TEST(UrdfFaults, BesideTheChainAreWarnings) {
  for (const Fault& fault : faults()) {
    for (const std::string& text : {arm + fault.elements, fault.elements + arm}) {
      const Read result = read(text, {.tip = "c"});
      EXPECT_EQ(result.dof, 2) << text;
      ASSERT_EQ(result.kinds, Kinds{fault.kind}) << text << sentence(result.warnings.front());
      EXPECT_TRUE(is_fault(result.warnings.front()));
      EXPECT_GT(result.warnings.front().line, 0) << text;
      const std::string sentence = beeline::sentence(result.warnings.front());
      EXPECT_TRUE(sentence.starts_with("a.urdf:")) << sentence;
      EXPECT_NE(sentence.find("left out"), std::string::npos) << sentence;
    }
  }
}

/// Without a tip, a chain that lost a moving joint is not taken for the one that is meant.
TEST(UrdfFaults, ThatMayShortenTheChainAreErrorsWithoutATip) {
  for (const Fault& fault : faults()) {
    const std::string text = arm + fault.elements;
    if (fault.moves) {
      EXPECT_REFUSED(read(text), "; the option tip (--tip) selects a chain beside it");
      continue;
    }
    // A frame of a tip's body, and one of the base.
    const Read result = read(text);
    EXPECT_EQ(result.dof, 2) << text;
    EXPECT_EQ(std::count(result.kinds.begin(), result.kinds.end(), fault.kind), 1) << text;
  }
}

TEST(UrdfFaults, OnTheChainAreErrors) {
  const auto refused = [](const std::string& elements, const std::string& why) {
    for (const std::string tip : {"", "c"}) {
      EXPECT_REFUSED(read(elements, {.tip = tip}), "a.urdf:" + why);
    }
  };
  const std::string links = link("a") + link("b") + link("c");
  const std::string ab = joint("ab", "revolute", "a", "b"), bc = joint("bc", "revolute", "b", "c");
  refused(links + ab + joint("bc", "revolute", "bb", "c"),
          "6: joint bc has an unknown parent link \"bb\"; did you mean \"b\"? (known: a, b, c)");
  refused(links + joint("ab", "revolute", "aa", "b") + bc,
          "5: joint ab has an unknown parent link");
  EXPECT_REFUSED(read(link("a") + link("c") + ab + bc),
                 "a.urdf:4: joint ab has an unknown child link \"b\"");
  EXPECT_REFUSED(read(link("a") + link("c") + ab + bc, {.tip = "c"}),
                 "a.urdf:5: joint bc has an unknown parent link \"b\"");
  refused(links + ab + bc + joint("ac", "fixed", "a", "c"), "7: link c has two parents");
  refused(links + ab + bc + joint("cb", "fixed", "c", "b"), "7: link b has two parents");
  refused(links + link("b") + ab + bc, "5: two links have the name b");
  refused(arm + link("x") + joint("ab", "fixed", "a", "x"), "8: two joints have the name ab");
  refused(links + ab + joint("bc", "revolute", "b", "c", "<axis xyz=\"0 1\"/>"),
          "6: <axis>: xyz has 2 numbers");
  refused(links + ab + joint("bc", "revolute", "b", "c", "<xacro:origin/>"),
          "6: joint bc contains <xacro:origin>; run xacro first");
  refused(links + ab + "<joint name=\"bc\" type=\"revolute\"><child link=\"c\"/></joint>\n",
          std::string("6: joint \"bc\" needs a <parent link=...>"));
}

TEST(UrdfFaults, AreLimitedInNumber) {
  std::string text = arm;
  for (int i = 0; i < 20'000; ++i) {
    const std::string number = std::to_string(i);
    text +=
        joint("f" + number, "fixed", "nowhere" + number, "elsewhere" + number) + link("x" + number);
  }
  const Read result = read(text, {.tip = "c"});
  EXPECT_EQ(result.warnings.size(), 11u);
  EXPECT_EQ(result.kinds.back(), ReadWarningKind::further_faults);
  EXPECT_EQ(result.warnings.back().count, 40'000u - 10);
}

/// The first faults are listed, and the one that matters is found among very many.
TEST(UrdfFaults, OfAnyNumberAreCounted) {
  std::string text;
  for (int i = 0; i < 10'100; ++i) text += "<xacro:a/>";
  const Read result = read(text + arm + text);
  EXPECT_EQ(result.dof, 2);
  ASSERT_EQ(result.warnings.size(), 11u);
  EXPECT_EQ(result.kinds.front(), ReadWarningKind::xacro_tag);
  EXPECT_EQ(result.warnings.back().count, 20'200u - 10);
  EXPECT_REFUSED(
      read(text + arm + "<joint name=\"lost\" type=\"revolute\"/>" + text),
      "joint \"lost\" needs a <parent link=...>; the option tip (--tip) selects a chain beside it");
  EXPECT_REFUSED(read(text + arm + text + link("b"), {.tip = "c"}), "two links have the name b");
  std::string repeated;
  for (int i = 0; i < 10'100; ++i) repeated += link("x");
  EXPECT_EQ(read(arm + repeated, {.tip = "c"}).warnings.back().count, 10'099u + 1 - 10);
}

/// A deep chain of frames with as many faults beside it: time is linear in both.
TEST(UrdfFaults, BesideADeepChainAreFoundInLinearTime) {
  constexpr int count = 4000;
  std::string text = arm, last = "c";
  for (int i = 0; i < count; ++i) {
    const std::string n = std::to_string(i);
    text += link("s" + n) + joint("j" + n, "fixed", last, "s" + n) + link("p" + n) + link("q" + n) +
            joint("pq" + n, "fixed", "p" + n, "q" + n) + joint("qp" + n, "fixed", "q" + n, "p" + n);
    last = "s" + n;
  }
  const Read result = read(text);
  EXPECT_EQ(result.dof, 2);
  EXPECT_EQ(result.kinds.front(), ReadWarningKind::cycle);
  EXPECT_EQ(result.warnings.back().count, static_cast<std::size_t>(count) - 10);
  const std::string back = joint("back", "fixed", last, "c");
  EXPECT_REFUSED(read(text + back), "link c has two parents, by joints bc and back");
  std::string hand = text + joint("finger", "prismatic", last, "f") + link("f");
  for (int i = 0; i < count; ++i) {
    const std::string n = std::to_string(i);
    hand += link("f" + n) + joint("finger" + n, "prismatic", last, "f" + n);
  }
  EXPECT_REFUSED(read(hand), "has 4001 tips below a");
}

/// What a warning of a fault says as data.
TEST(UrdfFaults, AreData) {
  const auto first = [](const std::string& elements) {
    return read(arm + elements, {.tip = "c"}).warnings.front();
  };
  const std::string x = link("x");
  struct Case {
    std::string elements;
    ElementFault fault;
    std::string element, attribute, value;
  };
  const auto moved = [&](const std::string& inside) {
    return x + joint("f", "revolute", "a", "x", inside);
  };
  for (const Case& wrong : std::vector<Case>{
           {"<link/>\n", ElementFault::missing_attribute, "<link>", "name", ""},
           {link(""), ElementFault::empty_name, "<link>", "name", ""},
           {link("a\tb"), ElementFault::control_character, "<link>", "name", "a\tb"},
           {link("\xfc\xc3\xbc"), ElementFault::not_utf8, "<link>", "name", "\\xfc\xc3\xbc"},
           {"<joint name=\"f\" type=\"fixed\"><parent link=\"a\"/></joint>\n",
            ElementFault::missing_end, "<child>", "", ""},
           {moved("<axis xyz=\"0 1\"/>"), ElementFault::not_three_numbers, "<axis>", "xyz", ""},
           {moved("<origin xyz=\"0 ${a} 1\"/>"), ElementFault::not_a_number, "<origin>", "xyz",
            "${a}"},
           {moved("<origin xyz=\"0 1e999 1\"/>"), ElementFault::out_of_range, "<origin>", "xyz",
            "1e999"},
           {moved("<origin rpy=\"0 nan 1\"/>"), ElementFault::not_finite, "<origin>", "rpy", "nan"},
           {moved("<limit lower=\"\"/>"), ElementFault::missing_number, "<limit>", "lower", ""},
           {moved("<limit upper=\"NaN\"/>"), ElementFault::not_a_limit, "<limit>", "upper",
            "NaN"}}) {
    const ReadWarning warning = first(wrong.elements);
    EXPECT_EQ(warning.kind, ReadWarningKind::malformed);
    EXPECT_EQ(warning.element_fault, wrong.fault) << sentence(warning);
    EXPECT_EQ(warning.element, wrong.element) << sentence(warning);
    EXPECT_EQ(warning.attribute, wrong.attribute) << sentence(warning);
    EXPECT_EQ(warning.value, wrong.value) << sentence(warning);
  }
  EXPECT_EQ(first(moved("<axis xyz=\"0 1\"/>")).count, 2u);
  EXPECT_EQ(first(moved("<axis xyz=\"0 1\"/>")).joint, "f");
  const ReadWarning unknown = first(joint("f", "fixed", "cc", "x") + x);
  EXPECT_EQ(unknown.link, "cc");
  EXPECT_EQ(unknown.element, "<parent>");
  EXPECT_EQ(unknown.others, (std::vector<std::string>{"a", "b", "c", "x"}));
  const ReadWarning two = first(x + joint("f", "fixed", "a", "x") + joint("g", "fixed", "b", "x"));
  EXPECT_EQ(two.others, std::vector<std::string>{"f"});
  EXPECT_EQ(two.joint, "g");
}

/// A random tree with links that are missing: every chain that does not need them is read as
/// before.
TEST(UrdfFaults, DoNotChangeTheOtherChains) {
  testing::Random random;
  int warned = 0;
  for (int i = 0; i < 100; ++i) {
    const int links = random.integer(3, 12);
    std::vector<int> parent{-1};
    for (int k = 1; k < links; ++k) parent.push_back(random.integer(0, k - 1));
    const int missing = random.integer(1, links - 1);
    std::string whole = link("0"), broken = link("0");
    for (int k = 1; k < links; ++k) {
      const std::string name = std::to_string(k);
      const std::string origin = "<origin xyz=\"" + name + " 0 0\"/>";
      const std::string element =
          joint("j" + name, "revolute", std::to_string(parent[k]), name, origin);
      whole += link(name) + element;
      broken += (k == missing ? "" : link(name)) + element;
    }
    for (int tip = 1; tip < links; ++tip) {
      bool needed = false;
      for (int k = tip; k != -1; k = parent[k]) needed = needed || k == missing;
      const ChainEnds ends{.base = "", .tip = std::to_string(tip)};
      if (needed) {
        EXPECT_NE(testing::refusal([&] { read(broken, ends); }), "accepted");
        continue;
      }
      const Arm expected = arm_from_urdf(robot(whole), "a.urdf", ends);
      std::vector<ReadWarning> warnings;
      const Arm found = arm_from_urdf(robot(broken), "a.urdf", ends, &warnings);
      EXPECT_EQ(found.joint_names(), expected.joint_names());
      EXPECT_EQ(warnings.front().kind, ReadWarningKind::unknown_link);
      ++warned;
    }
  }
  EXPECT_GT(warned, 100);
}

TEST(UrdfFaults, AGroupIsRefusedWhereItNeedsAFaultyJoint) {
  const std::string text = arm + joint("lost", "revolute", "nowhere", "x") + link("x");
  const auto ends = [&](const std::string& joints) {
    const Srdf srdf = srdf_from_text(
        "<robot name=\"r\"><group name=\"g\">" + joints + "</group></robot>", "a.srdf");
    return internal::group_ends(srdf, "g", robot(text), "a.urdf");
  };
  const ChainEnds found = ends("<joint name=\"ab\"/><joint name=\"bc\"/>");
  EXPECT_EQ(found.base, "a");
  EXPECT_EQ(found.tip, "c");
  EXPECT_REFUSED(ends("<joint name=\"ab\"/><joint name=\"lost\"/>"),
                 "a.urdf:7: joint lost has an unknown parent link");
}

}  // namespace
}  // namespace beeline
