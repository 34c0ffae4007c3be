#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/numbers.h>
#include <beeline/io/text/pose_list.h>
#include <beeline/pose/se3.h>
#include <beeline/pose/so3.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using std::numbers::pi;
using Numbers = std::vector<double>;

std::vector<PoseForm> all_forms() {
  std::vector<PoseForm> forms;
  for (const std::string& name : pose_form_names()) forms.push_back(pose_form_named(name));
  return forms;
}

std::string typed_text(const Numbers& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ",") + exact(value);
  return text;
}

std::string header_of(PoseForm form) {
  std::string text;
  for (const std::string& name : pose_columns(form)) text += (text.empty() ? "" : ",") + name;
  return text;
}

/// Random orientations, those near gimbal lock and near rotations by pi among them.
Rotation hard_rotation(testing::Random& random, int i) {
  const double near = i % 7 == 0 ? 0 : std::pow(10, random.uniform(-16, -3));
  if (i % 3 == 0) {
    const double pitch = (i % 2 == 0 ? 1 : -1) * (pi / 2 - near);
    return rotation({random.uniform(-pi, pi), pitch, random.uniform(-pi, pi)});
  }
  if (i % 3 == 1) {
    const Vector3 axis = i % 4 == 0 ? Vector3::Unit(i % 5 % 3) : random.direction();
    return Eigen::AngleAxisd(pi - near, axis).toRotationMatrix();
  }
  return random.rotation();
}

TEST(PoseForm, WhatIsPrintedReadsBackInEveryFormAndUnit) {
  testing::Random random;
  for (int i = 0; i < testing::cases(3000); ++i) {
    const Pose pose = make_pose(random.vector(2), hard_rotation(random, i));
    for (const PoseForm form : all_forms()) {
      const PoseFormat format{.angle_unit = i % 2 == 0 ? AngleUnit::radians : AngleUnit::degrees,
                              .pose_form = form,
                              .millimetres = i % 5 < 2};
      const Numbers numbers = pose_numbers(pose, format);
      ASSERT_EQ(numbers.size(), pose_columns(form).size());
      const std::string text = typed_text(numbers);
      const Pose typed = parse_pose(text, format).pose;
      // Where the cosine of the pitch is below 1e-12, roll counts as 0.
      const bool angles = form == PoseForm::rpy || form == PoseForm::abc;
      ASSERT_LT((typed.matrix() - pose.matrix()).cwiseAbs().maxCoeff(), angles ? 2e-12 : 2e-15)
          << form << ' ' << text;
      const PoseFormat units{.angle_unit = format.angle_unit, .millimetres = format.millimetres};
      const PoseList list = poses_from_csv(header_of(form) + "\n" + text + "\n", "a.csv", units);
      ASSERT_EQ(list.form, form);
      ASSERT_LT((list.poses.at(0).matrix() - typed.matrix()).cwiseAbs().maxCoeff(), 1e-15);
      ASSERT_LT((pose_of(numbers, format).matrix() - typed.matrix()).norm(), 1e-300);
    }
  }
}

TEST(PoseForm, EachIsItsDefinition) {
  testing::Random random;
  const auto about = [](double degrees, const Vector3& axis) {
    return Eigen::AngleAxisd(degrees * pi / 180, axis);
  };
  for (int i = 0; i < 300; ++i) {
    const double a = random.uniform(-180, 180), b = random.uniform(-90, 90),
                 c = random.uniform(-180, 180);
    // KUKA: each rotation is about an axis that the rotations before it have moved.
    Eigen::Quaterniond turned(about(a, Vector3::UnitZ()));
    turned = about(b, turned * Vector3::UnitY()) * turned;
    turned = about(c, turned * Vector3::UnitX()) * turned;
    for (const AngleUnit unit : {AngleUnit::radians, AngleUnit::degrees}) {
      const Pose pose =
          pose_of(Numbers{100, 200, 300, a, b, c},
                  {.angle_unit = unit, .pose_form = PoseForm::abc, .millimetres = true});
      ASSERT_LT((pose.linear() - turned.toRotationMatrix()).norm(), 1e-14);
      ASSERT_LT((pose.translation() - Vector3(0.1, 0.2, 0.3)).norm(), 1e-15);
    }
    const Vector3 axis = random.direction();
    const double angle = random.uniform(0, 6);
    const Pose vector = pose_of(
        Numbers{1, 2, 3, angle * axis.x(), angle * axis.y(), angle * axis.z()},
        {.angle_unit = AngleUnit::degrees, .pose_form = PoseForm::rotvec});  // radians all the same
    ASSERT_LT((vector.linear() - Eigen::AngleAxisd(angle, axis).toRotationMatrix()).norm(), 1e-14);
  }
  const Pose matrix = pose_of(Numbers{0, -1, 0, 4, 1, 0, 0, 5, 0, 0, 1, 6});
  EXPECT_EQ(matrix.translation(), Vector3(4, 5, 6));
  EXPECT_EQ(matrix.linear().col(0), Vector3::UnitY());
}

