#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/io/text/arm.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/numbers.h>
#include <beeline/io/trajectory_file.h>
#include <beeline/model/catalog.h>

#include <tests/io/random_trajectory.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline {
namespace {

const Arm& rrr() {
  static const Arm arm = built_in("rrr");
  return arm;
}

/// The arm with these names of joints.
Arm renamed(const Arm& arm, const std::vector<std::string>& names) {
  std::vector<Joint> joints = arm.joints();
  for (std::size_t i = 0; i < joints.size(); ++i) joints[i].name = names[i];
  return {arm.name(), joints};
}

Recording parse(const std::string& text, const RecordingOptions& options = {}) {
  return parse_recording(text, "a.csv", rrr(), options);
}

/// A trajectory of rrr whose numbers have at most 15 digits.
Trajectory random_recording(testing::Random& random) {
  Trajectory trajectory = testing::random_trajectory(random, rrr().joint_names());
  for (auto* column : {&trajectory.positions, &trajectory.velocities, &trajectory.accelerations}) {
    for (Configuration& q : *column) {
      for (double& value : q) value = random.integer(-99'999'999, 99'999'999) / 1e7;
    }
  }
  for (double& time : trajectory.times) time = std::round(time * 1e6) / 1e6 + 1;
  for (std::size_t k = 1; k < trajectory.size(); ++k) {
    trajectory.times[k] = std::max(trajectory.times[k], trajectory.times[k - 1] + 1e-3);
  }
  return trajectory;
}

/// How another program writes a table.
struct Style {
  std::string separator = ",", time = "t";
  bool header = true, commented = false, decimal_comma = false;
};

std::string written(const Trajectory& trajectory, const Style& style) {
  std::string text;
  const auto row = [&](const std::vector<std::string>& items) {
    for (std::size_t i = 0; i < items.size(); ++i)
      text += (i == 0 ? "" : style.separator) + items[i];
    text += '\n';
  };
  const int columns = 1 + static_cast<int>(!trajectory.velocities.empty()) +
                      static_cast<int>(!trajectory.accelerations.empty());
  std::vector<std::string> header{style.time};
  const char* const suffixes[] = {"", "_vel", "_acc"};
  for (int c = 0; c < columns; ++c) {
    for (const std::string& name : trajectory.joint_names) header.push_back(name + suffixes[c]);
  }
  if (style.commented) text += "# written by a test\n# ";
  if (style.header) row(header);
  const std::vector<Configuration>* const values[] = {&trajectory.positions, &trajectory.velocities,
                                                      &trajectory.accelerations};
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    std::vector<std::string> items{exact(trajectory.times[k])};
    for (int c = 0; c < columns; ++c) {
      for (const double value : (*values[c])[k]) items.push_back(exact(value));
    }
    if (style.decimal_comma) {
      for (std::string& item : items) std::replace(item.begin(), item.end(), '.', ',');
    }
    row(items);
  }
  return text;
}

TEST(Recording, TablesOfOtherProgramsAreRead) {
  testing::Random random;
  const std::string separators[] = {",", ";", "\t", " ", "   ", " ; "};
  const std::string times[] = {"t",      "time", "timestamp", "Time",  "__time",       "%time",
                               "time_s", "t[s]", "Time (s)",  "stamp", "header.stamp", "sec"};
  for (int i = 0; i < 600; ++i) {
    const Trajectory trajectory = random_recording(random);
    Style style{separators[random.integer(0, 5)], times[random.integer(0, 11)]};
    style.header = random.integer(0, 3) > 0;
    style.commented = style.header && random.integer(0, 2) == 0;
    style.decimal_comma = style.separator != "," && random.integer(0, 1) == 0;
    const bool blanks = style.separator.find_first_not_of(' ') == std::string::npos;
    if (blanks && style.time.find(' ') != std::string::npos) continue;
    const std::string text = written(trajectory, style);
    const Recording recording = parse(text);
    ASSERT_TRUE(testing::same(recording.trajectory, trajectory)) << text;
    ASSERT_EQ(recording.notes.size(), style.header ? 0u : 1u) << text;
  }
}

