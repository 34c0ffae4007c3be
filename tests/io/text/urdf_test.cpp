#include <gtest/gtest.h>

#include <beeline/io/text/internal/urdf_file.h>
#include <beeline/io/text/urdf.h>
#include <beeline/kinematics/forward.h>
#include <beeline/pose/se3.h>

#include <tests/io/text/urdf_samples.h>
#include <tests/random.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline {
namespace {

using testing::joint;
using testing::link;
using testing::robot;

Arm parse_urdf(const std::string& text, const ChainEnds& ends = {}) {
  return arm_from_urdf(text, "a.urdf", ends);
}

/// One joint between two links.
std::string single(const std::string& type, const std::string& inside = "") {
  return robot(link("a") + link("b") + joint("j", type, "a", "b", inside));
}

Pose turn(double angle, const Vector3& axis) { return Pose(Eigen::AngleAxisd(angle, axis)); }

Pose shift(double x, double y, double z) { return make_pose({x, y, z}); }

TEST(Urdf, TheToolHasThePoseOfTheFile) {
  const Arm arm = parse_urdf(testing::whole_urdf, {.base = "", .tip = "left"});
  EXPECT_EQ(arm.name(), "small arm");
  EXPECT_EQ(arm.joint_names(), (std::vector<std::string>{"pan", "lift", "left_finger"}));
  testing::Random random;
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();
  for (int i = 0; i < 1000; ++i) {
    const Configuration q = random.configuration(arm);
    const Pose expected = shift(0, 0, 0.5) * turn(0.3, z) * turn(-0.2, y) * turn(0.1, x) *
                          turn(q[0], z) * shift(0.1, 0, 0) * turn(q[1], x) * shift(0.4, 0, 0) *
                          turn(1.5708, y) * shift(0, 0.01 + q[2], 0.1);
    EXPECT_TRUE(forward_kinematics(arm, q).isApprox(expected, 1e-14));
  }
}

TEST(Urdf, LimitsAreRead) {
  const Arm arm = parse_urdf(testing::whole_urdf, {.base = "", .tip = "left"});
  EXPECT_EQ(arm.limits(0).lower, -Limits::none);
  EXPECT_EQ(arm.limits(0).upper, Limits::none);
  EXPECT_EQ(arm.limits(0).velocity, 3);
  EXPECT_EQ(arm.limits(1).lower, -1.5);
  EXPECT_EQ(arm.limits(1).upper, 2);
  EXPECT_EQ(arm.limits(1).velocity, Limits::none) << "0 means not known";
  EXPECT_EQ(arm.limits(2).upper, 0.04);
  EXPECT_EQ(arm.limits(2).velocity, 0.2);
}

TEST(Urdf, MissingPartsHaveTheFormatsDefaults) {
  const Arm bare = parse_urdf(single("revolute"));
  EXPECT_EQ(bare.joints()[0].screw, rotation_screw(Vector3::UnitX()));
  EXPECT_EQ(bare.joints()[0].offset.matrix(), Pose::Identity().matrix());
  EXPECT_EQ(bare.limits(0).upper, Limits::none);
  EXPECT_EQ(bare.joints()[0].link, "b");
  const Arm slide = parse_urdf(single("prismatic", "<axis/><limit velocity=\"0\" upper=\"2\"/>"));
  EXPECT_EQ(slide.joints()[0].screw, translation_screw(Vector3::UnitX()));
  EXPECT_EQ(slide.limits(0).lower, 0);
  EXPECT_EQ(slide.limits(0).upper, 2);
  EXPECT_EQ(slide.limits(0).velocity, Limits::none);
  const Arm still = parse_urdf(single("revolute", "<limit effort=\"1\" velocity=\"1\"/>"));
  EXPECT_EQ(still.limits(0).lower, 0);
  EXPECT_EQ(still.limits(0).upper, 0);
}

TEST(Urdf, ANegativeVelocityLimitIsRefused) {
  EXPECT_REFUSED(parse_urdf(single("prismatic", "<limit velocity=\"-2\" upper=\"2\"/>")),
                 "joint j: velocity limit -2 is below 1e-09; 0 and -1 stand for none");
}

TEST(Urdf, NoLimitHasManySpellings) {
  for (const std::string number : {"inf", "Infinity", "INF", ".inf", "1.79769e+308", "1.8e308",
                                   "1e999", "3.4e38", "3.402823466e+38", "1e16", "1e+30", "2e6"}) {
    for (const std::string plus : {"", "+"}) {
      const Arm arm =
          parse_urdf(single("revolute", "<limit effort=\"-1\" lower=\"-" + number + "\" upper=\"" +
                                            plus + number + "\" velocity=\"-1.0\"/>"));
      EXPECT_EQ(arm.limits(0).lower, -Limits::none) << number;
      EXPECT_EQ(arm.limits(0).upper, Limits::none) << number;
      EXPECT_EQ(arm.limits(0).velocity, Limits::none) << number;
    }
    const Arm half = parse_urdf(
        single("prismatic", "<limit lower=\"-" + number + "\" upper=\"1.5\" velocity=\"3\"/>"));
    EXPECT_EQ(half.limits(0).lower, -Limits::none) << number;
    EXPECT_EQ(half.limits(0).upper, 1.5);
    EXPECT_EQ(half.limits(0).velocity, 3);
  }
  for (const std::string velocity : {"inf", "1.8e308", "-3.4e38", "1e16", "0"}) {
    const Arm arm = parse_urdf(single("continuous", "<limit velocity=\"" + velocity + "\"/>"));
    EXPECT_EQ(arm.limits(0).velocity, Limits::none) << velocity;
  }
  // Exchanged, an infinity is a mistake; so is no number.
  EXPECT_REFUSED(parse_urdf(single("revolute", "<limit lower=\"inf\" upper=\"1\"/>")),
                 "a.urdf:4: joint j: lower limit inf exceeds upper limit 1");
  EXPECT_REFUSED(parse_urdf(single("revolute", "<limit lower=\"inf\" upper=\"-inf\"/>")),
                 "joint j: lower limit inf exceeds upper limit -inf");
  EXPECT_REFUSED(parse_urdf(single("revolute", "<limit lower=\"nan\" upper=\"1\"/>")),
                 "is not a limit");
  EXPECT_REFUSED(parse_urdf(single("revolute", "<limit lower=\"--inf\" upper=\"1\"/>")),
                 "is not a number");
  EXPECT_REFUSED(parse_urdf(single("revolute", "<origin xyz=\"inf 0 0\"/>")), "must be finite");
}

TEST(Urdf, LimitsOfOtherJointsAreNoReasonToRefuse) {
  for (const std::string limit : {"lower=\"1\" upper=\"-1\"", "lower=\"low\"", "velocity=\"-2\"",
                                  "lower=\"nan\"", "lower=\"1e16\" upper=\"-1e16\""}) {
    const std::string text =
        robot(link("a") + link("b") + link("w") + joint("j", "revolute", "a", "b") +
              joint("wheel", "revolute", "a", "w", "<limit " + limit + "/>"));
    EXPECT_EQ(parse_urdf(text, {.tip = "b"}).dof(), 1) << limit;
    EXPECT_NE(testing::refusal([&] { (void)parse_urdf(text, {.tip = "w"}); }), "accepted") << limit;
  }
}

TEST(Urdf, ARobotWithoutANameIsCalledLikeItsFile) {
  const std::string text =
      "<robot>" + link("a") + link("b") + joint("j", "revolute", "a", "b") + "</robot>";
  EXPECT_EQ(arm_from_urdf(text, "folder/my_arm.urdf").name(), "my_arm");
}

TEST(Urdf, TrailingFixedJointsAreTheTool) {
  const Arm arm = parse_urdf(robot(link("a") + link("b") + link("c") + link("d") +
                                   joint("f", "fixed", "a", "b", "<origin xyz=\"1 0 0\"/>") +
                                   joint("j", "revolute", "b", "c", "<origin xyz=\"0 1 0\"/>") +
                                   joint("t", "fixed", "c", "d", "<origin xyz=\"0 0 1\"/>")));
  EXPECT_EQ(arm.joints()[0].offset.translation(), Vector3(1, 1, 0));
  EXPECT_EQ(arm.tool().translation(), Vector3(0, 0, 1));
  EXPECT_EQ(arm.joints()[0].link, "c");
}

TEST(Urdf, TheLinksBaseAndTool0AreTheControllersFrames) {
  // world -> stand -> arm -> a; base is fixed to stand, tool0 to b: j moves b.
  const auto cell = [](const std::string& base, const std::string& tool) {
    return robot(link("world") + link("stand") + link("a") + link("b") + link("base") +
                 link("tool0") + joint("s", "fixed", "world", "stand", "<origin xyz=\"1 0 0\"/>") +
                 joint("f", "fixed", "stand", "a", "<origin xyz=\"0 1 0\"/>") +
                 joint("j", "revolute", "a", "b", "<origin xyz=\"0 0 1\"/>") +
                 joint("c", "fixed", base, "base", "<origin xyz=\"0 0 2\"/>") +
                 joint("t", "fixed", tool, "tool0", "<origin xyz=\"0 3 0\"/>"));
  };
  const ControllerFrames from_world =
      parse_urdf(cell("stand", "b"), {.base = "", .tip = "b"}).controller();
  EXPECT_FALSE(from_world.base_assumed);
  EXPECT_EQ(from_world.base.translation(), Vector3(1, 0, 2));
  EXPECT_EQ(from_world.flange.translation(), Vector3(0, 3, 0));
  EXPECT_FALSE(from_world.flange_assumed);
  const ControllerFrames from_a =
      parse_urdf(cell("stand", "b"), {.base = "a", .tip = "b"}).controller();
  EXPECT_EQ(from_a.base.translation(), Vector3(0, -1, 2));
  const ControllerFrames at_base = parse_urdf(cell("stand", "b"), {.base = "base"}).controller();
  EXPECT_TRUE(at_base.base.matrix().isIdentity(0));
  EXPECT_FALSE(at_base.base_assumed);
  // On the other side of the joint they are other frames.
  const ControllerFrames other = parse_urdf(cell("b", "a"), {.base = "", .tip = "b"}).controller();
  EXPECT_TRUE(other.base_assumed);
  EXPECT_TRUE(other.flange_assumed);
  EXPECT_TRUE(other.base.matrix().isIdentity(0));
  EXPECT_TRUE(other.flange.matrix().isIdentity(0));
  // Up the tree, the chain begins at b and ends at a.
  const ControllerFrames up =
      parse_urdf(cell("b", "stand"), {.base = "b", .tip = "a"}).controller();
  EXPECT_EQ(up.base.translation(), Vector3(0, 0, 2));
  EXPECT_FALSE(up.base_assumed);
  std::string far = cell("stand", "b");
  far.replace(far.find("0 0 2"), 5, "0 0 1e7");
  EXPECT_TRUE(parse_urdf(far, {.base = "", .tip = "b"}).controller().base_assumed);
}

TEST(Urdf, FollowersFollowWithinTheChainAndThroughLeadersBesideIt) {
  const std::string text =
      robot(link("a") + link("b") + link("c") + link("d") + joint("lead", "revolute", "a", "b") +
            joint("follow", "revolute", "b", "c",
                  "<mimic joint=\"lead\" multiplier=\"-2\" offset=\"0.5\"/>") +
            joint("lost", "revolute", "b", "d", "<mimic joint=\"follow\"/>"));
  const Arm inside = parse_urdf(text, {.base = "", .tip = "c"});
  EXPECT_EQ(inside.dof(), 1);
  ASSERT_TRUE(inside.joints()[1].mimic.has_value());
  EXPECT_EQ(inside.couplings()[1].ratio, -2);
  EXPECT_EQ(inside.couplings()[1].shift, 0.5);
  const Arm through = parse_urdf(text, {.base = "", .tip = "d"});
  EXPECT_EQ(through.dof(), 1);
  EXPECT_EQ(through.couplings()[1].ratio, -2);
  EXPECT_EQ(through.couplings()[1].shift, 0.5);
  EXPECT_EQ(parse_urdf(text, {.base = "b", .tip = "c"}).dof(), 1);
  EXPECT_EQ(parse_urdf(testing::whole_urdf, {.base = "", .tip = "right"}).dof(), 3);
}

/// Followers of a leader beside the chain, with random factors, compared with the leader's value.
TEST(Urdf, FollowersOfOneLeaderBesideTheChainAreOneCoordinate) {
  testing::Random random;
  for (int i = 0; i < 200; ++i) {
    const int followers = random.integer(2, 5);
    std::string text = link("base") + link("side") + link("l0") +
                       joint("leader", "revolute", "base", "side",
                             "<limit lower=\"-1\" upper=\"2\" velocity=\"3\"/>");
    std::vector<double> multiplier, offset;
    for (int k = 0; k < followers; ++k) {
      multiplier.push_back(random.uniform(0.2, 2) * (random.integer(0, 1) == 0 ? -1 : 1));
      offset.push_back(random.uniform(-1, 1));
      text += link("l" + std::to_string(k + 1)) +
              joint("f" + std::to_string(k), "revolute", "l" + std::to_string(k),
                    "l" + std::to_string(k + 1),
                    "<mimic joint=\"leader\" multiplier=\"" + std::to_string(multiplier.back()) +
                        "\" offset=\"" + std::to_string(offset.back()) + "\"/>");
    }
    text += joint("fix", "fixed", "base", "l0");
    const Arm arm = parse_urdf(robot(text), {.tip = "l" + std::to_string(followers)});
    ASSERT_EQ(arm.dof(), 1);
    EXPECT_EQ(arm.joint_names().front(), "f0");
    for (const double leader : {-1.0, 0.3, 2.0}) {
      const double q = multiplier[0] * leader + offset[0];
      EXPECT_TRUE(within_position_limits(arm.limits(0), q, 1e-5));
      for (int k = 0; k < followers; ++k) {
        EXPECT_NEAR(arm.couplings()[k].ratio * q + arm.couplings()[k].shift,
                    multiplier[k] * leader + offset[k], 1e-4);
      }
    }
    EXPECT_NEAR(arm.limits(0).upper - arm.limits(0).lower, 3 * std::abs(multiplier[0]), 1e-5);
    EXPECT_NEAR(arm.limits(0).velocity, 3 * std::abs(multiplier[0]), 1e-5);
  }
}

TEST(Urdf, AFollowerThatDoesNotMoveIsNoCoordinate) {
  const auto follower = [](const std::string& factors) {
    return "<mimic joint=\"x\" " + factors + "/>";
  };
  const std::string text =
      robot(link("a") + link("b") + link("c") + link("x") + joint("x", "revolute", "a", "x") +
            joint("still", "revolute", "a", "b", follower("multiplier=\"0\" offset=\"0.4\"")) +
            joint("moves", "revolute", "b", "c", follower("multiplier=\"2\"")));
  const Arm arm = parse_urdf(text, {.tip = "c"});
  EXPECT_EQ(arm.joint_names(), std::vector<std::string>{"moves"});
  EXPECT_EQ(arm.couplings()[0].ratio, 0);
  EXPECT_EQ(arm.couplings()[0].shift, 0.4);
}

TEST(Urdf, LeadersBesideTheChainThatFormACycleAreRefused) {
  const auto mimic = [](const std::string& of) { return "<mimic joint=\"" + of + "\"/>"; };
  const std::string text = robot(
      link("a") + link("b") + link("c") + link("d") + joint("j", "revolute", "a", "b", mimic("k")) +
      joint("k", "revolute", "a", "c", mimic("l")) + joint("l", "revolute", "a", "d", mimic("k")));
  EXPECT_REFUSED(parse_urdf(text, {.tip = "b"}),
                 "a.urdf:6: joint j follows leaders that mimic each other");
}

TEST(Urdf, ALeaderThatIsNotInTheFileIsRefusedWithinTheChainOnly) {
  const std::string text =
      robot(link("a") + link("b") + link("c") + joint("j", "revolute", "a", "b") +
            joint("lost", "revolute", "a", "c", "<mimic joint=\"jay\"/>"));
  EXPECT_EQ(parse_urdf(text, {.base = "", .tip = "b"}).dof(), 1);
  EXPECT_REFUSED(parse_urdf(text, {.base = "", .tip = "c"}),
                 "a.urdf:6: joint lost mimics an unknown joint");
}

TEST(Urdf, OtherTypesAreRefusedWithinTheChainOnly) {
  for (const std::string type : {"floating", "planar", "screw"}) {
    const std::string text =
        robot(link("a") + link("b") + link("c") + joint("j", "revolute", "a", "b") +
              joint("loose", type, "a", "c"));
    EXPECT_EQ(parse_urdf(text, {.base = "", .tip = "b"}).dof(), 1);
    const std::string chain =
        robot(link("a") + link("b") + link("c") + link("d") + joint("j", "revolute", "a", "b") +
              joint("loose", type, "b", "c") + joint("k", "revolute", "c", "d"));
    EXPECT_REFUSED(parse_urdf(chain),
                   "; base=\"c\" (--base c) or tip=\"b\" (--tip b) selects a chain without it");
    EXPECT_REFUSED(parse_urdf(chain, {.base = "d", .tip = "a"}),
                   "; base=\"b\" (--base b) or tip=\"c\" (--tip c) selects a chain without it");
    EXPECT_EQ(parse_urdf(chain, {.base = "c"}).dof(), 1);
    EXPECT_REFUSED(parse_urdf(text, {.base = "", .tip = "c"}),
                   "a.urdf:6: joint loose is \"" + type +
                       "\"; a chain has revolute, continuous, prismatic and "
                       "fixed joints");
  }
}

TEST(Urdf, MistakesInJointsAreNamedWithTheirLine) {
  EXPECT_REFUSED(parse_urdf(single("revolute", "\n<axis xyz=\"0 0 0\"/>")),
                 "a.urdf:5: joint j: axis 0 0 0 has no direction");
  EXPECT_REFUSED(parse_urdf(single("revolute", "\n\n<limit lower=\"1\" upper=\"-1\"/>")),
                 "a.urdf:6: joint j: lower limit 1 exceeds upper limit -1");
  EXPECT_REFUSED(
      parse_urdf(single("revolute", "<limit lower=\"0\" upper=\"1\" velocity=\"1e-310\"/>")),
      "a.urdf:4: joint j: velocity limit 1e-310 is below 1e-09");
  EXPECT_REFUSED(parse_urdf(single("revolute", "<axis xyz=\"0 1\"/>")),
                 "a.urdf:4: <axis>: xyz has 2 numbers; it must have three");
  EXPECT_REFUSED(parse_urdf(single("revolute", "<origin xyz=\"0 1 2 3\"/>")), "xyz has 4 numbers");
  EXPECT_REFUSED(parse_urdf(single("revolute", "<origin rpy=\"0 1 2x\"/>")),
                 "<origin>: rpy: \"2x\" is not a number");
  EXPECT_REFUSED(parse_urdf(single("revolute", "<origin xyz=\"0 1 nan\"/>")), "must be finite");
  EXPECT_REFUSED(parse_urdf(single("revolute", "<limit lower=\"low\"/>")),
                 "a.urdf:4: <limit>: lower: \"low\" is not a limit; a limit is a number, or inf");
  EXPECT_REFUSED(parse_urdf(single("revolute", "<limit lower=\"${low}\"/>")), "run xacro first");
  EXPECT_REFUSED(parse_urdf(single("revolute", "<mimic/>")), "<mimic> needs the attribute joint");
  EXPECT_REFUSED(parse_urdf(single("revolute", "<mimic joint=\"j\"/>")),
                 "a.urdf:4: joint j mimics itself");
  EXPECT_REFUSED(parse_urdf(single("revolute", "\n<mimic joint=\"jj\"/>")),
                 "a.urdf:5: joint j mimics an unknown joint \"jj\"");
  EXPECT_REFUSED(parse_urdf(single("")), "a.urdf:4: joint j has an unknown type \"\"");
  EXPECT_REFUSED(parse_urdf(robot("<joint name=\"j\"/>")),
                 "a.urdf:2: <joint> needs the attribute type");
  EXPECT_REFUSED(parse_urdf(robot("<joint type=\"fixed\"/>")), "<joint> needs the attribute name");
  EXPECT_REFUSED(parse_urdf(robot("<joint name=\"j\" type=\"fixed\"><parent link=\"a\"/></joint>")),
                 "joint \"j\" needs a <child link=...>");
  EXPECT_REFUSED(parse_urdf(robot("<joint name=\"j\" type=\"fixed\"><parent/></joint>")),
                 "<parent> needs the attribute link");
  EXPECT_REFUSED(parse_urdf(robot("<link name=\"\"/>")), "a.urdf:2: <link>: name is empty");
  EXPECT_REFUSED(parse_urdf(robot("<link name=\"\xff\"/>")), "is not UTF-8 text");
  EXPECT_REFUSED(parse_urdf(single("fixed")),
                 "a.urdf: has no moving joints between its base and its tip");
}

TEST(Urdf, OtherTextIsRefused) {
  EXPECT_REFUSED(parse_urdf(""), "a.urdf: is not well-formed XML: it is empty");
  EXPECT_REFUSED(parse_urdf("{\"name\": \"a\"}"), "a.urdf");
  EXPECT_REFUSED(parse_urdf("<sdf/>"),
                 "a.urdf:1: is not URDF: its root must be <robot>, not <sdf>");
  EXPECT_REFUSED(parse_urdf("<robot>\n<link>\n</robot>"), "is not well-formed XML");
  EXPECT_REFUSED(parse_urdf("<robot name=\"r\"/>"), "a.urdf: has no links");
  EXPECT_REFUSED(parse_urdf(robot(link("a") + "<xacro:include filename=\"b\"/>\n")),
                 "a.urdf:3: is a xacro file (it contains <xacro:include>); run xacro first");
  EXPECT_REFUSED(parse_urdf(std::string((std::size_t{8} << 20) + 1, ' ')),
                 "a.urdf: is larger than 8 MiB");
  EXPECT_REFUSED(
      parse_urdf("<robot>\n<link name=\"a\" name=\"b\"/></robot>"),
      "a.urdf:2: is not well-formed XML: an attribute is not name=\"value\", or is given twice");
  const std::string declared = "<?xml version=\"1.0\"?>\n<robot name=\"r\"/>\n";
  for (const std::string& front : {std::string("[INFO] done\n"), declared}) {
    EXPECT_REFUSED(parse_urdf(front + declared), "a declaration <?...?> stands below other text");
  }
  EXPECT_REFUSED(parse_urdf("<?xml version=\"1.0\""), "a comment or a declaration has no end");
  // The comments that xacro writes into its output are not xacro.
  EXPECT_NO_THROW(parse_urdf("<robot name=\"r\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">" +
                             link("a") + link("b") + joint("j", "revolute", "a", "b") +
                             "</robot>"));
}

TEST(Urdf, HostileXmlIsHarmless) {
  std::string deep;
  for (int i = 0; i < 1'000'000; ++i) deep += "<a>";
  EXPECT_REFUSED(parse_urdf(deep), "nested deeper than 100 levels");
  EXPECT_REFUSED(parse_urdf("<robot name=\"r\">" + deep), "nested deeper than 100 levels");
  std::string attributes;  // the parser compares each with all before it
  for (int i = 0; i < 500'000; ++i) attributes += " a" + std::to_string(i) + "='>'";
  for (const char* before :
       {"", "<a b='>' c=\"'\"/>", "<!-- ' -->", "it's", "<![CDATA[ <a ' ]]>"}) {
    EXPECT_REFUSED(parse_urdf(robot(std::string(before) + "\n<link" + attributes + "/>")),
                   "a.urdf:3: a tag has more than 100 attributes");
  }
  // A "billion laughs": entities are not expanded, so the name stays short.
  std::string laughs = "<!DOCTYPE robot [<!ENTITY l0 \"ha\">";
  for (int i = 1; i < 30; ++i) {
    const std::string before = "&l" + std::to_string(i - 1) + ";";
    laughs += "<!ENTITY l" + std::to_string(i) + " \"" + before + before + before + "\">";
  }
  laughs += "]>\n" + robot(link("&l29;") + link("b") + joint("j", "revolute", "&l29;", "b"));
  EXPECT_EQ(internal::parse_urdf(laughs, "a.urdf").links.at(0).name, "&l29;");
}

TEST(Urdf, LongChainsAreReadAndEndlessOnesRefused) {
  std::string text = link("l0");
  for (int i = 1; i <= 10001; ++i) {
    text +=
        link("l" + std::to_string(i)) + joint("j" + std::to_string(i), "revolute",
                                              "l" + std::to_string(i - 1), "l" + std::to_string(i));
  }
  EXPECT_EQ(parse_urdf(robot(text), {.base = "", .tip = "l100"}).dof(), 100);
  EXPECT_REFUSED(parse_urdf(robot(text)), "has more than 100 moving joints");
}

TEST(Urdf, IsReadFromAFile) {
  const testing::TemporaryFolder folder;
  EXPECT_EQ(read_urdf(folder.write("a.urdf", single("revolute"))).dof(), 1);
  EXPECT_REFUSED(read_urdf(folder.file("none.urdf")), "none.urdf: cannot be read");
}

}  // namespace
}  // namespace beeline