TEST(PoseForm, TheHeaderNamesItInUpperOrLowerCase) {
  const auto read = [](const std::string& text) {
    return poses_from_csv(text, "a.csv", {.millimetres = true}).poses.at(0);
  };
  const Pose kuka = read("x,y,z,A,B,C\n525,0,700,0,90,0\n");
  EXPECT_LT((kuka.translation() - Vector3(0.525, 0, 0.7)).norm(), 1e-16);
  EXPECT_LT((kuka.linear().col(2) - Vector3::UnitX()).norm(), 1e-15);
  EXPECT_EQ(read("C,B,A,Z,Y,X\n0,90,0,700,0,525\n").matrix(), kuka.matrix());
  EXPECT_EQ(read("X,Y,Z,a,b,c\n525,0,700,0,90,0\n").matrix(), kuka.matrix());
  EXPECT_EQ(read("X,Y,Z,RX,RY,RZ\n525,0,700,0,0,0\n").linear(), Rotation::Identity());
}

TEST(PoseForm, ProgramsHaveThemToo) {
  const ProgramRows program =
      program_rows_from_csv("motion,X,Y,Z,A,B,C,speed,blend\nline,525,0,700,0,90,0,0.25,0.01\n",
                            "p.csv", {.millimetres = true});
  const ProgramRow& line = program.rows.at(0);
  ASSERT_TRUE(line.pose);
  EXPECT_EQ(line.pose->form, PoseForm::abc);
  EXPECT_LT((line.pose->pose.translation() - Vector3(0.525, 0, 0.7)).norm(), 1e-16);
  EXPECT_EQ(line.speed, 0.25);  // metres per second
  EXPECT_EQ(line.blend, 0.01);  // metres
}

TEST(PoseForm, OfNumbersWithoutNamesIsTheOneAskedFor) {
  EXPECT_EQ(parse_pose("0,0,0,0,0,0").form, PoseForm::rpy);
  const PoseFormat typed{.pose_form = PoseForm::abc, .millimetres = true};
  const WrittenPose of_urscript = parse_pose("p[0.1,0,0.2,0,3,0]", typed);
  EXPECT_EQ(of_urscript.form, PoseForm::rotvec);
  EXPECT_EQ(of_urscript.pose.matrix(),
            parse_pose("0.1,0,0.2,0,3,0", {.pose_form = PoseForm::rotvec}).pose.matrix());
  EXPECT_REFUSED(parse_pose("p[1,2,3]", typed), "has 3 numbers");
  EXPECT_EQ(parse_pose("0,0,0,1,0,0,0").form, PoseForm::quaternion);
  EXPECT_EQ(parse_pose("1,0,0,0,0,1,0,0,0,0,1,0").form, PoseForm::matrix);
  EXPECT_EQ(parse_pose("0,0,0,0,0,90", {.pose_form = PoseForm::abc}).form, PoseForm::abc);
  EXPECT_TRUE(parse_pose("1,2,3", {.triple = Triple::planar, .pose_form = PoseForm::abc}).planar);
  EXPECT_EQ(poses_from_csv("0,0,0,0,0,90\n", "a.csv", {.pose_form = PoseForm::abc}).form,
            PoseForm::abc);
  EXPECT_EQ(
      poses_from_csv("x,y,z,rx,ry,rz\n0,0,0,0,0,1\n", "a.csv", {.pose_form = PoseForm::abc}).form,
      PoseForm::rotvec);
  for (const PoseForm form : {PoseForm::quaternion, PoseForm::matrix}) {
    EXPECT_REFUSED(parse_pose("0,0,0,0,0,0", {.pose_form = form}),
                   "has 6 numbers; pose_form " + name(form) + " has ");
  }
  EXPECT_REFUSED(pose_of(Numbers(7), {.pose_form = PoseForm::rotvec}),
                 "a pose of 7 numbers; pose_form rotvec has x,y,z,rx,ry,rz");
  EXPECT_REFUSED(
      poses_from_csv("0,0,0,1,0,0,0\n", "a.csv", {.pose_form = PoseForm::abc}),
      "it has 7 numbers, and a row without a header has one of 3 (x, y, theta), 6 (x, y, z, A, B, "
      "C), 2 (x, y)");
  EXPECT_REFUSED(pose_form_named("euler"), "unknown pose_form \"euler\"");
}