TEST(Recording, ItsOwnFilesAreReadInEveryFormat) {
  testing::Random random;
  const testing::TemporaryFolder folder;
  for (int i = 0; i < 100; ++i) {
    const Trajectory trajectory =
        testing::in_nanoseconds(testing::random_trajectory(random, rrr().joint_names()));
    for (const char* name : {"a.csv", "a.json", "a.yaml", "a.yml"}) {
      write_trajectory(folder.file(name), trajectory);
      ASSERT_TRUE(testing::same(read_recording(folder.file(name), rrr()).trajectory, trajectory));
    }
  }
}

TEST(Recording, ExportedFilesAreRead) {
  testing::Random random;
  const testing::TemporaryFolder folder;
  for (int i = 0; i < 50; ++i) {
    Trajectory trajectory = testing::in_nanoseconds(random_recording(random));
    const double begin = trajectory.times.front();
    for (double& time : trajectory.times) time -= begin;
    trajectory = testing::in_nanoseconds(trajectory);
    for (const std::string& ending : controller_file_endings(ControllerForm::ros2)) {
      ControllerFileOptions options;
      options.comments = ending != "json";
      const ControllerFile file = controller_file(rrr(), trajectory, ControllerForm::ros2, options);
      const Recording read = parse_recording(file.text, "a." + ending, rrr());
      ASSERT_TRUE(testing::same(read.trajectory, trajectory)) << file.text;
    }
    if (trajectory.times.back() < 0.1) continue;
    const ControllerFile file =
        controller_file(rrr(), trajectory, ControllerForm::csv, {.rate = 100});
    EXPECT_EQ(parse(file.text).trajectory.size(), file.samples);
  }
}

TEST(Recording, TimesAreInTheUnitOfTheirColumnOrOption) {
  const auto times = [](const std::string& column, const std::string& first,
                        const std::string& second, const RecordingOptions& options = {}) {
    return parse(column + ",joint1,joint2,joint3\n" + first + ",0,0,0\n" + second + ",1,1,1\n",
                 options)
        .trajectory.times;
  };
  using Times = std::vector<double>;
  EXPECT_EQ(times("time_ms", "8", "16.5"), (Times{0.008, 0.0165}));
  EXPECT_EQ(times("Time [us]", "8", "16"), (Times{8e-6, 16e-6}));
  EXPECT_EQ(times("t_ns", "8", "16"), (Times{8e-9, 16e-9}));
  EXPECT_EQ(times("time", "8", "16"), (Times{8, 16}));
  EXPECT_EQ(times("time", "8", "16", {.time_unit = TimeUnit::milliseconds}), (Times{0.008, 0.016}));
  EXPECT_EQ(times("t", "8", "16", {.time_unit = TimeUnit::nanoseconds}), (Times{8e-9, 16e-9}));
  EXPECT_EQ(times("time", "1700000000.25", "1700000001"), (Times{1700000000.25, 1700000001}));
  // Since 1970: to the last digit, which a double does not hold.
  EXPECT_EQ(times("time", "1700000000123456789", "1700000000123456790"), (Times{0, 1e-9}));
  EXPECT_EQ(times("stamp", "1700000000123456", "1700000000123457"), (Times{0, 1e-6}));
  EXPECT_EQ(times("timestamp", "1700000000123", "1700000000124"), (Times{0, 1e-3}));
  EXPECT_EQ(times("time_ns", "1700000000123456789", "1700000000123456790"), (Times{0, 1e-9}));
  EXPECT_EQ(times("time", "-1700000000123456789", "1700000000123456790").front(), 0);
  const Recording noted =
      parse("time;joint1;joint2;joint3\n1700000000123;0;0;0\n1700000000124;0;0;1\n");
  ASSERT_EQ(noted.notes.size(), 1u);
  EXPECT_EQ(sentence(noted.notes[0]),
            "a.csv: column time has times since 1970 in ms, which count from the first sample");
  // However the unit is known.
  const std::string rows = ";joint1;joint2;joint3\n1700000000123;0;0;0\n1700000000124;0;0;1\n";
  EXPECT_EQ(parse("time_ms" + rows).notes.size(), 1u);
  EXPECT_EQ(parse("t" + rows, {.time_unit = TimeUnit::milliseconds}).notes.size(), 1u);
  EXPECT_EQ(parse("t;joint1;joint2;joint3\n1700000000;0;0;0\n").notes.size(), 0u);
}

