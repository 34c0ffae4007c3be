#include <gtest/gtest.h>
#include <numbers>

#include <beeline/io/number_rows.h>
#include <beeline/io/text/internal/column_unit.h>
#include <beeline/io/text/pose_list.h>
#include <beeline/io/trajectory_file.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>

#include <tests/random.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

// Units in comments and in a row below the header of a table.

namespace beeline {
namespace {

using testing::Random;

constexpr double one_degree = std::numbers::pi / 180;

Arm turn_and_slide() {
  return {"pair", {composite_joint('R', "turn").front(), composite_joint('P', "slide").front()}};
}

Recording pair_recording(const std::string& text, const RecordingOptions& options = {}) {
  return parse_recording(text, "a.csv", turn_and_slide(), options);
}

/// The units as the recording was read: radians, metres and seconds per unit.
void expect_units(const std::string& text, double turn, double slide, double second) {
  const Recording recording = pair_recording(text);
  EXPECT_NEAR(recording.trajectory.positions.at(1)[0], turn * 3, 1e-12) << text;
  EXPECT_NEAR(recording.trajectory.positions.at(1)[1], slide * 5, 1e-12) << text;
  EXPECT_NEAR(recording.trajectory.times.at(1), second * 7, 1e-12) << text;
}

const char* const two_rows = "0,1,2\n7,3,5\n";

TEST(StatedUnits, CommentsGiveUnits) {
  struct Case {
    const char* comment;
    double turn, slide, second;
  };
  for (const auto& [comment, turn, slide, second] :
       {Case{"# units: degrees", one_degree, 1, 1},
        {"# unit: rad", 1, 1, 1},
        {"% Unit = DEG", one_degree, 1, 1},
        {"# angles in deg", one_degree, 1, 1},
        {"# Joint angles are given in degrees", one_degree, 1, 1},
        {"#angle_unit: deg", one_degree, 1, 1},
        {"# all angles (\xc2\xb0), times (ms)", one_degree, 1, 1e-3},
        {"# units: deg, mm, ms", one_degree, 1e-3, 1e-3},
        {"%  turn t in s", 1, 1, 1},
        {"// turn slide t in ms", 1, 1, 1e-3},
        {"# t, turn in deg", one_degree, 1, 1},
        {"; turn, t in deg and ms", one_degree, 1, 1e-3},
        {"# units: deg/s, deg", one_degree, 1, 1},
        {"# degrees", one_degree, 1, 1},
        {"# in degrees", one_degree, 1, 1},
        {"# positions: mm", 1, 1e-3, 1},
        {"# time in us\n# units: deg", one_degree, 1, 1e-6},
        {"# recorded by a robot\n# angles: degrees\n# with care", one_degree, 1, 1},
        {"# converted from degrees", 1, 1, 1},
        {"# joint degrees of freedom: 2", 1, 1, 1},
        {"# angles not in deg", 1, 1, 1},
        {"# 12 deg above zero", 1, 1, 1},
        {"# unit 5 deg", 1, 1, 1}}) {
    expect_units(std::string(comment) + "\nt,turn,slide\n" + two_rows, turn, slide, second);
  }
  const Recording noted = pair_recording("# units: deg\nt,turn,slide\n0,1,2\n");
  ASSERT_EQ(noted.notes.size(), 1u);
  EXPECT_EQ(sentence(noted.notes[0]),
            "a.csv: columns without a unit are read in deg, as a comment says");
  // Without a header, too.
  expect_units(std::string("# units: deg, mm\n") + two_rows, one_degree, 1e-3, 1);
}

TEST(StatedUnits, ContradictionsAreRefused) {
  const std::string table = std::string("t,turn,slide\n") + two_rows;
  EXPECT_REFUSED(pair_recording("# units: rad\n" + table, {.match = {.angle_unit = one_degree}}),
                 "a.csv: a comment gives angles in rad, but the option angle_unit (--angle-unit)");
  EXPECT_REFUSED(pair_recording("# units: deg\n" + table, {.angle_unit_is_known = true}),
                 "a.csv: a comment gives angles in deg, but the option angle_unit");
  EXPECT_EQ(pair_recording("# units: deg\n" + table, {.match = {.angle_unit = one_degree}})
                .trajectory.positions,
            pair_recording("# units: deg\n" + table).trajectory.positions);
  EXPECT_REFUSED(pair_recording("# units: deg\nt,turn_rad,slide\n0,1,2\n"),
                 "a.csv: column \"turn_rad\" is in rad, but a comment says deg");
  EXPECT_REFUSED(pair_recording("# units: s\ntime_ms,turn,slide\n0,1,2\n"),
                 "a.csv: column time_ms is in ms, but a comment gives times in s");
  EXPECT_REFUSED(pair_recording("# units: ms\n" + table, {.time_unit = TimeUnit::seconds}),
                 "a.csv: column t is in s, but a comment gives times in ms");
  EXPECT_REFUSED(pair_recording("# units: deg\n# angles in rad\n" + table),
                 "the comments give angles in deg and in rad");
  EXPECT_REFUSED(pair_recording("t,turn_deg,slide\ns,rad,m\n0,1,2\n"),
                 "column turn_deg [rad] is in deg and in rad");
  EXPECT_REFUSED(parse_trajectory("# units: deg\n" + table, "a.csv"),
                 "a comment gives values in deg; they are read in this unit with an arm only");
  // A joint map gives the unit of its joints itself.
  const RecordingOptions mapped{.match = {.joint_map = {{"turn", 1, 0, 1}, {"slide", 1, 0, 1}}}};
  EXPECT_EQ(pair_recording("# units: deg\n" + table, mapped).trajectory.positions[0],
            Eigen::Vector2d(1, 2));
}

TEST(StatedUnits, ARowOfUnitsIsBelowTheHeader) {
  for (const char* row :
       {"s,deg,mm", "[s],[deg],[mm]", "(s),(\xc2\xb0),(mm)", "\"s\",\"deg\",\"mm\"", "S,DEG,MM",
        "sec,degrees,millimetres", "-,deg,mm", ",deg,mm"}) {
    expect_units(std::string("t,turn,slide\n") + row + "\n" + two_rows, one_degree, 1e-3, 1);
  }
  expect_units(std::string("t,turn,slide\nms,rad,m\n") + two_rows, 1, 1, 1e-3);
  expect_units(std::string("# t,turn,slide\n# ms,deg,m\n") + two_rows, one_degree, 1, 1e-3);
  expect_units(std::string("# t,turn,slide\nms,deg,m\n") + two_rows, one_degree, 1, 1e-3);
  expect_units("t turn slide\ns deg mm\n0 1 2\n7 3 5\n", one_degree, 1e-3, 1);
  const Recording rates = pair_recording(
      "t,turn,slide,turn_vel,slide_vel,turn_effort\ns,deg,mm,rad/s,m/s,Nm\n0,90,2,1,3,4\n");
  EXPECT_NEAR(rates.trajectory.velocities.at(0)[0], 1, 1e-12);
  EXPECT_NEAR(rates.trajectory.velocities.at(0)[1], 3, 1e-12);
  EXPECT_REFUSED(pair_recording("t,turn,slide\ns,deg,cm\n0,1,2\n"),
                 "a.csv:2: column slide: \"cm\" in the row of units is not read; units that are "
                 "read are rad, deg, m and mm");
  EXPECT_REFUSED(pair_recording("t,turn,slide\nmin,mrad,m\n0,1,2\n"),
                 "a.csv:2: column t: \"min\" in the row of units is not read");
  expect_units("sec,nanosec,turn,slide\ns,ns,deg,mm\n0,0,1,2\n7,0,3,5\n", one_degree, 1e-3, 1);
  EXPECT_REFUSED(pair_recording("sec,nanosec,turn,slide\ns,us,deg,mm\n0,0,1,2\n"),
                 "column nanosec [us] is in ns and in us");
  EXPECT_REFUSED(pair_recording("t,turn,slide\ns,mm,mm\n0,1,2\n"),
                 "but joint turn turns: rad or deg");
  EXPECT_REFUSED(pair_recording("t,turn,slide\ns,deg,mm\n"),
                 "a.csv: has a header but no rows below it");
  EXPECT_REFUSED(pair_recording("t,turn,slide\ns,deg,mm\n0,1\n"), "a.csv:3: this row has 2 items");
  EXPECT_REFUSED(pair_recording("t,turn,slide\n0,1,x\n"), "a.csv:2: column slide");
}

TEST(StatedUnits, NamesMayHaveAUnitBehindASlash) {
  expect_units(std::string("t/ms,turn/deg,slide/mm\n") + two_rows, one_degree, 1e-3, 1e-3);
  expect_units(std::string("time/s,turn [deg],slide [mm]\n") + two_rows, one_degree, 1e-3, 1);
  expect_units(std::string("time_from_start,turn,slide\n") + two_rows, 1, 1, 1);
  expect_units(std::string("time_from_start [ms],turn,slide\n") + two_rows, 1, 1, 1e-3);
}

TEST(StatedUnits, PosesHaveThem) {
  const auto pose = [](const std::string& text, const PoseFormat& format = {}) {
    return poses_from_csv(text, "a.csv", format).poses.at(0);
  };
  const std::string numbers = "1,2,3,4,5,6\n";
  const PoseFormat both{.angle_unit = AngleUnit::degrees, .millimetres = true};
  const Pose expected = pose("x,y,z,roll,pitch,yaw\n" + numbers, both);
  for (const std::string& text : {"x_mm,y_mm,z_mm,roll_deg,pitch_deg,yaw_deg\n" + numbers,
                                  "X [mm],Y [mm],Z [mm],Roll (deg),Pitch (deg),Yaw/deg\n" + numbers,
                                  "x,y,z,roll,pitch,yaw\nmm,mm,mm,deg,deg,deg\n" + numbers,
                                  "# units: mm, deg\nx,y,z,roll,pitch,yaw\n" + numbers,
                                  "# positions in mm, angles in degrees\n" + numbers}) {
    EXPECT_TRUE(pose(text).isApprox(expected, 1e-12)) << text;
    EXPECT_TRUE(pose(text, both).isApprox(expected, 1e-12)) << text;
  }
  EXPECT_TRUE(pose("x_mm,y_mm,z_mm,qw,qx,qy,qz\n1,2,3,1,0,0,0\n")
                  .isApprox(pose("x,y,z\n0.001,0.002,0.003\n"), 1e-12));
  EXPECT_REFUSED(pose("# units: m\nx,y,z\n1,2,3\n", both),
                 "column x is in m, as a comment says, but is asked for in mm");
  EXPECT_REFUSED(pose("x_deg,y,z\n1,2,3\n"), "column x_deg is in deg, but it is a length: m or mm");
  EXPECT_REFUSED(pose("x,y,theta_mm\n1,2,3\n"), "but it is an angle: rad or deg");
  EXPECT_REFUSED(pose("x,y,z,qw_deg,qx,qy,qz\n1,2,3,1,0,0,0\n"), "but it has no unit");
  const auto program = [](const std::string& text, const PoseFormat& format) {
    return program_rows_from_csv(text, "a.csv", format).rows.at(0).pose->pose;
  };
  EXPECT_TRUE(program("motion,x_mm,y_mm,theta\nline,1,2,3\n", {})
                  .isApprox(program("motion,x,y,theta\nline,0.001,0.002,3\n", {}), 1e-12));
}

TEST(StatedUnits, ProgramsHaveThem) {
  const auto row = [](const std::string& text, const PoseFormat& format = {}) {
    return program_rows_from_csv(text, "a.csv", format).rows.at(0);
  };
  const std::string items = "\nline,1,2,90,100,5,500\n";
  const ProgramRow expected = row("motion,x,y,theta,speed,blend,dwell\nline,0.001,0.002," +
                                  std::to_string(std::numbers::pi / 2) + ",0.1,0.005,0.5\n");
  for (const std::string& front :
       {std::string("# units: mm, deg, ms\nmotion,x,y,theta,speed,blend,dwell"),
        std::string("# units: mm, deg, mm/s, ms\nmotion,x,y,theta,speed,blend,dwell"),
        std::string("motion,x_mm,y_mm,theta_deg,speed [mm/s],blend_mm,dwell_ms"),
        std::string("motion,x,y,theta,speed,blend,dwell\n,mm,mm,deg,mm/s,mm,ms"),
        std::string("# x: mm, y: mm, theta: deg, speed: mm/s, blend: mm, dwell: ms\n"
                    "motion,x,y,theta,speed,blend,dwell")}) {
    for (const bool millimetres : {false, true}) {
      const ProgramRow read = row(front + items, {.millimetres = millimetres});
      EXPECT_TRUE(read.pose->pose.isApprox(expected.pose->pose, 1e-6)) << front;
      EXPECT_NEAR(*read.speed, 0.1, 1e-15) << front;
      EXPECT_NEAR(*read.blend, 0.005, 1e-15) << front;
      EXPECT_NEAR(*read.dwell, 0.5, 1e-15) << front;
    }
  }
  EXPECT_NEAR(*row("# units: mm, m/s\nmotion,x,y,speed\nline,1,2,0.5\n").speed, 0.5, 0);
  EXPECT_REFUSED(
      row("# positions in mm\nmotion,x,y,blend\nline,1,2,3\n"),
      "a.csv:2: a comment gives positions in mm, but no unit of blend; write it behind the "
      "column's name, as blend_mm");
  EXPECT_REFUSED(row("motion,x,y,speed_deg\nline,1,2,3\n"),
                 "column speed_deg must be in m/s or mm/s");
  EXPECT_REFUSED(row("motion,x,y,blend [mm/s]\nline,1,2,3\n"), "unknown column \"blend [mm/s]\"");
  EXPECT_REFUSED(row("# units: deg\nmotion,q\njoint,\"1,2\"\n"),
                 "a comment gives angles in deg, but the joint values, q, are in rad here");
  EXPECT_REFUSED(row("# units: cm\nmotion,x,y,theta\nline,1,2,3\n"),
                 "a.csv:1: the comment \"units: cm\" gives the unit \"cm\", which is not read");
  EXPECT_REFUSED(row("# dwell in min\nmotion,x,y,theta,dwell\nline,1,2,3,4\n"),
                 "gives the unit \"min\", which is not read");
  EXPECT_REFUSED(
      row("# converted from mm\nmotion,x,y,theta\nline,1,2,3\n"),
      "a.csv:1: the comment \"converted from mm\" does not say clearly in which unit the "
      "columns are; write it behind their names, as x_m or x_mm");
  EXPECT_EQ(row("# converted from mm\nmotion,x_m,y_m,theta\nline,1,2,3\n").pose->pose(0, 3), 1);
}

/// Rows of numbers in any units and any order equal the table in the wanted units.
TEST(StatedUnits, RowsOfNumbersAreConverted) {
  Random random;
  const testing::TemporaryFolder folder;
  const RowForms forms{{"turn", "slide"}};
  const std::pair<const char*, double> angles[] = {{"rad", 1}, {"deg", one_degree}},
                                       lengths[] = {{"m", 1}, {"mm", 1e-3}};
  for (int i = 0; i < testing::cases(200); ++i) {
    const auto &angle = angles[random.integer(0, 1)], &length = lengths[random.integer(0, 1)];
    const auto& wanted = angles[random.integer(0, 1)];
    const int form = random.integer(0, 2);
    const bool swapped = random.integer(0, 1) == 0;
    std::string text;
    if (form == 0) {
      text = std::string("turn_") + angle.first + ",Slide [" + length.first + "]\n";
      if (swapped) text = std::string("slide_") + length.first + ",turn/" + angle.first + "\n";
    } else if (form == 1) {
      text = swapped ? std::string("slide,turn\n") + length.first + "," + angle.first + "\n"
                     : std::string("turn,slide\n") + angle.first + "," + length.first + "\n";
    } else {
      text = std::string("# units: ") + angle.first + ", " + length.first + "\n" +
             (swapped ? "slide,turn\n" : "turn,slide\n");
    }
    text += swapped ? "5,3\n" : "3,5\n";
    const std::string path = folder.write("a.csv", text);
    if (form == 2 && wanted.second != 1 && angle.second == 1) {
      EXPECT_REFUSED(RowReader(path, forms, {{wanted.first, "m"}}), "is asked for in deg");
      continue;
    }
    RowReader reader(path, forms, {{wanted.first, "m"}});
    RowBlock block;
    BadRows bad;
    block.numbers.resize(2, 4);
    reader.read(block, bad);
    ASSERT_EQ(block.count(), 1) << text;
    ASSERT_NEAR(block.numbers(0, 0), 3 * angle.second / wanted.second, 1e-12) << text;
    ASSERT_NEAR(block.numbers(1, 0), 5 * length.second, 1e-12) << text;
  }
  EXPECT_REFUSED(RowReader(folder.write("b.csv", "turn_m,slide\n1,2\n"), forms, {{"rad", "m"}}),
                 "b.csv:1: column turn_m is in m, but it is an angle: rad or deg");
  EXPECT_REFUSED(RowReader(folder.write("c.csv", "turn_deg,slide\n1,2\n"), forms),
                 "the header has the columns turn_deg, slide; rows are turn, slide");
}

}  // namespace
}  // namespace beeline
