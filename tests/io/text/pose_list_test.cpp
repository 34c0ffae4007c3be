#include <gtest/gtest.h>
#include <numbers>

#include <beeline/io/text/numbers.h>
#include <beeline/io/text/pose_list.h>
#include <beeline/pose/se3.h>

#include <tests/random.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline {
namespace {

using std::numbers::pi;

std::string row(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ",") + exact(value);
  return text;
}

TEST(PoseList, AllFormsGiveTheSamePose) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    const RollPitchYaw rpy{random.uniform(-3, 3), random.uniform(-1.5, 1.5), random.uniform(-3, 3)};
    const Pose pose = make_pose(random.vector(), rotation(rpy));
    const Vector3 p = pose.translation();
    const Quaternion u = quaternion(pose.linear());
    const std::vector<double> angles{p.x(), p.y(), p.z(), rpy.roll, rpy.pitch, rpy.yaw};
    const std::vector<double> fields{p.x(), p.y(), p.z(), u.qw, u.qx, u.qy, u.qz};
    EXPECT_TRUE(parse_pose(row(angles)).pose.isApprox(pose, 1e-14));
    EXPECT_TRUE(parse_pose(row(fields)).pose.isApprox(pose, 1e-14));
    const PoseList list = poses_from_csv("x,y,z,qw,qx,qy,qz\n" + row(fields), "a.csv");
    EXPECT_EQ(list.poses.at(0).matrix(), parse_pose(row(fields)).pose.matrix());
    EXPECT_FALSE(list.planar);
  }
}

TEST(PoseList, PlanarPosesLieInThePlane) {
  const PoseList list = poses_from_csv("# the chapter's\nx,y,theta\n4.5,5.2,0\n\n1,2,90\n", "a.csv",
                                       {.angle_unit = AngleUnit::degrees});
  ASSERT_EQ(list.poses.size(), 2u);
  EXPECT_TRUE(list.planar);
  EXPECT_EQ(list.lines, (std::vector<int>{3, 5}));
  EXPECT_EQ(list.poses[0].translation(), Vector3(4.5, 5.2, 0));
  const Rotation quarter = Eigen::AngleAxisd(pi / 2, Vector3::UnitZ()).toRotationMatrix();
  EXPECT_TRUE(list.poses[1].linear().isApprox(quarter, 1e-15));
  EXPECT_EQ(parse_pose("1,2,90", {.angle_unit = AngleUnit::degrees, .triple = Triple::planar})
                .pose.matrix(),
            list.poses[1].matrix());
  EXPECT_TRUE(parse_pose("1,2,90", {.triple = Triple::planar}).planar);
  EXPECT_FALSE(parse_pose("1,2,3,0,0,90").planar);
}

TEST(PoseList, ColumnsMayBeInAnyOrder) {
  const Pose straight = parse_pose("1,2,3,0.1,0.2,0.3").pose;
  const PoseList list = poses_from_csv("yaw,z,roll,x,pitch,y\n0.3,3,0.1,1,0.2,2\n", "a.csv");
  EXPECT_EQ(list.poses.at(0).matrix(), straight.matrix());
}

TEST(PoseList, DegreesTouchAnglesOnly) {
  EXPECT_TRUE(parse_pose("90,0,0,0,0,90", {.angle_unit = AngleUnit::degrees})
                  .pose.isApprox(parse_pose("90,0,0,0,0," + exact(pi / 2)).pose, 1e-15));
  EXPECT_EQ(parse_pose("1,2,3,1,0,0,0", {.angle_unit = AngleUnit::degrees}).pose.matrix(),
            parse_pose("1,2,3,1,0,0,0").pose.matrix());
}