TEST(Recording, ATimeUnitIsRefusedWhereTheFormatHasOne) {
  const RecordingOptions ms{.time_unit = TimeUnit::milliseconds};
  const RecordingOptions seconds{.time_unit = TimeUnit::seconds};
  RecordingOptions optional = ms;
  optional.time_unit_is_optional = true;
  const Trajectory trajectory{
      rrr().joint_names(), {0.5, 1.5}, {Vector3(0, 0, 0), Vector3(1, 1, 1)}, {}, {}};
  const std::string json = trajectory_text(trajectory, TrajectoryFormat::json);
  for (const char* path : {"a.json", "a.yaml"}) {
    const auto read = [&](const RecordingOptions& options) {
      return parse_recording(json, path, rrr(), options);
    };
    EXPECT_REFUSED(read(ms), std::string(path) +
                                 ": has times in seconds and nanoseconds; a time unit (time_unit, "
                                 "--time-unit) is for tables with one column of times");
    EXPECT_EQ(read(seconds).trajectory.times, trajectory.times);
    EXPECT_TRUE(read(seconds).in_time_unit);
    EXPECT_EQ(read(optional).trajectory.times, trajectory.times);
    EXPECT_FALSE(read(optional).in_time_unit);
  }
  const std::string stamped = "sec,nanosec,joint1,joint2,joint3\n1,5,0,0,0\n";
  EXPECT_REFUSED(parse(stamped, ms),
                 "a.csv: columns sec and nanosec are seconds and nanoseconds; a time unit");
  EXPECT_EQ(parse(stamped, seconds).trajectory.times, parse(stamped).trajectory.times);
  EXPECT_EQ(parse(stamped, optional).trajectory.times, parse(stamped).trajectory.times);
  EXPECT_FALSE(parse(stamped, optional).in_time_unit);
  EXPECT_TRUE(parse("t,joint1,joint2,joint3\n1,0,0,0\n", optional).in_time_unit);
  RecordingOptions path = ms;
  path.needs_times = false;
  EXPECT_REFUSED(parse("joint1,joint2,joint3\n0,0,0\n", path), "a.csv: has no times; a time unit");
}

TEST(Recording, NamesOfColumnsAreInUpperOrLowerCase) {
  const Recording read = parse(
      "TIME,JOINT2,Joint1,JOINT3,JOINT2_VEL,Joint1_Vel,JOINT3_vel\n"
      "0,2,1,3,5,4,6\n");
  EXPECT_EQ(read.trajectory.joint_names, rrr().joint_names());
  EXPECT_EQ(read.trajectory.positions[0], Vector3(1, 2, 3));
  EXPECT_EQ(read.trajectory.velocities[0], Vector3(4, 5, 6));
  EXPECT_EQ(parse("T,JOINT1,JOINT2,JOINT3\n0.5,1,2,3\n").trajectory.times[0], 0.5);
  EXPECT_EQ(parse("Time,/JS/JOINT1/Position,/JS/JOINT2/Position,/JS/JOINT3/Position\n0,1,2,3\n")
                .trajectory.positions[0],
            Vector3(1, 2, 3));
  const Arm pair("pair", {rrr().joints()[0], rrr().joints()[1]});
  const Arm cases = renamed(pair, {"a", "A"});
  EXPECT_EQ(parse_recording("t,A,a\n0,1,2\n", "a.csv", cases).trajectory.positions[0],
            Eigen::Vector2d(2, 1));
}

