#include <gtest/gtest.h>
#include <iomanip>
#include <sstream>

#include <beeline/io/text/urdf.h>
#include <beeline/pose/se3.h>

#include <tests/io/text/urdf_reading.h>
#include <tests/random.h>
#include <tests/refusal.h>

// Values and elements that stand elsewhere than where URDF 1.0 has them.

namespace beeline {
namespace {

using testing::arm;
using testing::joint;
using testing::link;
using testing::read;
using testing::robot;

std::string one_joint(const std::string& inside) {
  return link("a") + link("b") + joint("ab", "revolute", "a", "b", inside);
}

std::string written_number(double value) {
  std::ostringstream text;
  text << std::setprecision(17) << value;
  return text.str();
}

/// The quaternion of URDF 1.2 gives the same origin as the angles of URDF 1.0.
TEST(UrdfElements, AQuaternionIsAnOrientation) {
  testing::Random random;
  for (int i = 0; i < testing::cases(300); ++i) {
    const RollPitchYaw rpy{random.uniform(-3, 3), random.uniform(-1.5, 1.5), random.uniform(-3, 3)};
    const Quaternion q = quaternion(rotation(rpy));
    const std::string front = "<origin xyz=\"1 2 3\" ";
    const auto origin = [&](const std::string& orientation) {
      const Arm arm = arm_from_urdf(robot(one_joint(front + orientation + "/>")), "a.urdf");
      return arm.joints().front().offset;
    };
    const Pose angles = origin("rpy=\"" + written_number(rpy.roll) + " " +
                               written_number(rpy.pitch) + " " + written_number(rpy.yaw) + "\"");
    const Pose numbers = origin("quat_xyzw=\"" + written_number(q.qx) + " " + written_number(q.qy) +
                                " " + written_number(q.qz) + " " + written_number(q.qw) + "\"");
    EXPECT_LT((angles.matrix() - numbers.matrix()).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(UrdfElements, AQuaternionThatIsNoOrientationIsAFault) {
  const auto refused = [](const std::string& attributes, const std::string& why) {
    const std::string origin = "<origin " + attributes + "/>";
    EXPECT_REFUSED(read(one_joint(origin)), "a.urdf:4: <origin>: " + why);
    // Beside the chain it is a warning.
    const auto beside = read(arm + link("x") + joint("f", "fixed", "a", "x", origin), {.tip = "c"});
    ASSERT_EQ(beside.warnings.size(), 1u);
    EXPECT_EQ(beside.warnings.front().kind, ReadWarningKind::malformed);
  };
  refused("quat_xyzw=\"0 0 0\"", "quat_xyzw has 3 numbers; it must have four, x y z w");
  refused("quat_xyzw=\"0 0 0 2\"", "the quaternion quat_xyzw \"0 0 0 2\" does not have length 1");
  refused("quat_xyzw=\"0 0 0 0\"", "the quaternion quat_xyzw \"0 0 0 0\" does not have length 1");
  refused("quat_xyzw=\"0 0 0 1\" rpy=\"0 0 0\"", "has both rpy and quat_xyzw; write one of them");
  refused("quat_xyzw=\"0 0 x 1\"", "quat_xyzw: \"x\" is not a number");
}

/// Values as text, as elements (SDFormat) or in attributes of other names would be lost in silence.
TEST(UrdfElements, ValuesElsewhereThanInTheirAttributesAreFaults) {
  for (const auto& [element, attribute] : std::vector<std::pair<std::string, std::string>>{
           {"<axis>0 0 1</axis>", "<axis> needs the attribute xyz"},
           {"<axis><xyz>0 0 1</xyz></axis>", "<axis> needs the attribute xyz"},
           {"<axis x=\"0\" y=\"0\" z=\"1\"/>", "<axis> needs the attribute xyz"},
           {"<axis XYZ=\"0 0 1\"/>", "<axis> needs the attribute xyz"},
           {"<origin>0 0 1</origin>", "<origin> needs the attribute xyz"},
           {"<origin x=\"1\"/>", "<origin> needs the attribute xyz"},
           {"<limit><lower>-1</lower></limit>", "<limit> needs the attribute lower"},
           {"<limit min=\"-1\" max=\"1\"/>", "<limit> needs the attribute lower"}}) {
    EXPECT_REFUSED(read(one_joint(element)), "a.urdf:4: " + attribute);
  }
  for (const std::string element :
       {"<axis/>", "<axis></axis>", "<limit/>", "<origin/>", "<origin rpy=\"0 0 1\"/>",
        "<axis><!-- 0 0 1 --></axis>", "<limit effort=\"1\"/>"}) {
    EXPECT_EQ(read(one_joint(element)).dof, 1) << element;
  }
}

TEST(UrdfElements, LinksThatAreSpelledOrNestedOtherwiseAreNamedWithTheirLine) {
  const auto refused = [](const std::string& elements, const std::string& found) {
    EXPECT_REFUSED(read("\n" + elements),
                   "a.urdf:3: has no <link> directly in <robot>, but " + found);
  };
  refused("<Link name=\"a\"/>", "<Link> in <robot>");
  refused("<u:link name=\"a\"/>", "<u:link> in <robot>");
  refused("<group><link name=\"a\"/></group>", "<link> in <group>");
  EXPECT_REFUSED(read("<part/>"), "a.urdf: has no links");
}

/// What parts the tree is named in place of the roots that it leaves.
TEST(UrdfElements, SeveralRootsHaveTheirCause) {
  const std::string links = link("a") + link("b");
  const auto only_joint = [&](const std::string& ends) {
    return links + "<joint name=\"j\" type=\"revolute\"" + ends;
  };
  EXPECT_REFUSED(read(links), "a.urdf: has links, but no joints between them");
  EXPECT_REFUSED(read(only_joint("><parent>a</parent><child>b</child></joint>")),
                 "a.urdf:4: <parent> needs the attribute link");
  EXPECT_REFUSED(read(only_joint(" parent=\"a\" child=\"b\"/>")),
                 "a.urdf:4: joint \"j\" needs a <parent link=...>");
  EXPECT_REFUSED(read(link("a") + link(" b") + link("c") + joint("ab", "revolute", "a", "b") +
                      joint("bc", "revolute", "b", "c")),
                 "a.urdf:5: joint ab has an unknown child link \"b\"");
  EXPECT_REFUSED(read(arm + link("x") + link("y") + joint("xy", "revolute", "x", "y")),
                 "has 2 roots; choose the base: a, x");
}

TEST(UrdfElements, WordsAreNoLimits) {
  for (const std::string word : {"unlimited", "none", "no limit", "-DBL_MAX", "null", "pi"}) {
    EXPECT_REFUSED(read(one_joint("<limit lower=\"" + word + "\"/>")),
                   "is not a limit; a limit is a number, or inf for none");
  }
  EXPECT_REFUSED(read(one_joint("<limit lower=\"-1,5\"/>")), "\"-1,5\" is not a number");
}

}  // namespace
}  // namespace beeline
