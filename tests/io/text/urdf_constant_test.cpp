#include <gtest/gtest.h>

#include <beeline/io/text/numbers.h>
#include <beeline/kinematics/forward.h>

#include <tests/io/text/urdf_reading.h>
#include <tests/random.h>
#include <tests/refusal.h>

// Mimic joints that follow a fixed joint.

namespace beeline {
namespace {

using testing::joint;
using testing::link;

std::string mimic(const std::string& leader, double multiplier, double offset) {
  return "<mimic joint=\"" + leader + "\" multiplier=\"" + exact(multiplier) + "\" offset=\"" +
         exact(offset) + "\"/>";
}

/// The arm whose joint `c` is constant is the arm with `c` free, at that value.
TEST(UrdfConstant, AJointThatFollowsAFixedOneIsConstant) {
  testing::Random random;
  for (int i = 0; i < testing::cases(150); ++i) {
    const char* const types[] = {"revolute", "continuous", "prismatic"};
    const std::string type = types[random.integer(0, 2)];
    const double m = random.uniform(-2, 2), o = random.uniform(-4, 4);
    const double m2 = random.uniform(-2, 2), o2 = random.uniform(-4, 4);
    const bool indirect = random.integer(0, 1) == 0;
    const Vector3 axis = random.direction(), xyz = random.vector();
    const auto three = [](const Vector3& v) {
      return exact(v.x()) + " " + exact(v.y()) + " " + exact(v.z());
    };
    const std::string inside = "<origin xyz=\"" + three(xyz) +
                               "\" rpy=\"0.3 0.2 0.1\"/><axis xyz=\"" + three(axis) + "\"/>";
    const auto text = [&](const std::string& follows) {
      return link("a") + link("b") + link("c") + link("d") + link("e") + link("f") +
             joint("ab", "revolute", "a", "b") + joint("c", type, "b", "c", inside + follows) +
             joint("cd", "prismatic", "c", "d") + joint("rigid", "fixed", "a", "e") +
             joint("between", "revolute", "a", "f", mimic("rigid", m2, o2));
    };
    const bool up = random.integer(0, 1) == 0;
    const ChainEnds ends =
        up ? ChainEnds{.base = "d", .tip = "a"} : ChainEnds{.base = "a", .tip = "d"};
    std::vector<ReadWarning> warnings;
    const Arm arm = arm_from_urdf(testing::robot(text(mimic(indirect ? "between" : "rigid", m, o))),
                                  "a.urdf", ends, &warnings);
    ASSERT_EQ(arm.dof(), 2);
    ASSERT_EQ(arm.joints().size(), 2u);
    const double value = indirect ? m * o2 + o : o;
    ASSERT_EQ(warnings.size(), indirect ? 2u : 2u);  // of `between` too
    const ReadWarning& warning = warnings.front();
    EXPECT_EQ(warning.kind, ReadWarningKind::constant_mimic);
    EXPECT_EQ(warning.joint, "c");
    EXPECT_EQ(warning.value, "rigid");
    EXPECT_NEAR(warning.numbers.at(0), value, 1e-12);
    EXPECT_TRUE(is_fault(warning));
    EXPECT_NE(
        sentence(warning).find("joint c mimics joint rigid, which is fixed: it is constant at "),
        std::string::npos)
        << sentence(warning);
    const Arm free = arm_from_urdf(testing::robot(text("")), "a.urdf", ends);
    const double first = random.uniform(-3, 3), last = random.uniform(-1, 1);
    ASSERT_TRUE(forward_kinematics(arm, Eigen::Vector2d(first, last))
                    .isApprox(forward_kinematics(free, Vector3(first, value, last)), 1e-9))
        << type;
  }
}

TEST(UrdfConstant, ALeaderThatIsFreeIsRefused) {
  for (const std::string type : {"floating", "planar"}) {
    EXPECT_REFUSED(
        testing::read(testing::arm + link("d") + link("e") + joint("free", type, "a", "d") +
                          joint("ce", "revolute", "c", "e", mimic("free", 1, 0)),
                      {.tip = "e"}),
        "joint ce mimics joint free, which is " + type + " and has several coordinates");
  }
}

/// The known names are listed by the first warning of a kind only.
TEST(UrdfConstant, KnownNamesAreListedOnce) {
  const testing::Read result =
      testing::read(testing::arm + link("d") + link("e") +
                        joint("cd", "revolute", "c", "d", mimic("nowhere", 1, 0)) +
                        joint("ce", "revolute", "c", "e", mimic("ab_", 1, 0)),
                    {.tip = "c"});
  ASSERT_EQ(result.warnings.size(), 2u);
  EXPECT_NE(sentence(result.warnings[0]).find("(known: ab, bc, cd, ce)"), std::string::npos);
  const std::string second = sentence(result.warnings[1]);
  EXPECT_EQ(second.find("known:"), std::string::npos) << second;
  EXPECT_NE(second.find("did you mean \"ab\"?"), std::string::npos) << second;
}

/// Two fingers by structure, whatever their names.
TEST(UrdfConstant, APalmIsOfferedForFingersWithoutTheirWords) {
  const auto limit = [](double lower, double upper) {
    return "<limit lower=\"" + exact(lower) + "\" upper=\"" + exact(upper) +
           "\" velocity=\"1\" effort=\"1\"/>";
  };
  const std::string base =
      testing::arm + link("palm") + link("p") + link("q") + joint("fix", "fixed", "c", "palm");
  const auto two = [&](const std::string& p, const std::string& q, const std::string& type,
                       const std::string& other_type) {
    return base + joint("j1", type, "palm", "p", p) + joint("j2", other_type, "palm", "q", q);
  };
  const std::string offer = "; tip=\"palm\" (--tip palm) ends before the gripper";
  for (const std::string& text :
       {two(limit(0, 0.04), limit(0, 0.04), "prismatic", "prismatic"),
        two(limit(0, 0.04), limit(-0.04, 0), "prismatic", "prismatic"),
        two(limit(0, 0.04), mimic("j1", -1, 0), "prismatic", "prismatic"),
        two(mimic("j2", 1, 0), limit(0, 1), "revolute", "revolute"),
        two(mimic("ab", 1, 0), mimic("ab", -1, 0), "revolute", "prismatic"),
        base + link("p2") + link("q2") + joint("j1", "revolute", "palm", "p", limit(0, 1)) +
            joint("j2", "revolute", "palm", "q", mimic("j1", 1, 0)) +
            joint("j3", "revolute", "p", "p2", mimic("j1", -1, 0)) +
            joint("j4", "revolute", "q", "q2", mimic("j3", 1, 0))}) {
    EXPECT_REFUSED(testing::read(text), offer);
  }
  for (const std::string& text : {two(limit(0, 1), limit(0, 1), "revolute", "revolute"),
                                  two(limit(0, 0.04), limit(0, 0.5), "prismatic", "prismatic"),
                                  two("", "", "prismatic", "prismatic"),
                                  two(limit(0, 0.04), limit(0, 0.04), "prismatic", "revolute")}) {
    const std::string message = testing::refusal([&] { testing::read(text); });
    EXPECT_NE(message.find("has 2 tips"), std::string::npos) << message;
    EXPECT_EQ(message.find("ends before"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace beeline