TEST(Recording, NotesOnUnitsAreData) {
  const Arm ur5e = built_in("ur5e");
  const std::string header = "t,joint1,joint2,joint3,joint4,joint5,joint6\n";
  const std::string text = header + "0,-90,-45,90,10,20,30\n1,-91,-45,90,10,20,30\n";
  const auto read = [&](const RecordingOptions& options) {
    return parse_recording(text, "a.csv", ur5e, options);
  };
  const Recording hinted = read({});
  ASSERT_EQ(hinted.notes.size(), 1u);
  EXPECT_EQ(hinted.notes[0].kind, RecordingNoteKind::likely_degrees);
  EXPECT_EQ(hinted.notes[0].joint, "joint1");
  EXPECT_EQ(hinted.notes[0].value, -91);
  EXPECT_EQ(hinted.trajectory.positions[0][0], -90);
  const Recording detected = read({.detect_degrees = true});
  ASSERT_EQ(detected.notes.size(), 1u);
  EXPECT_EQ(detected.notes[0].kind, RecordingNoteKind::read_in_degrees);
  const Recording said = read({.match = {.angle_unit = std::numbers::pi / 180}});
  EXPECT_TRUE(said.notes.empty());
  EXPECT_EQ(said.trajectory.positions, detected.trajectory.positions);
  EXPECT_NEAR(said.trajectory.positions[0][0], -std::numbers::pi / 2, 1e-15);
}

TEST(Recording, SecondsAndNanosecondsMayBeTwoColumns) {
  for (const std::string names :
       {"sec,nanosec", "secs,nsecs", "header.stamp.sec,header.stamp.nanosec",
        "stamp_sec,stamp_nanosec", "time_sec,time_nsec", "header_stamp_secs,header_stamp_nsecs",
        "field.header.stamp.secs,field.header.stamp.nsecs"}) {
    const auto times = [&](const std::string& sec) {
      return parse(names + ",joint1,joint2,joint3\n" + sec + ",999999999,0,0,0\n" + sec +
                   "5,000000001,1,1,1\n")
          .trajectory.times;
    };
    EXPECT_EQ(times("1"), (std::vector<double>{1.999999999, 15.000000001}));
    EXPECT_EQ(times("170000000").front(), 0);
    const Recording since = parse(names + ",joint1,joint2,joint3\n1700000000,5,0,0,0\n");
    ASSERT_EQ(since.notes.size(), 1u);
    EXPECT_EQ(sentence(since.notes[0]), "a.csv: columns " + names.substr(0, names.find(',')) +
                                            ", " + names.substr(names.find(',') + 1) +
                                            " have times since 1970 in s and ns, which count from "
                                            "the first sample");
    EXPECT_TRUE(parse(names + ",joint1,joint2,joint3\n1,5,0,0,0\n").notes.empty());
  }
}

TEST(Recording, SecondsBesideNanosecondsAreWhole) {
  for (const std::string names : {"sec,nanosec", "time_sec,time_nsec"}) {
    const auto read = [&](const std::string& time) {
      return parse(names + ",joint1,joint2,joint3\n" + time + ",0,0,0\n").trajectory.times.front();
    };
    EXPECT_EQ(read("-2,-999999999"), -2.999999999);
    const std::string seconds = names.substr(0, names.find(','));
    EXPECT_REFUSED(read("0.5,400000000"),
                   "a.csv:2: column " + seconds + ": 0.5 must be whole seconds, as column");
    EXPECT_REFUSED(read("1,3000000000"), "3000000000 must be below 1000000000, nanoseconds of a");
  }
}

