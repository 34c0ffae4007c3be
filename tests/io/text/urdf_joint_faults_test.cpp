#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include <beeline/io/text/urdf.h>

#include <tests/io/text/urdf_reading.h>
#include <tests/random.h>
#include <tests/refusal.h>

// Faults of a joint's values: its type, axis, limits and leader.

namespace beeline {
namespace {

using testing::arm;
using testing::joint;
using testing::Kinds;
using testing::link;
using testing::Read;
using testing::read;
using testing::robot;

/// A joint with a fault: what it contains, and the message if it is on the chain.
struct JointFault {
  std::string type, inside;
  ReadWarningKind kind;
  std::vector<double> numbers;
  std::string value, message;
};

std::vector<JointFault> joint_faults() {
  using Kind = ReadWarningKind;
  return {
      {"ball", "", Kind::unknown_type, {}, "ball", "joint f is \"ball\""},
      {"Revolute", "", Kind::unknown_type, {}, "Revolute", "joint f is \"Revolute\""},
      {"", "", Kind::unknown_type, {}, "", "joint f is \"\""},
      {"prismatic",
       "<axis xyz=\"0 0 0\"/>",
       Kind::zero_axis,
       {0, 0, 0},
       "",
       "joint f: axis 0 0 0 has no direction"},
      {"revolute",
       "<axis xyz=\"0 1e-12 0\"/>",
       Kind::zero_axis,
       {0, 1e-12, 0},
       "",
       "joint f: axis 0 1e-12 0 has no direction"},
      {"revolute",
       "<limit lower=\"2\" upper=\"-1\" velocity=\"1\"/>",
       Kind::limits_reversed,
       {2, -1},
       "",
       "joint f: lower limit 2 exceeds upper limit -1"},
      {"prismatic",
       "<limit lower=\"0.1\" velocity=\"1\"/>",
       Kind::limits_reversed,
       {0.1, 0},
       "",
       "joint f: lower limit 0.1 exceeds upper limit 0"},
      {"continuous",
       "<limit velocity=\"-3\"/>",
       Kind::rate_limit,
       {-3},
       "",
       "joint f: velocity limit -3 is below 1e-09; 0 and -1 stand for none"},
      {"revolute",
       "<limit lower=\"-1\" upper=\"1\" acceleration=\"1e-10\"/>",
       Kind::rate_limit,
       {1e-10},
       "",
       "joint f: acceleration limit 1e-10 is below 1e-09; 0 and -1 stand for none"},
      {"prismatic",
       "<limit lower=\"-1\" upper=\"1\" jerk=\"-2\"/>",
       Kind::rate_limit,
       {-2},
       "",
       "joint f: jerk limit -2 is below 1e-09; 0 and -1 stand for none"},
      {"revolute",
       "<mimic joint=\"abb\"/>",
       Kind::unknown_leader,
       {},
       "abb",
       "joint f mimics an unknown joint \"abb\"; did you mean \"ab\"?"},
      {"revolute", "<mimic joint=\"f\"/>", Kind::leader_cycle, {}, "f", "joint f mimics itself"},
  };
}

TEST(UrdfJointFaults, BesideTheChainAreWarningsWithTheirNumbers) {
  for (const JointFault& fault : joint_faults()) {
    for (const std::string tip : {"c", "x"}) {
      const std::string text = arm + link("x") + joint("f", fault.type, "b", "x", fault.inside);
      if (tip == "x") {
        EXPECT_REFUSED(read(text, {.tip = tip}), "a.urdf:8: " + fault.message);
        continue;
      }
      const Read result = read(text, {.tip = tip});
      EXPECT_EQ(result.dof, 2);
      ASSERT_EQ(result.kinds, Kinds{fault.kind}) << text;
      const ReadWarning& warning = result.warnings.front();
      EXPECT_TRUE(is_fault(warning));
      EXPECT_EQ(warning.line, 8);
      EXPECT_EQ(warning.joint, "f");
      EXPECT_EQ(warning.numbers, fault.numbers);
      EXPECT_EQ(warning.value, fault.value);
      EXPECT_TRUE(sentence(warning).starts_with("a.urdf:8: joint f")) << sentence(warning);
      EXPECT_TRUE(sentence(warning).ends_with("; the joint is beside the chain"));
    }
  }
}

/// What is allowed, and no fault: a fixed joint's axis of zeros, a limit of 0 to 0, free joints.
TEST(UrdfJointFaults, AreNotFoundInJointsThatMayBeMeant) {
  for (const auto& [type, inside] : std::vector<std::pair<std::string, std::string>>{
           {"fixed", "<axis xyz=\"0 0 0\"/><limit lower=\"1\" upper=\"0\"/>"},
           {"fixed", "<mimic joint=\"nobody\"/>"},
           {"floating", "<axis xyz=\"0 0 0\"/>"},
           {"planar", ""},
           {"revolute", "<limit/>"},
           {"revolute", "<limit velocity=\"-1\" acceleration=\"-1\" jerk=\"0\"/>"},
           {"continuous", "<limit lower=\"2\" upper=\"1\"/>"},
           {"revolute", "<mimic joint=\"ab\"/>"}}) {
    const std::string text = arm + link("x") + joint("f", type, "b", "x", inside);
    EXPECT_EQ(read(text, {.tip = "c"}).kinds, Kinds{}) << text;
  }
}

/// Random leaders: the joints whose leaders have no last one are those from which n steps do not
/// end.
TEST(UrdfJointFaults, LeadersThatMimicEachOtherAreFoundInAnyGraph) {
  testing::Random random;
  int endless = 0;
  for (int i = 0; i < testing::cases(600); ++i) {
    const int n = random.integer(1, 12);
    std::vector<int> leader;
    std::string text = arm;
    for (int k = 0; k < n; ++k) {
      leader.push_back(random.integer(-2, n - 1));  // -1: none, -2: unknown
      const std::string name = std::to_string(k);
      const std::string of = leader[k] == -2 ? "nobody" : std::to_string(leader[k]);
      text += link("l" + name) + joint(name, "revolute", "a", "l" + name,
                                       leader[k] == -1 ? "" : "<mimic joint=\"" + of + "\"/>");
    }
    std::set<std::string> expected, unknown;
    for (int k = 0; k < n; ++k) {
      int last = k;
      for (int step = 0; step <= n && last >= 0; ++step) last = leader[last];
      if (last >= 0) expected.insert(std::to_string(k));
      if (leader[k] == -2) unknown.insert(std::to_string(k));
    }
    std::vector<ReadWarning> warnings;
    (void)arm_from_urdf(robot(text), "a.urdf", {.tip = "c"}, &warnings);
    std::set<std::string> cycles, lost;
    for (const ReadWarning& warning : warnings) {
      if (warning.kind == ReadWarningKind::leader_cycle) cycles.insert(warning.joint);
      if (warning.kind == ReadWarningKind::unknown_leader) lost.insert(warning.joint);
    }
    if (warnings.size() > 10) continue;  // not all are listed
    EXPECT_EQ(cycles, expected) << text;
    EXPECT_EQ(lost, unknown) << text;
    endless += static_cast<int>(expected.size());
    for (int k = 0; k < n; ++k) {  // on the chain each is an error
      const std::string name = std::to_string(k);
      if (expected.contains(name) || unknown.contains(name)) {
        EXPECT_REFUSED(read(text, {.tip = "l" + name}), "joint " + name + " ");
      } else {
        EXPECT_EQ(read(text, {.tip = "l" + name}).dof, 1) << text;
      }
    }
  }
  EXPECT_GT(endless, testing::cases(600) / 4);
}

/// A long chain of leaders: time is linear.
TEST(UrdfJointFaults, OfManyLeadersAreFoundInLinearTime) {
  constexpr int count = 20'000;
  std::string text = arm;
  for (int k = 0; k < count; ++k) {
    const std::string name = std::to_string(k), next = std::to_string((k + 1) % count);
    text += link("l" + name) +
            joint(name, "revolute", "a", "l" + name, "<mimic joint=\"" + next + "\"/>");
  }
  const Read result = read(text, {.tip = "c"});
  EXPECT_EQ(result.kinds.front(), ReadWarningKind::leader_cycle);
  EXPECT_EQ(result.warnings.back().count, static_cast<std::size_t>(count) - 10);
}

}  // namespace
}  // namespace beeline
