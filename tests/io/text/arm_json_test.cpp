#include <gtest/gtest.h>

#include <beeline/io/text/arm.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se3.h>

#include <tests/random_arm.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline {
namespace {

Arm parse_arm(const std::string& text) { return arm_from_json(text, "a.json"); }

void expect_same(const Arm& a, const Arm& b) {
  EXPECT_EQ(a.name(), b.name());
  EXPECT_EQ(a.base().matrix(), b.base().matrix());
  EXPECT_EQ(a.tool().matrix(), b.tool().matrix());
  EXPECT_EQ(a.controller().base.matrix(), b.controller().base.matrix());
  EXPECT_EQ(a.controller().base_assumed, b.controller().base_assumed);
  EXPECT_EQ(a.controller().flange.matrix(), b.controller().flange.matrix());
  EXPECT_EQ(a.controller().flange_assumed, b.controller().flange_assumed);
  ASSERT_EQ(a.joints().size(), b.joints().size());
  for (std::size_t i = 0; i < a.joints().size(); ++i) {
    const Joint &x = a.joints()[i], &y = b.joints()[i];
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.link, y.link);
    EXPECT_EQ(x.offset.matrix(), y.offset.matrix());
    EXPECT_EQ(x.screw, y.screw);
    EXPECT_EQ(x.limits.lower, y.limits.lower);
    EXPECT_EQ(x.limits.upper, y.limits.upper);
    EXPECT_EQ(x.limits.velocity, y.limits.velocity);
    EXPECT_EQ(x.limits.acceleration, y.limits.acceleration);
    EXPECT_EQ(x.limits.jerk, y.limits.jerk);
    ASSERT_EQ(x.mimic.has_value(), y.mimic.has_value());
    if (!x.mimic) continue;
    EXPECT_EQ(x.mimic->leader, y.mimic->leader);
    EXPECT_EQ(x.mimic->multiplier, y.mimic->multiplier);
    EXPECT_EQ(x.mimic->offset, y.mimic->offset);
  }
}

/// random_arm's, with links' names and every kind of limit and the controller's frames known or
/// not.
Arm adorned_arm(testing::Random& random) {
  const Arm arm = testing::random_arm(random, random.integer(1, 9), 3);
  std::vector<Joint> joints = arm.joints();
  const auto rate = [&random] {
    return random.integer(0, 1) == 0 ? Limits::none : random.uniform(0.1, 10);
  };
  for (Joint& joint : joints) {
    joint.limits.velocity = rate();
    joint.limits.acceleration = rate();
    joint.limits.jerk = rate();
    if (random.integer(0, 1) == 0) joint.link = "link \"" + joint.name + "\\\"";
  }
  std::optional<ControllerFrames> controller;
  if (random.integer(0, 1) == 0) {
    const auto either = [&] { return random.integer(0, 1) == 0; };
    controller = ControllerFrames{.base = either() ? random.pose() : Pose::Identity(),
                                  .base_assumed = either(),
                                  .flange = either() ? random.pose() : arm.tool(),
                                  .flange_assumed = either()};
  }
  return {"arm \xc3\xa9", joints, arm.tool(), arm.base(), controller};
}

TEST(ArmJson, AnyArmReadsBackToTheLastBit) {
  testing::Random random;
  for (int i = 0; i < 500; ++i) {
    const Arm arm = adorned_arm(random);
    expect_same(parse_arm(arm_to_json(arm)), arm);
  }
  for (const std::string& name : built_in_names()) {
    expect_same(parse_arm(arm_to_json(built_in(name))), built_in(name));
  }
}

TEST(ArmJson, UnknownLimitsAreLeftOut) {
  EXPECT_EQ(arm_to_json(built_in("rrr")).find("limits"), std::string::npos);
  const std::string panda = arm_to_json(built_in("panda"));
  EXPECT_NE(panda.find("\"limits\": {\"lower\": -2.8973, \"upper\": 2.8973, \"velocity\": 2.175, "
                       "\"acceleration\": 15, \"jerk\": 7500}"),
            std::string::npos)
      << panda;
}