TEST(Recording, TablesOfRosMessagesMayHaveTexts) {
  const Recording read = parse(
      "Time,header.seq,header.frame_id,name_0,joint1/position,joint2/position,joint3/position,"
      "joint1/velocity,joint2/velocity,joint3/velocity,joint1/effort\n"
      "0.5,1,base_link,joint1,1,2,3,4,5,6,7\n1.5,2,,\"a,b\",2,3,4,5,6,7,8\n");
  EXPECT_EQ(read.trajectory.times, (std::vector<double>{0.5, 1.5}));
  EXPECT_EQ(read.trajectory.positions[0], Vector3(1, 2, 3));
  EXPECT_EQ(read.trajectory.velocities[1], Vector3(5, 6, 7));
  EXPECT_REFUSED(parse("Time,name_0,position_0,position_1,position_2\n0,joint1,1,2,3\n"),
                 "the arm has no position_0, position_1, position_2; the arm's joints are joint1, "
                 "joint2, joint3; a joint map (joint_map, --joint-map) names");
  const RecordingOptions mapped{
      .match = {.joint_map = read_joint_map("position_2,-position_0,position_1", rrr())}};
  EXPECT_EQ(
      parse("Time,name_0,position_0,position_1,position_2,gripper\n0,joint1,1,2,3,9\n", mapped)
          .trajectory.positions[0],
      Vector3(3, -1, 2));
}

TEST(Recording, PathsNeedNoTimes) {
  const RecordingOptions path{.needs_times = false};
  for (const char* text : {"joint3,joint1,joint2\n3,1,2\n6,4,5\n", "1,2,3\n4,5,6\n"}) {
    const Recording read = parse(text, path);
    EXPECT_FALSE(read.has_times);
    EXPECT_EQ(read.trajectory.times, (std::vector<double>{0, 1}));
    EXPECT_EQ(read.trajectory.positions[1], Vector3(4, 5, 6));
  }
  EXPECT_TRUE(parse("0,1,2,3\n1,4,5,6\n", path).has_times);
}

TEST(Recording, AMapMayBeForOneOfTwoFiles) {
  const RecordingOptions options{.match = {.joint_map = read_joint_map("-c,b,a", rrr())},
                                 .map_is_optional = true};
  EXPECT_FALSE(parse("t,joint1,joint2,joint3\n0,1,2,3\n", options).mapped);
  const Recording mapped = parse("t,a,b,c\n0,1,2,3\n", options);
  EXPECT_TRUE(mapped.mapped);
  EXPECT_EQ(mapped.trajectory.positions[0], Vector3(-3, 2, 1));
  EXPECT_REFUSED(parse("t,a,b\n0,1,2\n", options), "a.csv: unknown joint of the joint_map \"c\"");
}

TEST(Recording, MistakesAreNamed) {
  const std::string header = "t;joint1;joint2;joint3\n";
  EXPECT_REFUSED(parse(header + "0;1,5;2.5;3\n"),
                 "a.csv:2: this row has decimal commas where others");
  EXPECT_REFUSED(parse(header + "0,5;1;2;3\n1.5;1;2;3\n"), "a.csv:3: this row has decimal commas");
  EXPECT_REFUSED(parse(header + "0;1,5,5;2;3\n"), "column joint1: \"1,5,5\" is not a number");
  EXPECT_REFUSED(parse("when,joint1,joint2,joint3\n0,1,2,3\n"),
                 "a.csv: column \"t\" is missing: seconds, increasing; its name may be time, "
                 "timestamp, stamp, date, time_from_start, elapsed or sec, with a unit as in "
                 "time_ms; the columns are when, joint1, joint2, joint3");
  EXPECT_REFUSED(parse("a,b,c,d,e,f,g,h,i,j\n0,1,2,3,4,5,6,7,8,9\n"),
                 "the columns are a, b, c, d, e, f, g, h and 2 more");
  for (const char* column : {"time_min", "t (h)", "Time [minutes]"}) {
    EXPECT_REFUSED(parse(std::string(column) + ",joint1,joint2,joint3\n0,1,2,3\n"),
                   "is in a unit of times that is not read; units of times are s, ms, us and ns");
  }
  EXPECT_REFUSED(parse("0,1\n1,2\n"),
                 "a.csv:1: the first line must be a header of names; it has 2 numbers, and a row "
                 "without a header has one of 4 (t, joint1, joint2, joint3), 7 (t, joint1, joint2, "
                 "joint3, joint1_vel, joint2_vel, joint3_vel), 10 (t, joint1, ..., joint3_acc)");
  EXPECT_REFUSED(parse("time,joint1,joint2,joint3\n1,0,0,0\n0.5,0,0,0\n"),
                 "a.csv:3: column time: time 0.5 is not after 1; times must increase");
  EXPECT_REFUSED(read_recording("a.xyz", rrr()), "known are .csv, .json, .yaml and, read as .csv");
}

