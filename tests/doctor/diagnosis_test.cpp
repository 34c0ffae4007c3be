#include <gtest/gtest.h>

#include <beeline/doctor/diagnosis.h>
#include <beeline/model/catalog.h>

#include <tests/io/text/urdf_samples.h>
#include <tests/random_table.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline {
namespace {

using testing::arm_of_rows;
using testing::random_rows;

std::vector<FindingKind> kinds(const Diagnosis& diagnosis) {
  std::vector<FindingKind> found;
  for (const Finding& finding : diagnosis.findings) found.push_back(finding.kind);
  return found;
}

TEST(Diagnosis, NothingIsSuspiciousInBuiltInArms) {
  for (const std::string& name : built_in_names()) {
    EXPECT_TRUE(diagnose(built_in(name))) << name;
    EXPECT_TRUE(diagnose(name)) << name;
  }
}

TEST(Diagnosis, NothingIsSuspiciousInRandomTables) {
  testing::Random random;
  for (int trial = 0; trial < testing::cases(300); ++trial) {
    const Arm arm = arm_of_rows(random_rows(random, random.integer(2, 8)), DhConvention::standard);
    const Diagnosis diagnosis = diagnose(arm);
    EXPECT_TRUE(diagnosis) << "trial " << trial << ' ' << diagnosis.findings.front().what;
  }
}

/// A right angle with few digits in one row of a random table.
TEST(Diagnosis, ARoundedRightAngleIsFoundAtItsJoint) {
  testing::Random random;
  constexpr double angles[] = {1.57, -1.571, 1.5708, -1.57079, 1.570796};
  for (int trial = 0; trial < testing::cases(300); ++trial) {
    const int joints = random.integer(2, 8), joint = random.integer(0, joints - 1);
    std::vector<DhRow> rows = random_rows(random, joints);
    rows[joint].alpha = angles[random.integer(0, 4)];
    const Diagnosis diagnosis = diagnose(arm_of_rows(rows, DhConvention::modified));
    ASSERT_EQ(kinds(diagnosis), std::vector{FindingKind::rounded_angle}) << "trial " << trial;
    EXPECT_EQ(diagnosis.findings.front().joint, joint);
  }
}

TEST(Diagnosis, TheMethodThatNearlySpecialAxesCostIsNamed) {
  const Arm ur5 = built_in("ur5");
  std::vector<Joint> joints = ur5.joints();
  joints[2].offset = joints[2].offset * Eigen::AngleAxisd(1e-4, Vector3::UnitX());
  const Diagnosis diagnosis = diagnose(Arm("tilted", joints, ur5.tool()));
  ASSERT_EQ(kinds(diagnosis), std::vector{FindingKind::nearly_special});
  EXPECT_NE(diagnosis.findings.front().cost.find("three parallel axes"), std::string::npos)
      << diagnosis.findings.front().cost;
}

TEST(Diagnosis, LimitsAndLengthsInOtherUnitsAreFound) {
  std::vector<Joint> joints = built_in("panda").joints();
  for (Joint& joint : joints) {
    joint.limits.lower *= 180 / std::numbers::pi;
    joint.limits.upper *= 180 / std::numbers::pi;
  }
  EXPECT_EQ(kinds(diagnose(Arm("degrees", joints))), std::vector{FindingKind::angle_unit});
  joints = built_in("panda").joints();
  for (Joint& joint : joints) joint.limits.velocity *= 180 / std::numbers::pi;
  EXPECT_EQ(kinds(diagnose(Arm("degrees", joints))), std::vector{FindingKind::angle_unit});
  joints = built_in("panda").joints();
  for (Joint& joint : joints) joint.offset.translation() *= 1000;
  EXPECT_EQ(kinds(diagnose(Arm("millimetres", joints))), std::vector{FindingKind::length_unit});
}

/// A table with angles in degrees: what the file declares is believed, in its own unit.
TEST(Diagnosis, DegreesAreBelievedWhereTheTableDeclaresThem) {
  const testing::TemporaryFolder folder;
  const auto diagnosed = [&](const std::string& rows) {
    const std::string text =
        R"({"name": "t", "dh": {"convention": "standard", "degrees": true, "rows": [)" + rows +
        "]}}";
    return diagnose(folder.write("t.json", text));
  };
  EXPECT_TRUE(diagnosed(R"({"d": 0.3, "alpha": 90}, {"a": 0.4}, {"a": 0.3})"));
  EXPECT_TRUE(diagnosed(R"({"d": 0.3, "alpha": -90, "theta": 270}, {"a": 0.4}, {"a": 0.3})"));
  EXPECT_TRUE(diagnosed(R"({"a": 0.3, "limits": {"lower": -7200, "upper": 7200,
                        "velocity": 5000}}, {"a": 0.4, "limits": {"velocity": 100}})"));
  const Diagnosis twice = diagnosed(R"({"d": 0.3, "alpha": 5156.62015617741}, {"a": 0.4})");
  ASSERT_EQ(kinds(twice), std::vector{FindingKind::angle_unit});
  EXPECT_NE(twice.findings.front().what.find("alpha 5156.62 deg"), std::string::npos);
  EXPECT_EQ(twice.findings.front().remedy, "in degrees: 90");
  const Diagnosis radians = diagnosed(
      R"({"a": 0.4, "limits": {"lower": -1.5, "upper": 1.5, "velocity": 90}},
         {"a": 0.3, "limits": {"lower": -2.5, "upper": 2.5, "velocity": 90}},
         {"a": 0.3, "limits": {"lower": -2.5, "upper": 2.5, "velocity": 90}})");
  ASSERT_EQ(kinds(radians), std::vector{FindingKind::angle_unit});
  EXPECT_EQ(radians.findings.front().remedy, "write the limits in degrees");
}