TEST(ArmJson, JointsDefaultToRotationAboutZ) {
  const Arm arm = parse_arm(R"({"name": "a", "joints": [{"name": "j", "type": "revolute"}]})");
  EXPECT_EQ(arm.joints()[0].screw, rotation_screw(Vector3::UnitZ()));
  EXPECT_EQ(arm.joints()[0].offset.matrix(), Pose::Identity().matrix());
  EXPECT_EQ(arm.limits(0).upper, Limits::none);
}

TEST(ArmJson, EveryKeyIsHeard) {
  const Arm arm = parse_arm(R"({
    "name": "arm", "base": {"xyz": [0, 0, 1]}, "tool": {"xyz": [0.1, 0, 0]},
    "joints": [
      {"name": "turn", "type": "revolute", "origin": {"xyz": [1, 0, 0]}, "axis": [0, 2, 0],
       "point": [0, 0, 0.5], "limits": {"lower": -1, "upper": 2, "velocity": 3}, "link": "upper"},
      {"name": "screw", "type": "helical", "axis": [1, 0, 0], "pitch": 0.01},
      {"name": "slide", "type": "prismatic", "axis": [0, 3, 4]},
      {"name": "after", "type": "revolute", "mimic": {"joint": "turn", "multiplier": -2}}]})");
  EXPECT_EQ(arm.name(), "arm");
  EXPECT_EQ(arm.dof(), 3);
  EXPECT_EQ(arm.base().translation().z(), 1);
  EXPECT_EQ(arm.tool().translation().x(), 0.1);
  EXPECT_EQ(arm.joints()[0].screw, rotation_screw(Vector3::UnitY(), Vector3(0, 0, 0.5)));
  EXPECT_EQ(arm.joints()[0].link, "upper");
  EXPECT_EQ(arm.joints()[0].limits.velocity, 3);
  EXPECT_EQ(pitch(arm.joints()[1]), 0.01);
  EXPECT_TRUE(arm.joints()[2].screw.isApprox(translation_screw({0, 0.6, 0.8}), 1e-15));
  EXPECT_EQ(arm.joints()[3].mimic->multiplier, -2);
}

TEST(ArmJson, TheControllersFramesAreOptional) {
  const auto parse = [](const std::string& keys) {
    return parse_arm(R"({"name": "a", "joint_string": "RR", "base": {"xyz": [1, 0, 0]},
                         "tool": {"xyz": [0, 0, 1]})" +
                     keys + "}")
        .controller();
  };
  EXPECT_TRUE(parse("").base_assumed);
  EXPECT_TRUE(parse("").base.matrix().isIdentity(0));
  EXPECT_EQ(parse("").flange.translation().z(), 1);
  EXPECT_FALSE(parse(R"(, "controller_base": {})").base_assumed);
  EXPECT_EQ(parse(R"(, "controller_base": {"xyz": [0, 2, 0]})").base.translation().y(), 2);
  EXPECT_EQ(parse(R"(, "controller_base": {})").flange.translation().z(), 1);
  EXPECT_EQ(parse(R"(, "flange": {"xyz": [0, 0, 0.5]})").flange.translation().z(), 0.5);
  EXPECT_TRUE(parse(R"(, "flange": {})").base_assumed);
  EXPECT_FALSE(parse(R"(, "flange": {})").flange_assumed);
  EXPECT_TRUE(parse(R"(, "controller_base": {})").flange_assumed);
  EXPECT_TRUE(parse(R"(, "flange": {}, "flange_assumed": true)").flange_assumed);
  EXPECT_REFUSED(parse(R"(, "flange_assumed": true)"), "given without the key \"flange\"");
  EXPECT_REFUSED(parse(R"(, "controller_base": {}, "controller_base_assumed": 1)"),
                 "controller_base_assumed");
}