TEST(PoseForm, AMatrixColumnByColumnIsNamed) {
  testing::Random random;
  for (int i = 0; i < testing::cases(200); ++i) {
    const Pose pose = random.pose();
    const Eigen::Matrix<double, 3, 4> upper = pose.matrix().topRows<3>();
    const std::span<const double> all(pose.matrix().data(), 16), twelve(upper.data(), 12);
    for (const auto& numbers : {all, twelve}) {
      EXPECT_REFUSED(pose_of(numbers),
                     "these numbers are a pose column by column: write it row by");
    }
  }
}

TEST(PoseForm, DefectsOfMatricesAreNamed) {
  const auto read = [](const std::string& text) { return parse_pose(text); };
  EXPECT_REFUSED(read("1,0,0,0,0,1,0,0,0,0,-1,0"), "the determinant is -1");
  EXPECT_REFUSED(read("2,0,0,0,0,2,0,0,0,0,2,0"),
                 "R R^T differs from the identity by 3, the determinant is 8");
  EXPECT_REFUSED(read("1,0.1,0,0,0,1,0,0,0,0,1,0"), "R R^T differs from the identity by 0.1");
  EXPECT_REFUSED(read("1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2"),
                 "the matrix ends in the row 0, 0, 0, 2; it must be 0, 0, 0, 1");
  EXPECT_REFUSED(read("1,0,0,0,0,1,0,0,0,0,1,0,0,0"), "has 14 numbers; poses are");
  EXPECT_REFUSED(poses_from_csv("m11,m12\n1,0\n", "a.csv"), "columns m13, m14, m21, m22");
  EXPECT_REFUSED(poses_from_csv("x,y,z,A,B\n1,0,0,0,0\n", "a.csv"), "column C is missing");
  EXPECT_REFUSED(poses_from_csv("x,y,z,A,B,C,qw\n1,0,0,0,0,0,1\n", "a.csv"),
                 "column qw does not belong to x, y, z, A, B, C");
  // Seven digits are enough, and the rotation becomes orthonormal.
  const Pose rounded =
      checked_pose(read("0.7071068,-0.7071068,0,1,0.7071068,0.7071068,0,2,0,0,1,3,0,0,0,1").pose);
  EXPECT_LT((rounded.linear() * rounded.linear().transpose() - Rotation::Identity()).norm(), 1e-15);
}

TEST(PoseForm, LongRotationVectorsAreReported) {
  EXPECT_EQ(parse_pose("1,2,3,0,-180,0", {.pose_form = PoseForm::rotvec}).max_angle, 180);
  EXPECT_EQ(parse_pose("1,2,3,0,-180,0", {.pose_form = PoseForm::abc}).max_angle, 0);
}

TEST(PoseForm, AVeryLongRotationVectorIsARotation) {
  const PoseFormat format{.pose_form = PoseForm::rotvec};
  for (const double length : {1e10, 1e149, 1e151, 1e308}) {
    const Pose pose = parse_pose("0,0,0," + number(length) + ",0,0", format).pose;
    const double angle = std::remainder(length, 2 * std::numbers::pi);
    if (length < 1e15) {
      EXPECT_TRUE(pose.linear().isApprox(so3_exp(Vector3(angle, 0, 0)), 1e-5)) << length;
    }
    EXPECT_TRUE((pose.linear() * pose.linear().transpose()).isIdentity(1e-12)) << length;
    EXPECT_EQ(pose.linear()(0, 0), 1) << length;
    EXPECT_NEAR(parse_pose("0,0,0,0," + number(length) + ",0", format).max_angle / length, 1,
                1e-14);
  }
  EXPECT_REFUSED(parse_pose("0,0,0,1.7e308,1.7e308,0", format),
                 "the length of the rotation vector exceeds the range of numbers, 1e308");
}

}  // namespace
}  // namespace beeline