TEST(PoseList, MistakesAreNamed) {
  const auto read = [](const char* text) { return poses_from_csv(text, "a.csv"); };
  const std::string forms = "poses are x,y,theta or x,y,z,roll,pitch,yaw or x,y,z,qw,qx,qy,qz";
  EXPECT_REFUSED(read("x,theta\n1,2\n"), "a.csv:1: column y is missing beside x, theta; " + forms);
  EXPECT_REFUSED(read("y\n1\n"), "columns x, theta are missing beside y; " + forms);
  EXPECT_REFUSED(read("x,y,z,qw,qx,qz\n1,2,3,1,0,0\n"), "column qy is missing");
  EXPECT_REFUSED(read("x,y,z,roll\n1,2,3,1\n"),
                 "columns pitch, yaw are missing beside x, y, z, roll");
  EXPECT_REFUSED(read("x,y,z,theta\n1,2,3,1\n"), "column z does not belong to x, y, theta");
  EXPECT_REFUSED(read("x,y,theta,speed\n1,2,3,1\n"), "unknown column \"speed\"; " + forms);
  EXPECT_REFUSED(read("x;y;theta\n1\n"), "a.csv:2: this row has 1 items; the header has 3");
  EXPECT_REFUSED(read("1,2,3,4\n"),
                 "a.csv:1: the first line must be a header of names; it has 4 numbers, and a row "
                 "without a header has one of 3 (x, y, theta), 6 (x, y, z, roll, pitch, yaw), 7 "
                 "(x, y, z, qw, qx, qy, qz), 12 (m11, m12, ..., m34), 16 (m11, m12, ..., m44), 2");
  EXPECT_REFUSED(read("x,y,theta\n1,2,nan\n"), "a.csv:2: column theta: \"nan\" must be finite");
  EXPECT_REFUSED(read("x,y,z,qw,qx,qy,qz\n0,0,0,1,0,0,0\n0,0,0,1,1,0,0\n"),
                 "a.csv:3: quaternion qw,qx,qy,qz = 1,1,0,0 has length 1.41421; it must be 1");
  EXPECT_REFUSED(read(""), "a.csv: is empty");
  EXPECT_REFUSED(parse_pose("1,2,3,4"), "has 4 numbers; " + forms);
  EXPECT_REFUSED(parse_pose("1,2,x"), "pose: item 3: \"x\" is not a number");
  EXPECT_REFUSED(parse_pose("1,2,3,0,0,0,0"), "has length 0");
}

TEST(PoseList, PositionsHaveNoOrientation) {
  const PoseList space = poses_from_csv("z,x,y\n3,1,2\n", "a.csv");
  EXPECT_EQ(space.poses.at(0).matrix(), make_pose({1, 2, 3}).matrix());
  EXPECT_FALSE(space.oriented);
  EXPECT_FALSE(space.planar);
  const PoseList plane = poses_from_csv("x,y\n3,4\n", "a.csv");
  EXPECT_EQ(plane.poses.at(0).translation(), Vector3(3, 4, 0));
  EXPECT_FALSE(plane.oriented);
  EXPECT_TRUE(plane.planar);
  EXPECT_EQ(parse_pose("1,2,3", {.triple = Triple::position}).pose.translation(), Vector3(1, 2, 3));
  EXPECT_FALSE(parse_pose("1,2,3", {.triple = Triple::position}).oriented);
  EXPECT_TRUE(parse_pose("1,2,3", {.triple = Triple::planar}).oriented);
  EXPECT_TRUE(parse_pose("3,4").planar);
  EXPECT_FALSE(parse_pose("3,4").oriented);
}

TEST(PoseList, ThreeNumbersWithoutNamesNeedTheirMeaning) {
  const std::string cure =
      "3 numbers, x,y,theta or x,y,z; give triple=\"planar\" or triple=\"position\"";
  for (const PoseFormat& format :
       {PoseFormat(), PoseFormat{.pose_form = PoseForm::abc}, PoseFormat{.millimetres = true}}) {
    EXPECT_REFUSED(parse_pose("0,0,0.1034", format), "pose \"0,0,0.1034\" has " + cure);
    EXPECT_REFUSED(pose_of(std::vector<double>{0, 0, 0.1034}, format), "a pose of " + cure);
    EXPECT_REFUSED(poses_from_csv("1,2,3\n", "a.csv", format), "a.csv:1: a row has " + cure);
  }
  EXPECT_EQ(poses_from_csv("x,y,z\n1,2,3\n", "a.csv").poses.at(0).translation(), Vector3(1, 2, 3));
}