TEST(Diagnosis, FaultsBesideTheChainAreFound) {
  const testing::TemporaryFolder folder;
  const std::string path = folder.write(
      "r.urdf",
      testing::robot(testing::link("a") + testing::link("b") +
                     testing::joint("j", "continuous", "a", "b", "<axis xyz=\"0 0 1\"/>") +
                     testing::joint("camera", "fixed", "nowhere", "b")));
  const Diagnosis diagnosis = diagnose(path);
  ASSERT_EQ(kinds(diagnosis), std::vector{FindingKind::fault});
  EXPECT_EQ(diagnosis.findings.front().place, "line 5");
  EXPECT_EQ(name(FindingKind::fault), "fault");
}

/// A file with several faults, of which the chain has some: all are listed, in the order of lines.
TEST(Diagnosis, AllFaultsOfAFileAreListedAlsoWithoutAChain) {
  using testing::joint, testing::link;
  const testing::TemporaryFolder folder;
  const std::string path = folder.write(
      "r.urdf",
      testing::robot(link("a") + link("b") + link("c") + link("d") + link("e") +
                     joint("ab", "revolute", "a", "b", "<limit lower=\"2\" upper=\"1\"/>") +
                     joint("bc", "revolut", "b", "c") +
                     joint("cd", "revolute", "c", "d", "<axis xyz=\"0 0 0\"/>") +
                     joint("de", "revolute", "d", "e", "<mimic joint=\"no\"/>") +
                     joint("lost", "fixed", "nowhere", "f") + link("e")));
  EXPECT_REFUSED(diagnose(path), "r.urdf:12: two links have the name e");
  const std::vector<Finding> faults = file_faults(path);
  std::vector<std::string> places;
  for (const Finding& fault : faults) {
    EXPECT_EQ(fault.kind, FindingKind::fault);
    EXPECT_FALSE(fault.remedy.empty());
    places.push_back(fault.place);
  }
  EXPECT_EQ(places, (std::vector<std::string>{"line 7", "line 8", "line 9", "line 10", "line 11",
                                              "line 12"}));
  EXPECT_EQ(faults[0].what, "joint ab: lower limit 2 exceeds upper limit 1");
  EXPECT_TRUE(file_faults("panda").empty());
}

TEST(Diagnosis, FaultsBesideTheChainAreListedUpToAHundred) {
  using testing::joint, testing::link;
  const testing::TemporaryFolder folder;
  std::string text =
      link("a") + link("b") + joint("j", "continuous", "a", "b", "<axis xyz=\"0 0 1\"/>");
  for (int i = 0; i < 130; ++i) {
    const std::string name = "x" + std::to_string(i);
    text += link(name) + joint(name, "ball", "a", name);
  }
  const std::string path = folder.write("r.urdf", testing::robot(text));
  const Diagnosis diagnosis = diagnose(path, {.tip = "b"});
  ASSERT_EQ(diagnosis.findings.size(), 101u);
  EXPECT_EQ(diagnosis.findings[99].place, "line 204");
  EXPECT_EQ(diagnosis.findings.back().what, "has 30 more faults");
}

TEST(Diagnosis, NoNumberIsMinusZero) {
  std::vector<Joint> joints = built_in("ur5").joints();
  joints[3].limits.lower = joints[3].limits.upper = -0.0;
  const Diagnosis diagnosis = diagnose(Arm("fixed", joints));
  EXPECT_EQ(diagnosis.findings.front().what.find("-0"), std::string::npos);
  EXPECT_EQ(number(-0.0), "0");
  EXPECT_EQ(angle(-0.0), "0 rad (0 deg)");
}

TEST(Diagnosis, AJointThatIsThereTwiceOrCannotMoveIsFound) {
  testing::Random random;
  std::vector<DhRow> rows = random_rows(random, 5);
  rows[2] = {};
  const Diagnosis twice = diagnose(arm_of_rows(rows, DhConvention::standard));
  EXPECT_EQ(kinds(twice), std::vector{FindingKind::coincident_axes});
  std::vector<Joint> joints = built_in("ur5").joints();
  joints[3].limits.lower = joints[3].limits.upper = 0;
  const Diagnosis fixed = diagnose(Arm("fixed", joints));
  ASSERT_EQ(kinds(fixed), std::vector{FindingKind::no_range});
  EXPECT_EQ(fixed.findings.front().joint, 3);
}

}  // namespace
}  // namespace beeline