/// A mount moves an assumed root frame, and a TCP leaves an assumed flange: a file says where each
/// is, and that it is assumed.
TEST(ArmJson, AssumedFramesOfTheControllerStayAssumed) {
  testing::Random random;
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    const Arm placed = with_tcp(with_mount(arm, random.pose()), random.pose());
    const ControllerFrames read = parse_arm(arm_to_json(placed)).controller();
    EXPECT_EQ(read.base.matrix(), placed.controller().base.matrix()) << name;
    EXPECT_EQ(read.base_assumed, arm.controller().base_assumed) << name;
    EXPECT_EQ(read.flange.matrix(), arm.controller().flange.matrix()) << name;
    EXPECT_EQ(read.flange_assumed, arm.controller().flange_assumed) << name;
  }
  EXPECT_TRUE(built_in("gp8").controller().base_assumed);
  EXPECT_FALSE(built_in("ur5").controller().flange_assumed);
}

TEST(ArmJson, CompositesExpand) {
  const Arm arm = parse_arm(R"({"name": "a", "joints": [
    {"name": "j", "type": "revolute"},
    {"name": "wrist", "type": "spherical", "origin": {"xyz": [1, 0, 0]}, "link": "hand"},
    {"name": "c", "type": "cylindrical"}, {"name": "e", "type": "planar"},
    {"name": "u", "type": "universal"}]})");
  EXPECT_EQ(arm.joint_names(),
            (std::vector<std::string>{"j", "wrist_z", "wrist_y", "wrist_x", "c_z", "c_slide_z",
                                      "e_slide_x", "e_slide_y", "e_z", "u_z", "u_y"}));
  EXPECT_EQ(arm.joints()[1].offset.translation(), Vector3(1, 0, 0));
  EXPECT_EQ(arm.joints()[3].link, "hand");
}

TEST(ArmJson, JointStringsAndDhTablesDescribeArmsToo) {
  const Arm rrr =
      parse_arm(R"({"name": "r", "joint_string": "RRR:3.5,3.5,2", "tool": {"xyz": [1,0,0]}})");
  EXPECT_EQ(rrr.joints().size(), 3u);
  EXPECT_EQ(rrr.name(), "r");
  EXPECT_EQ(forward_kinematics(rrr, Configuration::Zero(3)).translation(), Vector3(10, 0, 0));
  const Arm ur5 = parse_arm(R"({"name": "ur5", "dh": {"convention": "standard", "rows": [
    {"d": 0.089159, "alpha": 1.5707963267948966}, {"a": -0.425}, {"a": -0.39225},
    {"d": 0.10915, "alpha": 1.5707963267948966}, {"d": 0.09465, "alpha": -1.5707963267948966},
    {"d": 0.0823, "limits": {"lower": -1, "upper": 1}}]}})");
  const Arm expected = built_in("ur5");
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(ur5.joints()[i].offset.matrix(), expected.joints()[i].offset.matrix());
    EXPECT_EQ(ur5.joints()[i].screw, expected.joints()[i].screw);
    EXPECT_EQ(ur5.joints()[i].name, expected.joints()[i].name);
  }
  EXPECT_EQ(ur5.limits(5).upper, 1);
  const Arm slide = parse_arm(R"({"name": "a", "dh": {"convention": "modified", "rows": [
    {"name": "q", "type": "prismatic", "a": 1, "theta": 0.5}]}})");
  EXPECT_EQ(kind(slide.joints()[0]), JointKind::prismatic);
  EXPECT_EQ(slide.joints()[0].name, "q");
}

/// An arm whose screws have these rows.
Arm with_screws(const std::string& rows, const std::string& more = "") {
  return parse_arm(R"({"name": "a", "screws": {"frame": "space", "home": {"xyz": [2, 0, 0]},)"
                   R"( "rows": [)" +
                   rows + "]}" + more + "}");
}

