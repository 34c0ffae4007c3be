#include <gtest/gtest.h>
#include <map>

#include <beeline/io/text/numbers.h>
#include <beeline/io/text/urdf.h>
#include <beeline/kinematics/forward.h>
#include <beeline/pose/se3.h>

#include <tests/io/text/urdf_samples.h>
#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::joint;
using testing::link;
using testing::robot;

/// A joint of a random tree, with the position and angles of its origin as the file has them.
struct TreeJoint {
  std::string type;
  int parent = 0;  ///< number of its link; the child's is one more than the joint's index
  Vector3 xyz, rpy, axis;
  double lower = 0, upper = 0;
  int leader = -1;  ///< of a mimic joint
  double multiplier = 1, offset = 0;
};

std::string text_of(const Vector3& v) {
  return exact(v.x()) + " " + exact(v.y()) + " " + exact(v.z());
}

std::string name_of(std::size_t joint) { return "j" + std::to_string(joint); }

std::vector<TreeJoint> random_tree(testing::Random& random) {
  std::vector<TreeJoint> joints(static_cast<std::size_t>(random.integer(2, 14)));
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const char* const types[] = {"revolute", "continuous", "prismatic", "fixed"};
    joints[j] = {.type = types[random.integer(0, 3)],
                 .parent = random.integer(std::max(0, int(j) - 3), int(j)),
                 .xyz = random.vector(),
                 .rpy = random.vector(1.4),
                 .axis = random.direction(),
                 .lower = random.uniform(-2, 0.5),
                 .upper = random.uniform(0.6, 3)};
    if (joints[j].type == "fixed" || random.integer(0, 4) != 0) continue;
    const int leader = random.integer(0, int(j));
    if (leader == int(j) || joints[leader].type == "fixed") continue;
    joints[j].leader = leader;
    joints[j].multiplier = random.uniform(0.2, 1.5) * (random.integer(0, 1) == 0 ? -1 : 1);
    joints[j].offset = random.uniform(-0.3, 0.3);
    joints[j].lower = -100;
    joints[j].upper = 100;
  }
  return joints;
}

std::string urdf_of(const std::vector<TreeJoint>& joints) {
  std::string text = link("0");
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const TreeJoint& at = joints[j];
    std::string inside = "<origin xyz=\"" + text_of(at.xyz) + "\" rpy=\"" + text_of(at.rpy) +
                         "\"/><axis xyz=\"" + text_of(at.axis) + "\"/>";
    if (at.type != "fixed") {
      inside += "<limit velocity=\"2\" lower=\"" + exact(at.lower) + "\" upper=\"" +
                exact(at.upper) + "\"/>";
    }
    if (at.leader >= 0) {
      inside += "<mimic joint=\"" + name_of(at.leader) + "\" multiplier=\"" + exact(at.multiplier) +
                "\" offset=\"" + exact(at.offset) + "\"/>";
    }
    text += link(std::to_string(j + 1)) +
            joint(name_of(j), at.type, std::to_string(at.parent), std::to_string(j + 1), inside);
  }
  return robot(text);
}

Eigen::Matrix4d matrix_of(const Eigen::Matrix3d& rotation, const Vector3& translation) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = rotation;
  matrix.topRightCorner<3, 1>() = translation;
  return matrix;
}

/// The pose of every link in the root by products of 4x4 matrices, from the joints' values.
std::vector<Eigen::Matrix4d> link_matrices(const std::vector<TreeJoint>& joints,
                                           const std::vector<double>& values) {
  using Eigen::AngleAxisd;
  std::vector<Eigen::Matrix4d> root_T_link{Eigen::Matrix4d::Identity()};
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const TreeJoint& at = joints[j];
    const Eigen::Matrix3d turned =
        (AngleAxisd(at.rpy.z(), Vector3::UnitZ()) * AngleAxisd(at.rpy.y(), Vector3::UnitY()) *
         AngleAxisd(at.rpy.x(), Vector3::UnitX()))
            .toRotationMatrix();
    Eigen::Matrix4d motion = Eigen::Matrix4d::Identity();
    if (at.type == "prismatic") {
      motion = matrix_of(Eigen::Matrix3d::Identity(), values[j] * at.axis);
    } else if (at.type != "fixed") {
      motion = matrix_of(AngleAxisd(values[j], at.axis).toRotationMatrix(), Vector3::Zero());
    }
    root_T_link.push_back(root_T_link[at.parent] * matrix_of(turned, at.xyz) * motion);
  }
  return root_T_link;
}

