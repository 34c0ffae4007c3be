#include <gtest/gtest.h>

#include <beeline/io/text/internal/srdf_file.h>
#include <beeline/io/text/scene.h>
#include <beeline/io/text/urdf.h>

#include <tests/io/text/urdf_samples.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline {
namespace {

using testing::joint;
using testing::link;
using testing::robot;

/// base - j1 - j2 - fixed - tool - finger; base - other.
const std::string urdf =
    robot(link("base") + link("upper") + link("lower") + link("tool") + link("camera") +
          link("left") + link("right") + link("other") + joint("j1", "revolute", "base", "upper") +
          joint("j2", "revolute", "upper", "lower") + joint("f", "fixed", "lower", "tool") +
          joint("c", "fixed", "lower", "camera") + joint("finger", "prismatic", "tool", "left") +
          joint("follower", "prismatic", "left", "right", "<mimic joint=\"finger\"/>") +
          joint("aside", "revolute", "base", "other"));

Srdf parse(const std::string& elements) { return srdf_from_text(robot(elements), "a.srdf"); }

std::string ends(const std::string& elements, const std::string& group = "g") {
  const ChainEnds found = internal::group_ends(parse(elements), group, urdf, "a.urdf");
  return found.base + " " + found.tip;
}

std::string group(const std::string& inside, const std::string& name = "g") {
  return "<group name=\"" + name + "\">" + inside + "</group>\n";
}

std::string named(const std::string& tag, const std::string& name) {
  return "<" + tag + " name=\"" + name + "\"/>";
}

std::string state(const std::string& name, const std::string& values, const std::string& of = "g") {
  return "<group_state name=\"" + name + "\" group=\"" + of + "\">" + values + "</group_state>\n";
}

std::string value(const std::string& joint, const std::string& number) {
  return "<joint name=\"" + joint + "\" value=\"" + number + "\"/>";
}

TEST(Srdf, AChainGivesItsEnds) {
  EXPECT_EQ(ends(group("<chain base_link=\"base\" tip_link=\"tool\"/>")), "base tool");
  EXPECT_EQ(ends(group("<chain base_link=\"tool\" tip_link=\"other\"/>")), "tool other");
}

TEST(Srdf, JointsAndLinksGiveTheirEnds) {
  EXPECT_EQ(ends(group(named("joint", "j1") + named("joint", "j2"))), "base lower");
  EXPECT_EQ(ends(group(named("joint", "f") + named("joint", "j2") + named("joint", "j1"))),
            "base tool");
  EXPECT_EQ(ends(group(named("link", "base") + named("link", "upper") + named("link", "lower") +
                       named("link", "tool"))),
            "base tool");
  EXPECT_EQ(ends(group(named("joint", "j2"))), "upper lower");
  EXPECT_EQ(ends(group(named("joint", "j2") + named("joint", "finger") + named("joint", "f"))),
            "upper left");
  EXPECT_EQ(ends(group(named("joint", "finger") + named("link", "right"))), "tool right");
}

TEST(Srdf, GroupsContainGroupsAlsoInACircle) {
  const std::string both = group(named("group", "a") + named("group", "b")) +
                           group(named("joint", "j1") + named("group", "g"), "a") +
                           group(named("joint", "j2") + named("group", "a"), "b");
  EXPECT_EQ(ends(both), "base lower");
  EXPECT_EQ(ends(group("<chain base_link=\"base\" tip_link=\"tool\"/>", "a") +
                 group(named("group", "a") + named("joint", "finger"))),
            "base left");
  EXPECT_EQ(ends(group("<chain base_link=\"base\" tip_link=\"tool\"/>", "a") +
                 group(named("group", "a"))),
            "base tool");
}

TEST(Srdf, VirtualJointsAreNoPartOfTheChain) {
  EXPECT_EQ(ends("<virtual_joint name=\"v\" type=\"fixed\" parent_frame=\"world\" "
                 "child_link=\"base\"/>" +
                 group(named("joint", "v") + named("joint", "j1"))),
            "base upper");
}

TEST(Srdf, GroupsThatAreNoChainAreRefused) {
  EXPECT_REFUSED(ends(group(named("joint", "j1"), "arm"), "amr"),
                 "a.srdf: unknown group \"amr\"; did you mean \"arm\"? (known: arm)");
  EXPECT_REFUSED(ends(group(named("group", "none"))), "a.srdf:2: unknown group \"none\"");
  EXPECT_REFUSED(ends(group(named("joint", "j3"))),
                 "a.srdf:2: group g has an unknown joint \"j3\"; did you mean \"j1\"? (known: j1,");
  EXPECT_REFUSED(ends(group(named("link", "toll"))), "a.srdf:2: group g has an unknown link");
  EXPECT_REFUSED(ends(group("<chain base_link=\"base\" tip_link=\"top\"/>")),
                 "a.srdf:2: group g has an unknown link \"top\"");
  EXPECT_REFUSED(ends(group("")), "a.srdf: group g has no moving joint");
  EXPECT_REFUSED(ends(group(named("joint", "j1") + named("joint", "aside"))),
                 "group g is not a chain: joints aside and j1 are on two branches");
  EXPECT_REFUSED(ends(group(named("joint", "j1") + named("joint", "finger"))),
                 "group g does not have joint j2, which moves between its base and its tip");
  EXPECT_REFUSED(group_ends(parse(""), "g", "panda"),
                 "a group selects a chain of a URDF file; \"panda\" is not one");
}

TEST(Srdf, NamedStatesAreConfigurations) {
  const Srdf srdf = parse(
      state("home", value("j1", "0.5") + value("j2", " -1 ")) +
      state("open", value("finger", "0.1"), "hand") +
      state("all",
            value("finger", "0.2") + value("j2", "2") + value("j1", "1") + value("free", "0 0 0 1"),
            "robot"));
  const Arm arm = arm_from_urdf(urdf, "a.urdf", {.tip = "tool"});
  EXPECT_EQ(named_state(srdf, arm, "home"), Configuration(Eigen::Vector2d(0.5, -1)));
  EXPECT_EQ(named_state(srdf, arm, "all", "g"), Configuration(Eigen::Vector2d(1, 2)));
  EXPECT_EQ(
      named_state(srdf, arm_from_urdf(urdf, "a.urdf", {.base = "tool", .tip = "base"}), "home"),
      Configuration(Eigen::Vector2d(-1, 0.5)));
  EXPECT_REFUSED(
      named_state(srdf, arm, "hom"),
      "a.srdf: unknown named state \"hom\"; did you mean \"home\"? (known: home, open, all)");
  EXPECT_REFUSED(named_state(srdf, arm, "open"),
                 "a.srdf:3: state open of group hand has no value for joint j1");
}

TEST(Srdf, AStateNeedsNoGroup) {
  const Srdf srdf = parse("<group_state name=\"up\">" + value("j1", "1") + "</group_state>");
  EXPECT_EQ(named_state(srdf, arm_from_urdf(urdf, "a.urdf", {.tip = "upper"}), "up")[0], 1);
}

TEST(Srdf, StatesOfOneNameAreToldApartByTheirGroup) {
  const std::string first = value("j1", "1") + value("j2", "2");
  const Srdf srdf =
      parse(state("home", first) + state("home", value("j1", "3") + value("j2", "4"), "h") +
            state("same", first) + state("same", first, "h"));
  const Arm arm = arm_from_urdf(urdf, "a.urdf", {.tip = "tool"});
  EXPECT_EQ(named_state(srdf, arm, "home", "h")[0], 3);
  EXPECT_EQ(named_state(srdf, arm, "home", "g")[0], 1);
  EXPECT_EQ(named_state(srdf, arm, "same")[1], 2);
  EXPECT_REFUSED(
      named_state(srdf, arm, "home"),
      "a.srdf:3: state home of group h has other values than in group g; name the group");
}

TEST(Srdf, ExemptsPairsOfLinksWithShapes) {
  const std::vector<LinkShapes> links{{"a", 0, {}}, {"b", 1, {}}, {"c", 2, {}}, {"d", 2, {}}};
  const auto pairs = [&](const std::string& elements) {
    return exempted_pairs(parse(elements), links);
  };
  const auto disable = [](const std::string& one, const std::string& two) {
    return "<disable_collisions link1=\"" + one + "\" link2=\"" + two + "\" reason=\"Never\"/>\n";
  };
  EXPECT_EQ(pairs(""), std::vector<NamedPair>{});
  EXPECT_EQ(
      pairs(disable("c", "a") + disable("a", "c") + disable("a", "elsewhere") + disable("b", "b")),
      (std::vector<NamedPair>{{"c", "a"}}))
      << "each once, and of these links alone";
  const std::string all_of_b = "<disable_default_collisions link=\"b\"/>\n";
  EXPECT_EQ(pairs(all_of_b), (std::vector<NamedPair>{{"b", "a"}, {"b", "c"}, {"b", "d"}}));
  EXPECT_EQ(pairs(all_of_b + "<enable_collisions link1=\"d\" link2=\"b\"/>" + disable("a", "b")),
            (std::vector<NamedPair>{{"a", "b"}, {"b", "c"}}));
  EXPECT_REFUSED(parse("<disable_collisions link1=\"a\"/>"), "a.srdf:2");
}

TEST(Srdf, MistakesAreNamedWithTheirLine) {
  EXPECT_REFUSED(parse("<group/>"), "a.srdf:2: <group> needs the attribute name");
  EXPECT_REFUSED(parse(group("") + group("")), "a.srdf:3: two groups have the name g");
  EXPECT_REFUSED(parse(group("<chain base_link=\"b\"/>")), "<chain> needs the attribute tip_link");
  EXPECT_REFUSED(parse(state("s", "\n<joint name=\"j\"/>")),
                 "a.srdf:3: <joint> needs the attribute value");
  EXPECT_REFUSED(parse(state("s", value("j", "one"))),
                 "a.srdf:2: <joint>: value: \"one\" is not a number");
  EXPECT_REFUSED(parse(state("s", value("j", "nan"))), "must be finite");
  EXPECT_REFUSED(parse(state("s", value("j", "1") + value("j", "2"))),
                 "state s gives joint j twice");
  EXPECT_REFUSED(parse(state("s", "") + state("s", "")),
                 "a.srdf:3: two states of one group have the name s");
  EXPECT_REFUSED(parse(link("a")), "a.srdf:2: is a URDF file, not an SRDF file");
  EXPECT_REFUSED(parse("<xacro:macro/>"), "is a xacro file; run xacro first");
  EXPECT_REFUSED(srdf_from_text("<sdf/>", "a.srdf"), "its root must be <robot>, not <sdf>");
  EXPECT_REFUSED(srdf_from_text("", "a.srdf"), "a.srdf: is not well-formed XML: it is empty");
  const Srdf srdf = parse(state("s", value("j1", "1 2") + value("j2", "")));
  EXPECT_REFUSED(named_state(srdf, arm_from_urdf(urdf, "a.urdf", {.tip = "tool"}), "s"),
                 "has 2 values for joint j1, which takes one");
}

TEST(Srdf, LargeFilesAreReadInLinearTime) {
  std::string text;
  for (int i = 0; i < 5000; ++i) {
    const std::string own = std::to_string(i), next = std::to_string((i + 1) % 5000);
    text += group(named("group", "g" + next) + named("group", "g" + own), "g" + own) +
            state("s" + own, value("j1", "0"));
  }
  EXPECT_REFUSED(ends(text, "g0"), "group g0 has no moving joint");
}

TEST(Srdf, IsReadFromAFile) {
  const testing::TemporaryFolder folder;
  const Srdf srdf = read_srdf(folder.write("a.srdf", robot(group(named("joint", "j1")))));
  EXPECT_EQ(group_ends(srdf, "g", folder.write("a.urdf", urdf)).tip, "upper");
  EXPECT_REFUSED(read_srdf(folder.file("none.srdf")), "none.srdf: cannot be read");
  EXPECT_REFUSED(read_arm(folder.file("a.srdf")), "is an SRDF file, which has no kinematics");
}

}  // namespace
}  // namespace beeline
