#include <gtest/gtest.h>
#include <numbers>

#include <beeline/io/text/arm.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include <tests/random_arm.h>

// Tables of arms, multiplied by textbook matrices of their own.

namespace beeline {
namespace {

using Matrix4 = Eigen::Matrix4d;

constexpr DhConvention conventions[] = {DhConvention::standard, DhConvention::modified};

/// Rotation about x or z by an angle, then a translation along it.
Matrix4 screw_along(int axis, double angle, double distance) {
  Matrix4 matrix = Matrix4::Identity();
  const double c = std::cos(angle), s = std::sin(angle);
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  matrix(i, i) = matrix(j, j) = c;
  matrix(i, j) = -s;
  matrix(j, i) = s;
  matrix(axis, 3) = distance;
  return matrix;
}

Matrix4 pose_of_table(const Arm& arm, const DhTable& table, const Configuration& q) {
  Matrix4 pose = table.base.matrix();
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const DhRow& row = table.rows[i];
    const Arm::JointCoupling& coupling = arm.couplings()[i];
    const double value = coupling.ratio * q[coupling.coordinate] + coupling.shift;
    const bool slides = row.kind == JointKind::prismatic;
    const Matrix4 z =
        screw_along(2, row.theta + (slides ? 0 : value), row.d + (slides ? value : 0));
    const Matrix4 x = screw_along(0, row.alpha, row.a);
    pose =
        table.convention == DhConvention::standard ? Matrix4(pose * z * x) : Matrix4(pose * x * z);
  }
  return pose * table.tool.matrix();
}

/// The largest difference between the poses of an arm and of its table.
double table_error(const Arm& arm, const DhTable& table, testing::Random& random) {
  double largest = 0;
  for (int k = 0; k < 20; ++k) {
    const Configuration q = random.configuration(arm);
    const Matrix4 difference = pose_of_table(arm, table, q) - forward_kinematics(arm, q).matrix();
    largest = std::max(largest, difference.cwiseAbs().maxCoeff());
  }
  return largest;
}

TEST(DhTable, BuiltInArmsHaveOne) {
  testing::Random random;
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    for (const DhConvention convention : conventions) {
      const DhTable table = dh_table(arm, convention);
      ASSERT_TRUE(table) << name << ": " << sentence(table.misfits.front());
      EXPECT_EQ(table.rows.size(), arm.joints().size());
      EXPECT_EQ(table.freedom.size(), arm.joints().size() + 1);
      EXPECT_LT(table_error(arm, table, random), 1e-12) << name;
    }
  }
}

TEST(DhTable, RandomArmsHaveOne) {
  testing::Random random;
  for (int i = 0; i < testing::cases(1500); ++i) {
    std::vector<Joint> joints;
    const int n = random.integer(1, 8);
    for (int j = 0; j < n; ++j) {
      const auto kind = random.integer(0, 2) == 0 ? JointKind::prismatic : JointKind::revolute;
      joints.push_back(testing::random_joint(random, kind, "j" + std::to_string(j)));
      if (j > 0 && random.integer(0, 3) == 0) {
        joints[j].mimic = Mimic{"j0", random.uniform(0.2, 1.5), random.uniform(-1, 1)};
        joints[j].limits = {};
      }
    }
    const Arm arm("random", joints, random.pose(), random.pose());
    for (const DhConvention convention : conventions) {
      const DhTable table = dh_table(arm, convention);
      if (!table) {  // two random axes that are nearly parallel
        EXPECT_GT(table.misfits.front().distance, 50);
        continue;
      }
      EXPECT_LT(table_error(arm, table, random), 1e-12) << i;
    }
  }
}

/// A joint whose frame is at right angles to the one before it, a step along one of its axes away.
Joint square_joint(testing::Random& random, JointKind kind, const std::string& name) {
  const Vector3 axes[] = {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ(), -Vector3::UnitZ()};
  constexpr double right = std::numbers::pi / 2;
  Joint joint;
  joint.name = name;
  joint.offset.linear() = rotation(RollPitchYaw{
      right * random.integer(0, 3), right * random.integer(0, 3), right * random.integer(0, 3)});
  joint.offset.translation() = 0.25 * random.integer(0, 2) * axes[random.integer(0, 3)];
  const Vector3 axis = axes[random.integer(0, 3)];
  const Vector3 point = 0.25 * random.integer(0, 1) * axes[random.integer(0, 3)];
  joint.screw =
      kind == JointKind::prismatic ? translation_screw(axis) : rotation_screw(axis, point);
  return joint;
}

TEST(DhTable, ParallelMeetingAndCoincidentAxesHaveOne) {
  testing::Random random;
  std::size_t of_kind[5] = {};
  for (int i = 0; i < testing::cases(3000); ++i) {
    std::vector<Joint> joints;
    const int n = random.integer(2, 7);
    for (int j = 0; j < n; ++j) {
      const auto kind = random.integer(0, 2) == 0 ? JointKind::prismatic : JointKind::revolute;
      joints.push_back(square_joint(random, kind, "j" + std::to_string(j)));
    }
    const Arm arm("square", joints, random.pose());
    for (const DhConvention convention : conventions) {
      const DhTable table = dh_table(arm, convention);
      ASSERT_TRUE(table) << i << ": " << sentence(table.misfits.front());
      EXPECT_LT(table_error(arm, table, random), 1e-12) << i;
      for (const DhFreedom freedom : table.freedom) ++of_kind[static_cast<int>(freedom)];
    }
  }
  for (const std::size_t count : of_kind)
    EXPECT_GT(count, static_cast<std::size_t>(testing::cases(100)));
}