TEST(ArmJson, ScrewsDescribeArms) {
  const Arm arm = with_screws(R"({"w": [0, 0, 1], "v": [0, 0, 0], "limits": {"upper": 1}},
      {"name": "elbow", "w": [0, 0, 1], "v": [0, -1, 0]},
      {"w": [0, 0, 0], "v": [0, 0, 1]},
      {"w": [0, 0, 1], "point": [2, 0, 0], "pitch": 0.01})");
  EXPECT_EQ(arm.joint_names(), (std::vector<std::string>{"joint1", "elbow", "joint3", "joint4"}));
  EXPECT_EQ(arm.limits(0).upper, 1);
  EXPECT_EQ(pitch(arm.joints()[3]), 0.01);
  EXPECT_EQ(home_pose(arm).translation(), Vector3(2, 0, 0));
  const Vector3 tool = forward_kinematics(arm, {0, std::numbers::pi / 2, 0.5, 1}).translation();
  EXPECT_TRUE(tool.isApprox(Vector3(1, 1, 0.51))) << tool;
  EXPECT_EQ(arm_to_json(arm), arm_to_json(parse_arm(arm_to_json(arm))));
}

TEST(ArmJson, MistakesInScrewsAreNamed) {
  EXPECT_REFUSED(with_screws(R"({"w": [0, 0, 1]})"),
                 "screws.rows[0] needs the key \"v\", or \"point\", a point of the axis");
  EXPECT_REFUSED(with_screws(R"({"w": [0, 0, 1], "v": [0, 0, 0], "point": [0, 0, 0]})"),
                 "screws.rows[0] has both v and point; give one of them");
  EXPECT_REFUSED(with_screws(R"({"w": [0, 0, 1], "v": [0, 0, 0], "pitch": 1})"),
                 "screws.rows[0].pitch is for a row with a point; v contains the pitch");
  EXPECT_REFUSED(with_screws(R"({"w": [0, 0, 0], "point": [0, 0, 0]})"),
                 "screws.rows[0].point is for rotations; a translation has w = 0 and v");
  EXPECT_REFUSED(with_screws(R"({"w": [0, 0, 1], "point": [1, 0, 0], "pitch": 1e-10})"),
                 "screws.rows[0].pitch is a pitch of 0 to rounding; leave it out");
  EXPECT_REFUSED(with_screws(R"({"v": [0, 0, 1]})"), "screws.rows[0] needs the key \"w\"");
  EXPECT_REFUSED(with_screws(R"({"w": [0, 0, 2], "v": [0, 0, 0]})"),
                 "screws is no arm: the screw of joint1 has w of length 2");
  EXPECT_REFUSED(with_screws(""), "screws is no arm: arm a has no joints");
  EXPECT_REFUSED(with_screws(R"({"w": [0, 0, 1], "v": [0, 0, 0]})", R"(, "tool": {})"),
                 "tool is not for screws: these and the home pose of the tool are in the world");
  EXPECT_REFUSED(parse_arm(R"({"name": "a", "screws": {"frame": "tool", "home": {}, "rows": []}})"),
                 "screws.frame must be space (screws in the world) or body (in the tool)");
}

std::string with_joint(const std::string& joint) {
  return R"({"name": "a", "joints": [{"name": "k", "type": "revolute"},)"
         "\n" +
         joint + "]}";
}

