#include <gtest/gtest.h>

#include <beeline/doctor/comparison.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se3.h>

#include <tests/random_table.h>
#include <tests/refusal.h>
#include <tests/typical_arms.h>

namespace beeline {
namespace {

using testing::arm_of_rows;
using testing::random_rows;
using testing::with_coordinates;
using testing::with_other_frames;

constexpr double pi = std::numbers::pi;

/// What the comparison claims of arms without other dimensions, computed apart from it: the largest
/// difference between B(gain q + offset) and mount * A(q) * tcp.
double claimed_deviation(testing::Random& random, const Arm& a, const Arm& b,
                         const ArmComparison& comparison) {
  Pose mount = Pose::Identity(), tcp = Pose::Identity();
  for (const ModelDifference& difference : comparison.differences) {
    if (difference.kind == DifferenceKind::mount) mount = *difference.pose;
    if (difference.kind == DifferenceKind::tool) tcp = *difference.pose;
  }
  double largest = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Configuration q = random.configuration(a);
    const Configuration other = comparison.gain.cwiseProduct(q) + comparison.offset;
    const Pose from_a = mount * forward_kinematics(a, q) * tcp;
    const Pose of_b = forward_kinematics(b, other);
    largest = std::max(largest, (from_a.matrix() - of_b.matrix()).cwiseAbs().maxCoeff());
  }
  return largest;
}

std::string described(const ArmComparison& comparison) {
  std::string text = comparison.verdict;
  for (const ModelDifference& difference : comparison.differences) {
    text += "\n  " + std::to_string(difference.joint + 1) + " " + difference.what + " " +
            difference.remedy;
  }
  return text;
}

TEST(Comparison, BuiltInArmsAreTheSameAsThemselves) {
  for (const std::string& name : testing::typical_arms) {
    const ArmComparison comparison = compare_arms(built_in(name), built_in(name));
    EXPECT_TRUE(comparison) << name << ": " << described(comparison);
    EXPECT_EQ(comparison.status, ModelComparison::same);
    EXPECT_TRUE(comparison.differences.empty());
    EXPECT_EQ(comparison.residual.position, 0);
  }
}

TEST(Comparison, BuiltInArmsDiffer) {
  const std::vector<std::string> names = testing::typical_arms;
  for (const std::string& a : names) {
    for (const std::string& b : names) {
      if (a == b) continue;
      const ArmComparison comparison = compare_arms(built_in(a), built_in(b));
      EXPECT_EQ(comparison.status, ModelComparison::different) << a << ' ' << b;
    }
  }
}

/// Mount, tool, signs and offsets at once, and link frames that have nothing in common.
TEST(Comparison, AnArmInAnotherDescriptionIsReconciled) {
  testing::Random random;
  for (int trial = 0; trial < testing::cases(100); ++trial) {
    const int joints = random.integer(3, 8);
    const auto convention =
        random.integer(0, 1) == 0 ? DhConvention::standard : DhConvention::modified;
    const Arm a = arm_of_rows(random_rows(random, joints), convention, random.pose(0.2));
    std::vector<double> gain, offset;
    for (int i = 0; i < joints; ++i) {
      gain.push_back(random.integer(0, 2) == 0 ? -1 : 1);
      offset.push_back(random.integer(0, 2) == 0 ? random.uniform(-3, 3) : 0);
    }
    const Arm other = with_coordinates(with_other_frames(random, a), gain, offset);
    const Arm b = with_mount(with_tcp(other, random.pose(0.3)), random.pose());
    const ArmComparison comparison = compare_arms(a, b);
    EXPECT_EQ(comparison.status, ModelComparison::reconciled)
        << "trial " << trial << ' ' << described(comparison);
    EXPECT_LT(comparison.residual.position, 1e-4);
    // The table read in another way may by chance need mount and tool alone: that is true, too.
    const ModelDifference& first = comparison.differences.front();
    if (first.joint < 0 && first.kind != DifferenceKind::mount &&
        first.kind != DifferenceKind::tool) {
      continue;
    }
    EXPECT_LT(claimed_deviation(random, a, b, comparison), 1e-4) << "trial " << trial;
  }
}

/// Among joints with slides the axes leave the place of a slide open.
TEST(Comparison, SignsAndOffsetsOfSlidesAreFound) {
  testing::Random random;
  for (int trial = 0; trial < testing::cases(100); ++trial) {
    const int joints = random.integer(3, 7);
    const Arm a = arm_of_rows(random_rows(random, joints, true), DhConvention::standard);
    std::vector<double> gain(joints, 1), offset(joints, 0);
    gain[random.integer(0, joints - 1)] = -1;
    offset[random.integer(1, joints - 2)] = random.uniform(-0.5, 0.5);
    const Arm b = with_mount(with_coordinates(a, gain, offset), random.pose());
    const ArmComparison comparison = compare_arms(a, b);
    EXPECT_EQ(comparison.status, ModelComparison::reconciled)
        << "trial " << trial << ' ' << described(comparison);
    EXPECT_LE(comparison.differences.size(), 3u);
    EXPECT_LT(claimed_deviation(random, a, b, comparison), 1e-4) << "trial " << trial;
  }
}

TEST(Comparison, OneNumberOfATableIsNamed) {
  testing::Random random;
  for (int trial = 0; trial < testing::cases(100); ++trial) {
    const int joints = random.integer(3, 7);
    const auto convention =
        random.integer(0, 1) == 0 ? DhConvention::standard : DhConvention::modified;
    const std::vector<DhRow> rows = random_rows(random, joints);
    std::vector<DhRow> wrong = rows;
    const int joint = random.integer(0, joints - 1), column = random.integer(0, 2);
    double DhRow::*const number = column == 0 ? &DhRow::a : column == 1 ? &DhRow::d : &DhRow::alpha;
    wrong[joint].*number += random.uniform(0.001, 0.03);
    const Arm a = arm_of_rows(rows, convention), b = arm_of_rows(wrong, convention);
    const ArmComparison comparison = compare_arms(a, b);
    ASSERT_EQ(comparison.differences.size(), 1u) << "trial " << trial << described(comparison);
    const ModelDifference& found = comparison.differences.front();
    EXPECT_EQ(found.joint, joint) << "trial " << trial << described(comparison);
    EXPECT_EQ(found.parameter, column == 0 ? "a" : column == 1 ? "d" : "alpha");
    EXPECT_NEAR(*found.a, rows[joint].*number, 1e-9);
    EXPECT_NEAR(*found.b, wrong[joint].*number, 1e-9);
  }
}

/// A wrong length between links, described by frames that have nothing in common: the axes alone
/// show which link it is. Parallel axes share one distance along them.
TEST(Comparison, ADimensionIsLocatedByTheAxes) {
  testing::Random random;
  for (int trial = 0; trial < testing::cases(100); ++trial) {
    const int joints = random.integer(4, 7);
    std::vector<DhRow> rows = random_rows(random, joints);
    for (DhRow& row : rows) {
      if (row.alpha == 0) row.alpha = pi / 2;
    }
    std::vector<DhRow> wrong = rows;
    const int joint = random.integer(1, joints - 2);
    const bool along = random.integer(0, 1) == 0;
    (along ? wrong[joint].d : wrong[joint].a) += random.uniform(0.001, 0.03);
    const Arm a = arm_of_rows(rows, DhConvention::standard);
    const Arm b = with_other_frames(random, arm_of_rows(wrong, DhConvention::standard));
    const ArmComparison comparison = compare_arms(a, with_mount(b, random.pose()));
    EXPECT_EQ(comparison.status, ModelComparison::different);
    EXPECT_TRUE(comparison.explained);
    ASSERT_EQ(comparison.differences.size(), 2u) << "trial " << trial << described(comparison);
    const ModelDifference& found = comparison.differences.front();
    EXPECT_EQ(found.kind, DifferenceKind::length);
    EXPECT_EQ(found.joint, joint) << "trial " << trial << described(comparison);
    EXPECT_EQ(found.parameter.substr(0, 2), along ? "d," : "di") << found.parameter;
    EXPECT_NEAR(std::abs(*found.a - *found.b),
                std::abs(rows[joint].a - wrong[joint].a) + std::abs(rows[joint].d - wrong[joint].d),
                1e-9);
  }
}

/// The joints that both arms have keep their limits, in either order of the arms.
TEST(Comparison, LimitsAreComparedWhereAJointIsMissing) {
  testing::Random random;
  for (int trial = 0; trial < testing::cases(60); ++trial) {
    const int joints = random.integer(4, 7);
    const std::vector<DhRow> rows = random_rows(random, joints);
    std::vector<Joint> all = arm_of_rows(rows, DhConvention::standard).joints();
    for (Joint& joint : all) {
      joint.limits.lower = random.uniform(-3, -1);
      joint.limits.upper = random.uniform(1, 3);
      joint.limits.velocity = random.uniform(1, 3);
    }
    const int missing = random.integer(0, joints - 1), place = random.integer(0, joints - 2);
    const int wrong = place < missing ? place : place + 1;
    std::vector<Joint> rest = all;
    rest.erase(rest.begin() + missing);
    rest[place].limits.velocity *= 1.25;
    const Arm longer("longer", all, Pose::Identity()), shorter("shorter", rest, Pose::Identity());
    for (const bool from_a : {true, false}) {
      const ArmComparison comparison =
          from_a ? compare_arms(longer, shorter) : compare_arms(shorter, longer);
      ASSERT_TRUE(comparison.explained) << "trial " << trial << ' ' << described(comparison);
      ASSERT_EQ(comparison.others.size(), 1u) << "trial " << trial << ' ' << described(comparison);
      const ModelDifference& found = comparison.others.front();
      EXPECT_EQ(found.parameter, "velocity limit");
      EXPECT_EQ(found.joint, from_a ? wrong : place) << "trial " << trial;
      EXPECT_NEAR(*found.b / *found.a, from_a ? 1.25 : 0.8, 1e-12);
    }
  }
}

}  // namespace
}  // namespace beeline