TEST(PoseList, WithoutAHeaderTheNumberOfColumnsGivesTheForm) {
  const auto columns = [](const char* text, Triple triple = Triple::planar) {
    const PoseList list = poses_from_csv(text, "a.csv", {.triple = triple});
    EXPECT_FALSE(list.has_header);
    EXPECT_EQ(list.poses.size(), 2u);
    EXPECT_EQ(list.lines, (std::vector<int>{1, 2}));
    return listed(list.columns);
  };
  EXPECT_EQ(columns("1,2\n3,4\n"), "x, y");
  EXPECT_EQ(columns("1,2,0.5\n3,4,0.1\n"), "x, y, theta");
  EXPECT_EQ(columns("1,2,0.5\n3,4,0.1\n", Triple::position), "x, y, z");
  EXPECT_EQ(columns("1;2;3;0;0;0\n1;2;3;0;0;0\n"), "x, y, z, roll, pitch, yaw");
  EXPECT_EQ(columns("1,2,3,1,0,0,0\n1,2,3,1,0,0,0\n"), "x, y, z, qw, qx, qy, qz");
  EXPECT_EQ(
      poses_from_csv("x,y,theta\n1,2,3\n", "a.csv", {.triple = Triple::position}).columns.size(),
      3u);
}

TEST(PoseList, SemicolonsSeparateToo) {
  EXPECT_EQ(poses_from_csv("x;y;theta\n1;2.5;0\n", "a.csv").poses.at(0).translation(),
            Vector3(1, 2.5, 0));
  const std::string cure = "separate them by commas or by semicolons, and write decimal points";
  EXPECT_REFUSED(poses_from_csv("x,y,theta\n1,5;2;0\n", "a.csv"), cure);
  for (const char* text : {"x;y;theta\n1,5;2,5;0\n", "1,5;2,5;0\n", "x y theta\n1,5 2,5 0\n"}) {
    const PoseList list = poses_from_csv(text, "a.csv", {.triple = Triple::planar});
    EXPECT_EQ(list.poses.at(0).translation(), Vector3(1.5, 2.5, 0));
  }
}

TEST(PoseList, DialectsAreThoseOfRecordings) {
  const Vector3 expected(1.5, 2, 3);
  for (const char* text :
       {"# x,y,z\n1.5,2,3\n", "X Y Z\n1,5 2 3\n", "# by hand\n# Z Y X\n3 2 1.5\n",
        "x\ty\tz\r1.5\t2\t3\r", "\xef\xbb\xbf\"X\";\"Y\";\"Z\"\r\n\r\n#\r\n1,5;2;3\r\n"}) {
    const PoseList list = poses_from_csv(text, "a.csv");
    EXPECT_EQ(list.poses.at(0).translation(), expected) << text;
    EXPECT_TRUE(list.has_header);
    EXPECT_FALSE(list.oriented);
  }
  EXPECT_REFUSED(poses_from_csv("x,X,y\n1,2,3\n", "a.csv"),
                 "a.csv:1: column \"x\" is given twice, in upper and lower case");
  EXPECT_REFUSED(poses_from_csv("1,2,x\n", "a.csv", {.triple = Triple::planar}),
                 "a.csv:1: column theta: \"x\" is not a number");
}

TEST(PoseList, EndlessFilesAreRefused) {
  for (const char end : {'\n', '\r'}) {
    const std::string rows(4'000'001, end);
    EXPECT_REFUSED(poses_from_csv("x,y\n" + rows, "a.csv"), "a.csv: has more than 4000000 lines");
  }
}