TEST(ArmJson, MistakesInJointsAreNamed) {
  EXPECT_REFUSED(parse_arm(with_joint(R"({"type": "revolute"})")),
                 "a.json:2: joints[1] needs the key \"name\"");
  EXPECT_REFUSED(parse_arm(with_joint(R"({"name": "j"})")), "joints[1] needs the key \"type\"");
  EXPECT_REFUSED(parse_arm(with_joint(R"({"name": "j", "type": "revolut"})")),
                 "joints[1].type is an unknown joint type \"revolut\"; did you mean \"revolute\"?");
  EXPECT_REFUSED(parse_arm(with_joint(R"({"name": "j", "type": "revolute", "axes": [0,0,1]})")),
                 "a.json:2: joints[1]: unknown key \"axes\"; did you mean \"axis\"? (known: name,");
  EXPECT_REFUSED(parse_arm(with_joint(R"({"name": "j", "type": "revolute", "axis": [0,0,0]})")),
                 "joints[1] is not a screw axis: axis 0 0 0 has no direction");
  EXPECT_REFUSED(parse_arm(with_joint(R"({"name": "j", "type": "revolute", "pitch": 1})")),
                 "has a pitch; only a helical joint has one");
  EXPECT_REFUSED(parse_arm(with_joint(R"({"name": "j", "type": "helical"})")),
                 "is helical and needs the key \"pitch\"");
  EXPECT_REFUSED(parse_arm(with_joint(R"({"name": "j", "type": "helical", "pitch": 0})")),
                 "joints[1].pitch is a pitch of 0 to rounding; such a joint is revolute");
  EXPECT_REFUSED(parse_arm(with_joint(R"({"name": "j", "type": "helical", "pitch": 1e300})")),
                 "joints[1].pitch is a pitch above 1e+06 m/rad");
  EXPECT_REFUSED(
      parse_arm(with_joint(R"({"name": "j", "type": "helical", "screw": [0,0,1e300,0,0,1]})")),
      "joints[1].screw has a pitch above 1e+06 m/rad");
  EXPECT_REFUSED(parse_arm(with_joint(R"({"name": "j", "type": "prismatic", "point": [0,0,0]})")),
                 "has a point; a prismatic joint has an axis only");
  EXPECT_REFUSED(
      parse_arm(with_joint(R"({"name": "j", "type": "revolute", "screw": [0,0,0,0,0,2]})")),
      "joints[1].screw must have an axis of length 1, not 2");
  EXPECT_REFUSED(
      parse_arm(with_joint(
          R"({"name": "j", "type": "revolute", "screw": [0,0,0,0,0,1], "axis": [0,0,1]})")),
      "has both screw and axis");
  EXPECT_REFUSED(
      parse_arm(with_joint(R"({"name": "j", "type": "revolute", "screw": [1,0,0,0,0,0]})")),
      "the joint's screw, which is prismatic");
  EXPECT_REFUSED(parse_arm(with_joint(R"({"name": "j", "type": "spherical", "limits": {}})")),
                 "joints[1].limits is not for composite joints");
  EXPECT_REFUSED(parse_arm(with_joint(R"({"name": "k", "type": "revolute"})")),
                 "a.json: two joints are called k");
  EXPECT_REFUSED(parse_arm(with_joint(R"({"name": "a\nb", "type": "revolute"})")),
                 "joints[1].name is refused: the name \"a?b\" contains a control character");
  EXPECT_REFUSED(parse_arm(with_joint("3")), "joints[1] must be an object, not a number");
}

TEST(ArmJson, MistakesInLimitsAndMimicsAreNamed) {
  const auto limited = [](const std::string& limits) {
    return parse_arm(with_joint(R"({"name": "j", "type": "revolute", "limits": )" + limits + "}"));
  };
  EXPECT_REFUSED(limited(R"({"lower": 1, "upper": -1})"),
                 "joints[1].limits are inconsistent: lower 1 exceeds upper -1");
  EXPECT_REFUSED(limited(R"({"lower": "1"})"), "joints[1].limits.lower must be a number, not text");
  EXPECT_REFUSED(limited(R"({"min": 1})"), "unknown key \"min\"");
  EXPECT_REFUSED(limited(R"({"velocity": 0})"), "joints[1].limits.velocity must be at least 1e-09");
  EXPECT_REFUSED(limited(R"({"jerk": -1})"), "joints[1].limits.jerk must be at least 1e-09");
  EXPECT_REFUSED(limited(R"({"acceleration": 1e-310})"), "joints[1].limits.acceleration must be");
  const auto mimicking = [](const std::string& mimic) {
    return parse_arm(with_joint(R"({"name": "j", "type": "revolute", "mimic": )" + mimic + "}"));
  };
  EXPECT_REFUSED(mimicking(R"({"joint": "x"})"), "a.json: joint j mimics an unknown joint \"x\"");
  EXPECT_REFUSED(mimicking(R"({"joint": "j"})"), "joint j mimics itself through its leaders");
  EXPECT_REFUSED(mimicking("{}"), "joints[1].mimic needs the key \"joint\"");
}