TEST(DhTable, AnArmOfATableGetsItsRows) {
  testing::Random random;
  constexpr double right = std::numbers::pi / 2;
  for (int i = 0; i < testing::cases(1500); ++i) {
    std::vector<DhRow> rows;
    const int n = random.integer(1, 7);
    for (int j = 0; j < n; ++j) {
      const bool slides = random.integer(0, 3) == 0;
      rows.push_back({.a = 0.25 * random.integer(-2, 2),
                      .alpha = right * random.integer(-1, 1),
                      .d = 0.125 * random.integer(-2, 2),
                      .theta = right * random.integer(-1, 1),
                      .kind = slides ? JointKind::prismatic : JointKind::revolute});
    }
    for (const DhConvention convention : conventions) {
      const DhTable table = dh_table(arm_from_dh("a", rows, convention), convention);
      ASSERT_TRUE(table);
      EXPECT_LT((table.base.matrix() - Matrix4::Identity()).norm(), 1e-15);
      EXPECT_LT((table.tool.matrix() - Matrix4::Identity()).norm(), 1e-14);
      for (int j = 0; j < n; ++j) {
        EXPECT_EQ(table.rows[j].a, rows[j].a) << i << " row " << j;
        EXPECT_EQ(table.rows[j].alpha, rows[j].alpha) << i << " row " << j;
        EXPECT_EQ(table.rows[j].d, rows[j].d) << i << " row " << j;
        EXPECT_EQ(table.rows[j].theta, rows[j].theta) << i << " row " << j;
        EXPECT_EQ(table.rows[j].kind, rows[j].kind) << i << " row " << j;
      }
    }
  }
}

TEST(DhTable, MakersTablesComeBack) {
  const DhTable ur5 = dh_table(built_in("ur5"), DhConvention::standard);
  ASSERT_EQ(ur5.rows.size(), 6u);
  EXPECT_EQ(ur5.rows[0].d, 0.089159);
  EXPECT_EQ(ur5.rows[1].a, -0.425);
  EXPECT_EQ(ur5.rows[3].d, 0.10915);
  EXPECT_EQ(ur5.rows[4].alpha, -std::numbers::pi / 2);
  const DhTable panda = dh_table(built_in("panda"), DhConvention::modified);
  ASSERT_EQ(panda.rows.size(), 7u);
  EXPECT_EQ(panda.rows[0].d, 0.333);
  EXPECT_EQ(panda.rows[4].a, -0.0825);
  EXPECT_EQ(panda.rows[6].a, 0.088);
  EXPECT_DOUBLE_EQ(panda.tool.translation().z(), 0.107);
}

TEST(DhTable, AMountChangesTheBaseAlone) {
  testing::Random random;
  for (const std::string& name : built_in_names()) {
    Pose mount = random.pose();
    mount.translation() = Vector3(1e4, 2e4, 1);
    const Arm arm = built_in(name), mounted = with_mount(arm, mount);
    for (const DhConvention convention : conventions) {
      const DhTable table = dh_table(arm, convention), there = dh_table(mounted, convention);
      ASSERT_EQ(there.rows.size(), table.rows.size()) << name;
      for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const DhRow &a = table.rows[i], &b = there.rows[i];
        EXPECT_TRUE(a.a == b.a && a.alpha == b.alpha && a.d == b.d && a.theta == b.theta) << name;
        EXPECT_FALSE((a.theta == 0 && std::signbit(a.theta)) ||
                     (a.alpha == 0 && std::signbit(a.alpha)))
            << name;
      }
      EXPECT_LT((there.base.matrix() - mount.matrix() * table.base.matrix()).norm(), 1e-9);
    }
  }
}

TEST(DhTable, SaysWhatTheAxesLeaveOpen) {
  const DhTable table = dh_table(built_in("ur5"), DhConvention::standard);
  EXPECT_EQ(table.freedom,
            (std::vector{DhFreedom::end, DhFreedom::none, DhFreedom::along_axis,
                         DhFreedom::along_axis, DhFreedom::none, DhFreedom::none, DhFreedom::end}));
  EXPECT_EQ(dh_table(arm_from_joint_string("RP"), DhConvention::modified).freedom[1],
            DhFreedom::line);
}

TEST(DhTable, HelicalAndNearlyParallelAxesHaveNone) {
  const Arm helical = arm_from_joint_string("RHR:1,0.2p0.05,1");
  std::vector<Joint> joints = arm_from_joint_string("RRR").joints();
  joints[1].screw = rotation_screw({1e-8, 0, 1}, {0, 0.3, 0});
  const Arm nearly("nearly", joints);
  for (const DhConvention convention : conventions) {
    const DhTable none = dh_table(helical, convention);
    ASSERT_EQ(none.misfits.size(), 1u);
    EXPECT_TRUE(none.misfits[0].helical);
    EXPECT_EQ(none.misfits[0].joint, "joint2");
    EXPECT_TRUE(none.rows.empty());
    const DhTable far = dh_table(nearly, convention);
    ASSERT_FALSE(far);
    EXPECT_FALSE(far.misfits[0].helical);
    EXPECT_GT(far.misfits[0].distance, 1e6);
    EXPECT_TRUE(far.rows.empty());
  }
}

}  // namespace
}  // namespace beeline
