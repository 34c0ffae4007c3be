#include <gtest/gtest.h>

#include <beeline/io/text/arm.h>
#include <beeline/io/text/urdf.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include <tests/random_arm.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

// Arms written as files and read again. tests/peers compares the files with Pinocchio and MuJoCo.

namespace beeline {
namespace {

constexpr ArmFileFormat tree_formats[] = {ArmFileFormat::urdf, ArmFileFormat::mjcf};
constexpr double tolerance = 1e-12;

std::string path_in(ArmFileFormat format) {
  return format == ArmFileFormat::json   ? "a.json"
         : format == ArmFileFormat::urdf ? "a.urdf"
                                         : "a.xml";
}

Arm read_back(const ArmFile& file, ArmFileFormat format,
              std::vector<ReadWarning>* warnings = nullptr) {
  return arm_from_text(file.text, path_in(format), {.tip = file.tip}, warnings);
}

void expect_same_limits(const Limits& a, const Limits& b, bool rates) {
  EXPECT_EQ(a.lower, b.lower);
  EXPECT_EQ(a.upper, b.upper);
  EXPECT_EQ(a.velocity, rates ? b.velocity : Limits::none);
  EXPECT_EQ(a.acceleration, rates ? b.acceleration : Limits::none);
  EXPECT_EQ(a.jerk, rates ? b.jerk : Limits::none);
}

/// Expects that the file of an arm is read as the same arm without a warning. Returns the largest
/// difference of poses.
double round_trip(const Arm& arm, ArmFileFormat format, testing::Random& random) {
  const ArmFile file = arm_file(arm, format);
  EXPECT_TRUE(file) << arm.name();
  if (!file) return 0;
  std::vector<ReadWarning> warnings;
  const Arm read = read_back(file, format, &warnings);
  EXPECT_TRUE(warnings.empty()) << arm.name() << ": " << sentence(warnings.front());
  EXPECT_EQ(read.name(), arm.name());
  EXPECT_EQ(read.joint_names(), arm.joint_names());
  EXPECT_EQ(read.joints().size(), arm.joints().size());
  if (read.joints().size() != arm.joints().size()) return 0;
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    const Joint &a = read.joints()[i], &b = arm.joints()[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(kind(a), kind(b));
    EXPECT_EQ(a.mimic.has_value(), b.mimic.has_value());
    if (!b.link.empty()) {
      EXPECT_EQ(a.link, b.link);
    }
    expect_same_limits(a.limits, b.limits, format != ArmFileFormat::mjcf);
  }
  const ControllerFrames& controller = arm.controller();
  const bool json = format == ArmFileFormat::json;
  const bool same_base = json || controller.base.matrix().isIdentity(0);
  const bool same_flange = json || controller.flange.matrix() == arm.tool().matrix();
  EXPECT_EQ(read.controller().base_assumed, controller.base_assumed && same_base);
  EXPECT_EQ(read.controller().flange_assumed, controller.flange_assumed && same_flange);
  double largest = 0;
  for (int k = 0; k < 20; ++k) {
    const Configuration q = random.configuration(arm);
    const Pose pose = forward_kinematics(arm, q);
    largest = std::max(
        largest, (forward_kinematics(read, q).matrix() - pose.matrix()).cwiseAbs().maxCoeff());
    const auto in_flange = [](const Arm& of) {
      return Pose(of.controller().flange.inverse() * of.tool());
    };
    EXPECT_LT((in_flange(read).matrix() - in_flange(arm).matrix()).norm(), tolerance);
    EXPECT_LT((read.controller().base.matrix() - controller.base.matrix()).norm(), tolerance);
  }
  return largest;
}

TEST(ArmFile, BuiltInArmsReadBack) {
  testing::Random random;
  for (const std::string& name : built_in_names()) {
    for (const ArmFileFormat format : tree_formats) {
      EXPECT_LT(round_trip(built_in(name), format, random), tolerance) << name;
    }
    EXPECT_EQ(round_trip(built_in(name), ArmFileFormat::json, random), 0) << name;
  }
}

TEST(ArmFile, RandomArmsReadBack) {
  testing::Random random;
  for (int i = 0; i < testing::cases(600); ++i) {
    std::vector<Joint> joints;
    const int n = random.integer(1, 8);
    for (int j = 0; j < n; ++j) {
      const auto kind = random.integer(0, 2) == 0 ? JointKind::prismatic : JointKind::revolute;
      Joint joint = testing::random_joint(random, kind, "j" + std::to_string(j));
      if (random.integer(0, 2) == 0) joint.limits.upper = Limits::none;
      if (random.integer(0, 2) == 0) joint.limits.lower = -Limits::none;
      if (random.integer(0, 1) == 0) joint.limits.velocity = random.uniform(0.1, 3);
      if (random.integer(0, 1) == 0) joint.limits.acceleration = random.uniform(0.1, 9);
      if (random.integer(0, 1) == 0) joint.limits.jerk = random.uniform(0.1, 90);
      if (j > 0 && random.integer(0, 3) == 0) {
        joint.limits = {};
        joint.mimic = Mimic{"j" + std::to_string(random.integer(0, j - 1)),
                            random.uniform(0.2, 1.5), random.uniform(-1, 1)};
      }
      if (random.integer(0, 1) == 0) joint.link = "l" + std::to_string(j);
      joints.push_back(joint);
    }
    std::optional<ControllerFrames> controller;
    const Pose tool = random.integer(0, 3) == 0 ? Pose::Identity() : random.pose();
    if (random.integer(0, 1) == 0) {
      controller = {.base = random.pose(),
                    .flange = random.integer(0, 1) == 0 ? tool : random.pose()};
    }
    const Pose base = random.integer(0, 1) == 0 ? Pose::Identity() : random.pose();
    Arm arm("random", joints, tool, base, controller);
    if (random.integer(0, 2) == 0) arm = with_tcp(arm, random.pose());
    if (random.integer(0, 2) == 0) arm = with_mount(arm, random.pose());
    for (const ArmFileFormat format : tree_formats) {
      ASSERT_LT(round_trip(arm, format, random), tolerance) << i;
    }
  }
}

TEST(ArmFile, RotationsNearGimbalLockReadBack) {
  testing::Random random;
  for (int i = 0; i < testing::cases(600); ++i) {
    Joint joint = testing::random_joint(random, JointKind::revolute, "j");
    const double off = std::pow(10, -random.uniform(1, 17));
    joint.offset.linear() = rotation(
        RollPitchYaw{random.uniform(-3, 3), 1.5707963267948966 - off, random.uniform(-3, 3)});
    EXPECT_LT(round_trip(Arm("a", {joint}), ArmFileFormat::urdf, random), tolerance) << off;
  }
}

/// Expects the gaps of a format.
void expect_gaps(const Arm& arm, ArmFileFormat format, const std::vector<ArmGapKind>& kinds) {
  const ArmFile file = arm_file(arm, format);
  std::vector<ArmGapKind> found;
  for (const ArmGap& gap : file.gaps) {
    found.push_back(gap.kind);
    EXPECT_FALSE(sentence(gap, format).empty());
  }
  EXPECT_EQ(found, kinds) << arm.name();
  EXPECT_EQ(static_cast<bool>(file), kinds.empty());
  EXPECT_EQ(file.text.empty(), !kinds.empty());
}

TEST(ArmFile, GapsOfTheFormatsAreNamed) {
  const Arm helical = arm_from_joint_string("RHR:1,0.2p0.05,1");
  Arm equal = with_limits(arm_from_joint_string("RR"), {{"joint2", {.lower = 0.5, .upper = 0.5}}});
  std::vector<Joint> joints = arm_from_joint_string("RR").joints();
  joints[0].link = joints[1].link = "world";
  const Arm named("named", joints);
  for (const ArmFileFormat format : tree_formats) {
    const bool mjcf = format == ArmFileFormat::mjcf;
    expect_gaps(helical, format, {ArmGapKind::helical_joint});
    expect_gaps(equal, format,
                mjcf ? std::vector{ArmGapKind::equal_limits} : std::vector<ArmGapKind>{});
    expect_gaps(named, format,
                mjcf ? std::vector{ArmGapKind::reserved_link, ArmGapKind::repeated_link,
                                   ArmGapKind::reserved_link, ArmGapKind::repeated_link}
                     : std::vector{ArmGapKind::repeated_link, ArmGapKind::repeated_link});
    expect_gaps(arm_from_joint_string(std::string(91, 'R')), format,
                mjcf ? std::vector{ArmGapKind::too_many_joints} : std::vector<ArmGapKind>{});
  }
  expect_gaps(helical, ArmFileFormat::json, {});
}

TEST(ArmFile, FramesOfTheControllerKeepTheirNames) {
  testing::Random random;
  std::vector<Joint> joints = arm_from_joint_string("RRR:1,1,0").joints();
  joints[2].link = "tool0";
  const Pose tool = random.pose();
  const Arm at_flange("a", joints, tool, Pose::Identity(), ControllerFrames{});
  for (const ArmFileFormat format : tree_formats) {
    EXPECT_LT(round_trip(at_flange, format, random), tolerance);
    expect_gaps(Arm("a", joints, tool, Pose::Identity(), ControllerFrames{.flange = tool}), format,
                {ArmGapKind::controller_frame});
  }
}

TEST(ArmFile, AssumedFramesOfTheControllerAreKept) {
  testing::Random random;
  for (const std::string& name : built_in_names()) {
    const Arm arm = with_mount(with_tcp(built_in(name), random.pose()), random.pose());
    for (const ArmFileFormat format : {ArmFileFormat::json, tree_formats[0], tree_formats[1]}) {
      EXPECT_LT(round_trip(arm, format, random), tolerance) << name;
    }
  }
}

TEST(ArmFile, AnAssumedFlangeIsNoLinkOfThatName) {
  testing::Random random;
  std::vector<Joint> joints = arm_from_joint_string("RRR:1,1,0").joints();
  joints[2].link = "tool0";
  const Arm with_tool("a", joints, random.pose());
  joints[2].link = "";
  joints[1].link = "tool0";  // not where the flange can be
  const Arm before("a", joints, random.pose());
  for (const ArmFileFormat format : tree_formats) {
    expect_gaps(with_tool, format, {ArmGapKind::controller_frame});
    EXPECT_LT(round_trip(before, format, random), tolerance);
  }
}

TEST(ArmFile, NamesOfLinksThatTheWriterUsesAreNotTaken) {
  testing::Random random;
  std::vector<Joint> joints = arm_from_joint_string("RRRR").joints();
  const char* names[] = {"base_link", "tool", "link4", ""};
  for (std::size_t i = 0; i < 4; ++i) joints[i].link = names[i];
  joints[0].name = "tool__joint";
  const Arm arm("a & b <\"c\"> d'é", joints, random.pose(), random.pose());
  for (const ArmFileFormat format : tree_formats) {
    EXPECT_LT(round_trip(arm, format, random), tolerance);
  }
}

TEST(ArmFile, JointsOfAGripperNeedTheTip) {
  testing::Random random;
  std::vector<Joint> joints = arm_from_joint_string("RRP").joints();
  joints[2].name = "finger_joint";
  const Arm arm("a", joints, random.pose());
  for (const ArmFileFormat format : tree_formats) {
    EXPECT_EQ(arm_file(arm, format).tip, "tool");
    EXPECT_LT(round_trip(arm, format, random), tolerance);
    EXPECT_EQ(arm_file(arm_from_joint_string("RRP"), format).tip, "");
  }
}

TEST(ArmFile, LimitsThatTheFormatLacksAreNamed) {
  EXPECT_EQ(arm_file(built_in("panda"), ArmFileFormat::mjcf).without_rates.size(), 7u);
  EXPECT_TRUE(arm_file(built_in("panda"), ArmFileFormat::urdf).without_rates.empty());
  EXPECT_TRUE(arm_file(built_in("rrr"), ArmFileFormat::mjcf).without_rates.empty());
}

TEST(ArmFile, WritesTheFormatOfTheEnding) {
  const testing::TemporaryFolder folder;
  const Arm arm = built_in("ur5");
  for (const char* name : {"a.json", "a.urdf", "a.xml", "a.MJCF"}) {
    write_arm(folder.file(name), arm);
    EXPECT_EQ(folder.content(name), arm_file(arm, arm_file_format(name)).text);
    EXPECT_EQ(read_arm(folder.file(name)).joint_names(), arm.joint_names());
  }
  EXPECT_NE(folder.content("a.xml").find("<mujoco"), std::string::npos);
  EXPECT_REFUSED(write_arm(folder.file("a.xacro"), arm), ".xml or .mjcf");
  EXPECT_REFUSED(write_arm(folder.file("b.urdf"), arm_from_joint_string("RHR:1,0.2p0.05,1")),
                 "joint2 is helical");
  EXPECT_REFUSED(write_arm(folder.file("b.urdf"), arm_from_joint_string("RHH:1,0.2p0.05,1p0.05")),
                 "joint3 is helical");
  EXPECT_REFUSED(write_arm(folder.file("c.urdf"), Arm("a\nb", arm.joints())), "the arm's name");
  EXPECT_EQ(folder.count(), 4u);
}

}  // namespace
}  // namespace beeline