std::size_t index_of(const std::string& joint) { return std::stoul(joint.substr(1)); }

/// The values of all joints of the tree when the arm has the configuration q. A coordinate of a
/// mimic joint determines the leaders beside the chain that it follows.
std::vector<double> joint_values(const std::vector<TreeJoint>& joints, const Arm& arm,
                                 const Configuration& q) {
  std::vector<double> values(joints.size(), 0.3);
  std::map<std::string, double> of_coordinate;
  for (int k = 0; k < arm.dof(); ++k) {
    of_coordinate[arm.joint_of(k).name] = q[k];
    double value = q[k];
    for (std::size_t j = index_of(arm.joint_of(k).name); joints[j].leader >= 0;) {
      value = (value - joints[j].offset) / joints[j].multiplier;
      j = static_cast<std::size_t>(joints[j].leader);
      values[j] = value;
    }
  }
  for (std::size_t j = 0; j < joints.size(); ++j) {  // leaders come first
    const TreeJoint& at = joints[j];
    const auto given = of_coordinate.find(name_of(j));
    if (given != of_coordinate.end()) {
      values[j] = given->second;
    } else if (at.leader >= 0) {
      values[j] = at.multiplier * values[at.leader] + at.offset;
    }
  }
  return values;
}

TEST(UrdfChain, AnyBaseAndTipGiveTheToolsPoseInTheBase) {
  testing::Random random;
  double largest = 0;
  int chains = 0, reversed = 0;
  for (int i = 0; i < testing::cases(1000); ++i) {
    const std::vector<TreeJoint> joints = random_tree(random);
    const std::string text = urdf_of(joints);
    const int base = random.integer(0, int(joints.size()));
    const int tip = random.integer(0, int(joints.size()));
    const ChainEnds ends{.base = std::to_string(base), .tip = std::to_string(tip)};
    if (testing::refusal([&] { (void)arm_from_urdf(text, "a.urdf", ends); }) != "accepted") {
      EXPECT_REFUSED(arm_from_urdf(text, "a.urdf", ends), "no moving joints between");
      continue;
    }
    const Arm arm = arm_from_urdf(text, "a.urdf", ends);
    ++chains;
    for (int k = 0; k < 5; ++k) {
      const Configuration q = random.configuration(arm);
      const std::vector<Eigen::Matrix4d> links =
          link_matrices(joints, joint_values(joints, arm, q));
      const Eigen::Matrix4d expected = links[base].inverse() * links[tip];
      const Eigen::Matrix4d found = forward_kinematics(arm, q).matrix();
      largest = std::max(largest, (found - expected).cwiseAbs().maxCoeff());
      const std::vector<Pose> poses = link_poses(arm, q);
      for (std::size_t j = 0; j < arm.joints().size(); ++j) {
        const Joint& at = arm.joints()[j];
        const std::size_t own = std::stoul(at.link);
        reversed += own != index_of(at.name) + 1 ? 1 : 0;
        const Eigen::Matrix4d frame = links[base].inverse() * links[own];
        largest = std::max(largest, (poses[j + 1].matrix() - frame).cwiseAbs().maxCoeff());
      }
    }
  }
  EXPECT_LT(largest, 1e-12);
  EXPECT_GT(chains, testing::cases(1000) / 2);
  EXPECT_GT(reversed, chains);
}