TEST(JointMap, IsReadFromNamesOrAFile) {
  const testing::TemporaryFolder folder;
  const JointMap names = read_joint_map("a, -b,c d", rrr());
  EXPECT_EQ(names[1].name, "b");
  EXPECT_EQ(names[1].sign, -1);
  EXPECT_EQ(names[2].name, "c d");
  const JointMap file = read_joint_map(
      folder.write("map.json",
                   "{\"joint1\": \"A1\", \"joint3\": {\"name\": \"A3\", \"sign\": -1, \"offset\": "
                   "90, \"unit\": \"deg\"}}"),
      rrr());
  EXPECT_EQ(file[0].name, "A1");
  EXPECT_EQ(file[1].name, "joint2");
  EXPECT_EQ(file[2].sign, -1);
  EXPECT_EQ(file[2].offset, 90);
  EXPECT_EQ(file[2].unit, std::numbers::pi / 180);
  EXPECT_FALSE(file[1].unit.has_value());
  EXPECT_REFUSED(read_joint_map("a,b", rrr()),
                 "the joint map has 2 names, not 3, for joint1, joint2");
  EXPECT_REFUSED(read_joint_map("a,,b", rrr()), "a name of the joint map is empty");
  EXPECT_REFUSED(read_joint_map(folder.file("none.json"), rrr()), "none.json: cannot be read");
  const auto refusal = [&](const std::string& text) {
    return read_joint_map(folder.write("bad.json", text), rrr());
  };
  EXPECT_REFUSED(refusal("{\"joint4\": \"A\"}"), "unknown key \"joint4\"");
  EXPECT_REFUSED(refusal("{\"joint1\": {\"sign\": 2}}"), "joint1.sign must be 1 or -1");
  EXPECT_REFUSED(refusal("{\"joint1\": {\"unit\": \"mm\"}}"),
                 "unknown unit of joint joint1 \"mm\"");
  EXPECT_REFUSED(refusal("{\"joint1\": {\"scale\": 2}}"), "unknown key \"scale\"");
  EXPECT_REFUSED(refusal("[]"), "bad.json");
}

TEST(Recording, SaysThatATableHasPosesOrMoves) {
  const Arm rrr = built_in("rrr"),
            gantry = arm_from_json(
                R"({"name": "xyz", "joints": [{"type": "prismatic", "name": "x"},
                      {"type": "prismatic", "name": "y"}, {"type": "prismatic", "name": "z"}]})",
                "xyz.json");
  const std::string joints = ", not values of the joints joint1, joint2, joint3; `beeline line";
  const auto parse = [](const Arm& arm, const char* text) { parse_recording(text, "a.csv", arm); };
  EXPECT_REFUSED(parse(rrr, "x,y,theta\n1,2,3\n"),
                 "a.csv: has poses of the tool, x, y, theta" + joints);
  EXPECT_REFUSED(parse(rrr, "X,Y,Z,QW,QX,QY,QZ\n1,2,3,1,0,0,0\n"), "has poses of the tool, X");
  EXPECT_REFUSED(parse(rrr, "t,x,y,z\n0,1,2,3\n"), "has poses of the tool, x, y, z" + joints);
  EXPECT_REFUSED(parse(rrr, "motion,x,y,theta\nline,1,2,3\n"),
                 "is a program: it has moves" + joints);
  EXPECT_REFUSED(parse(rrr, "t,a,b,c\n0,1,2,3\n"), "joint1");
  // Joints of these names are not poses.
  EXPECT_REFUSED(parse(gantry, "x,y,z\n1,2,3\n"), "column \"t\" is missing");
  EXPECT_EQ(parse_recording("t,x,y,z\n0,1,2,3\n", "a.csv", gantry).trajectory.size(), 1u);
}

}  // namespace
}  // namespace beeline