TEST(PoseList, TheLargestAngleIsReported) {
  EXPECT_EQ(parse_pose("1,2,-90", {.triple = Triple::planar}).max_angle, -90);
  EXPECT_EQ(
      parse_pose("1,2,180", {.angle_unit = AngleUnit::degrees, .triple = Triple::planar}).max_angle,
      pi);
  EXPECT_EQ(parse_pose("100,200,300,1,2,-3").max_angle, -3);
  EXPECT_EQ(parse_pose("100,200,300,1,0,0,0").max_angle, 0);
  EXPECT_EQ(parse_pose("100,200,300", {.triple = Triple::position}).max_angle, 0);
  EXPECT_EQ(poses_from_csv("x,y,theta\n1,2,3\n1,2,-9\n1,2,4\n", "a.csv").max_angle, -9);
}

TEST(PoseList, IsReadFromAFile) {
  const testing::TemporaryFolder folder;
  EXPECT_EQ(read_poses(folder.write("w.csv", "x,y,theta\n1,2,3\n")).poses.size(), 1u);
  EXPECT_REFUSED(read_poses(folder.file("none.csv")), "none.csv: cannot be read");
}

TEST(PoseList, DegreesBecomeRadians) {
  EXPECT_EQ(to_radians(180, AngleUnit::degrees), std::numbers::pi);
  EXPECT_EQ(to_radians(90, AngleUnit::degrees), std::numbers::pi / 2);
  EXPECT_EQ(to_radians(1.25, AngleUnit::radians), 1.25);
}

TEST(PoseNotes, SayWhatTheNumbersSuggest) {
  const auto notes = [](const std::string& text, const PoseFormat& format,
                        const std::optional<Arm::Reach>& sphere = std::nullopt) {
    const PoseList list = poses_from_csv(text, "a.csv", format);
    std::vector<std::string> said;
    for (const PoseNote& note : notes_on(list, format, sphere)) {
      said.push_back(name(note.kind) + " " + sentence(note, "a.csv"));
    }
    return said;
  };
  using Said = std::vector<std::string>;
  const Arm::Reach reach{.centre = {0, 0, 0}, .radius = 1};
  const std::string header = "x,y,z,roll,pitch,yaw\n";
  EXPECT_EQ(notes(header + "1,2,3,0.1,0.2,6\n", {}, reach), Said());
  EXPECT_EQ(
      notes("1,2,3,0,0,0\n", {}),
      Said{"no_header a.csv has no header; its columns are read as x, y, z, roll, pitch, yaw"});
  EXPECT_EQ(notes(header + "1,2,3,0,0,-90\n1,2,3,0,0,4\n", {}),
            Said{"likely_degrees a.csv: an angle of -90 rad is more than a revolution; "
                 "angle_unit=\"degrees\" reads degrees"});
  EXPECT_EQ(notes(header + "1,2,3,0,0,-90\n", {.angle_unit = AngleUnit::degrees}), Said());
  EXPECT_EQ(notes("x,y,z,rx,ry,rz\n1,2,3,0,0,90\n", {.angle_unit = AngleUnit::degrees}),
            Said{"long_rotation_vector a.csv: a rotation vector of 90 rad is more than a "
                 "revolution; rx, ry, rz are in radians"});
  const std::string far = header + "0,0,0,0,0,0\n0,500,0,0,0,0\n0,600,0,0,0,0\n";
  EXPECT_EQ(notes(far, {}), Said());
  EXPECT_EQ(notes(far, {}, reach),
            Said{"likely_millimetres a.csv: a position 500 m away is probably in millimetres; "
                 "millimetres=True reads millimetres"});
  EXPECT_EQ(notes(far, {.millimetres = true}, reach), Said());
  EXPECT_EQ(
      sentence({.kind = PoseNoteKind::likely_degrees, .value = 7}, "--pose", OptionStyle::command),
      "--pose: an angle of 7 rad is more than a revolution; --degrees reads degrees");
}

}  // namespace
}  // namespace beeline