TEST(UrdfChain, AReversedChainIsTheInverseWithTheSameCoordinates) {
  testing::Random random;
  for (int i = 0; i < testing::cases(300); ++i) {
    const std::vector<TreeJoint> joints = random_tree(random);
    const std::string text = urdf_of(joints);
    const std::string tip = std::to_string(joints.size());
    if (testing::refusal([&] { (void)arm_from_urdf(text, "a.urdf", {.base = "0", .tip = tip}); }) !=
        "accepted") {
      continue;
    }
    const Arm down = arm_from_urdf(text, "a.urdf", {.base = "0", .tip = tip});
    const Arm up = arm_from_urdf(text, "a.urdf", {.base = tip, .tip = "0"});
    std::vector<std::string> names = up.joint_names();
    std::reverse(names.begin(), names.end());
    ASSERT_EQ(names, down.joint_names());
    const Configuration q = random.configuration(down);
    EXPECT_TRUE(forward_kinematics(up, Configuration(q.reverse()))
                    .isApprox(forward_kinematics(down, q).inverse(), 1e-13));
    for (int k = 0; k < down.dof(); ++k) {
      const Limits &a = down.limits(k), &b = up.limits(down.dof() - 1 - k);
      EXPECT_EQ(a.lower, b.lower);
      EXPECT_EQ(a.upper, b.upper);
      EXPECT_EQ(a.velocity, b.velocity);
    }
  }
}

/// base - arm - wrist, with fixed frames at the base and behind the wrist.
std::string with_frames(const std::vector<std::string>& frames) {
  std::string text = link("base") + link("arm") + link("wrist") + link("origin") +
                     joint("f", "fixed", "base", "origin") +
                     joint("j1", "revolute", "base", "arm") +
                     joint("j2", "revolute", "arm", "wrist");
  for (const std::string& frame : frames) {
    text += link(frame) + joint("to_" + frame, "fixed", "wrist", frame, "<origin xyz=\"0 0 1\"/>");
  }
  return text;
}

std::string selected_tip(const std::string& elements, const ChainEnds& ends = {}) {
  std::vector<ReadWarning> warnings;
  const Arm arm = arm_from_urdf(robot(elements), "a.urdf", ends, &warnings);
  EXPECT_EQ(arm_from_urdf(robot(elements), "a.urdf", ends).dof(), arm.dof());
  return warnings.empty() ? "" : sentence(warnings.front());
}

TEST(UrdfChain, LeavesWithoutAMovingJointAreNoTips) {
  EXPECT_EQ(selected_tip(with_frames({})), "");
  EXPECT_EQ(selected_tip(with_frames({"flange"})), "");
}

TEST(UrdfChain, AmongLeavesOfOneBodyToolZeroOrTheFirstIsTheTip) {
  EXPECT_EQ(selected_tip(with_frames({"flange", "camera"})),
            "the tip is flange; other tips, fixed to the same link: camera; tip selects another");
  EXPECT_EQ(selected_tip(with_frames({"flange", "tool0", "camera"})),
            "the tip is tool0; other tips, fixed to the same link: flange, camera; tip selects "
            "another");
  EXPECT_EQ(selected_tip(with_frames({"flange", "camera"}), {.tip = "wrist"}), "");
}

TEST(UrdfChain, AmongOtherLeavesOnlyToolZeroIsTakenUnasked) {
  const std::string gripper = link("finger") + joint("j3", "prismatic", "wrist", "finger");
  EXPECT_EQ(selected_tip(with_frames({"tool0"}) + gripper),
            "the tip is tool0; other tips: finger; tip selects another");
  EXPECT_REFUSED(selected_tip(with_frames({"flange"}) + gripper),
                 "a.urdf: has 2 tips below base; choose one as the tip: flange, finger");
}

TEST(UrdfChain, FromAToolTheChainEndsAtTheRoot) {
  EXPECT_EQ(selected_tip(with_frames({"tool0"}), {.base = "tool0"}), "");
  const Arm arm = arm_from_urdf(robot(with_frames({"tool0"})), "a.urdf", {.base = "tool0"});
  EXPECT_EQ(arm.joint_names(), (std::vector<std::string>{"j2", "j1"}));
  EXPECT_EQ(arm.joints()[0].offset.translation(), Vector3(0, 0, -1));
}

}  // namespace
}  // namespace beeline