TEST(ArmJson, MayNameItsSchema) {
  const std::string text = R"({"$schema": "arm.schema.json", "name": "a", "joint_string": "R"})";
  EXPECT_EQ(parse_arm(text).dof(), 1);
  EXPECT_REFUSED(parse_arm(R"({"name": "a", "dh": {"$schema": "", "rows": []}})"),
                 "unknown key \"$schema\"");
}

TEST(ArmJson, MistakesInTheWholeAreNamed) {
  EXPECT_REFUSED(parse_arm("[]"), "the document must be an object, not a list");
  EXPECT_REFUSED(parse_arm(R"({"joints": []})"), "the document needs the key \"name\"");
  EXPECT_REFUSED(parse_arm(R"({"name": "a"})"),
                 "needs exactly one of the keys joints, joint_string, dh, screws; it has none");
  EXPECT_REFUSED(parse_arm(R"({"name": "a", "joints": [], "dh": {}})"), "it has joints, dh");
  EXPECT_REFUSED(parse_arm(R"({"name": "a", "joints": []})"), "a.json: arm a has no joints");
  EXPECT_REFUSED(parse_arm(R"({"name": "", "joint_string": "R"})"), "the arm's name is empty");
  EXPECT_REFUSED(parse_arm(R"({"name": "a", "joint": []})"),
                 "a.json:1: unknown key \"joint\"; did you mean \"joints\"?");
  EXPECT_REFUSED(parse_arm(R"({"name": "a", "joint_string": "RR:1"})"),
                 "joint_string is not readable: joint string RR has 2 letters but 1 items");
  EXPECT_REFUSED(parse_arm(R"({"name": "a", "base": {"xyz": [0]}, "joint_string": "R"})"),
                 "base.xyz");
  EXPECT_REFUSED(parse_arm(R"({"name": "a", "controller_base": [], "joint_string": "R"})"),
                 "controller_base must be an object");
  EXPECT_REFUSED(parse_arm(R"({"name": "a", "flange": {"zyx": 1}, "joint_string": "R"})"),
                 "flange");
  EXPECT_REFUSED(parse_arm("{\"name\": \"a\",\n\"joints\": [}"), "a.json:2: is not JSON");
  std::string many = R"({"name": "a", "dh": {"convention": "standard", "rows": [{})";
  for (int i = 0; i < 100; ++i) many += ",{}";
  EXPECT_REFUSED(parse_arm(many + "]}}"), "has 101 joints; at most 100 are accepted");
}

TEST(ArmJson, DhTablesMustSayTheirConvention) {
  EXPECT_REFUSED(parse_arm(R"({"name": "a", "dh": {"rows": [{}]}})"),
                 "dh needs the key \"convention\": it must say standard or modified, because the "
                 "numbers do not determine which");
  EXPECT_REFUSED(parse_arm(R"({"name": "a", "dh": {"convention": "craig", "rows": [{}]}})"),
                 "dh.convention must be standard or modified");
  EXPECT_REFUSED(
      parse_arm(R"({"name": "a", "dh": {"convention": "standard", "rows": [{"b": 1}]}})"),
      "dh.rows[0]: unknown key \"b\"");
  EXPECT_REFUSED(
      parse_arm(
          R"({"name": "a", "dh": {"convention": "standard", "rows": [{"type": "helical"}]}})"),
      "dh.rows[0].type must be revolute or prismatic in a DH table");
}

TEST(ArmJson, NamesThatNoReaderTakesAreNotWritten) {
  Joint joint;
  joint.name = "a\nb";
  joint.screw = rotation_screw(Vector3::UnitZ());
  EXPECT_REFUSED(arm_to_json(Arm("arm", {joint})), "a joint's name \"a?b\" contains a control");
  joint.name = "\xff";
  EXPECT_REFUSED(arm_to_json(Arm("arm", {joint})), "is not UTF-8 text");
}

TEST(ArmJson, IsReadFromAFile) {
  const testing::TemporaryFolder folder;
  expect_same(read_arm_json(folder.write("p.json", arm_to_json(built_in("panda")))),
              built_in("panda"));
}

}  // namespace
}  // namespace beeline
