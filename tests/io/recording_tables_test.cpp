#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>

#include <beeline/io/trajectory_file.h>
#include <beeline/model/catalog.h>

#include <tests/random.h>
#include <tests/refusal.h>

// Tables of pandas and of ROS's commands, times that are not read, and units of times.

namespace beeline {
namespace {

using Seconds = std::vector<double>;

Recording read_table(const std::string& text, const RecordingOptions& options = {},
                     const std::string& path = "a.csv") {
  return parse_recording(text, path, built_in("rrr"), options);
}

Recording timed_table(const std::string& columns, const std::vector<std::string>& rows,
                      const RecordingOptions& options = {}) {
  std::string text = columns + ",joint1,joint2,joint3\n";
  for (const std::string& row : rows) text += row + ",0,0,0\n";
  return read_table(text, options);
}

TEST(RecordingTables, AnIndexOfPandasIsNotRead) {
  for (const char* name : {"", "Unnamed: 0", "\"\""}) {
    const Recording read =
        read_table(std::string(name) + ",t,joint1,joint2,joint3\n0,0.5,1,2,3\n1,1.5,4,5,6\n");
    EXPECT_EQ(read.trajectory.times, (Seconds{0.5, 1.5}));
    EXPECT_EQ(read.trajectory.positions[1], Vector3(4, 5, 6));
    ASSERT_EQ(read.notes.size(), 1u);
    EXPECT_EQ(sentence(read.notes[0]),
              "a.csv: column Unnamed: 0 numbers the rows, as the index of a table does, and is not "
              "read");
  }
  EXPECT_REFUSED(read_table("t,,joint1\n0,1,2\n"), "a.csv:1: the name of column 2 is empty");
  EXPECT_REFUSED(parse_trajectory(",t,joint1\n0,1,2\n", "a.csv"), "the name of column 1 is empty");
}

/// Rows as `rostopic echo -p` or, without a header, `ros2 topic echo --csv` prints them.
TEST(RecordingTables, MessagesInRowsAreRead) {
  const std::string header =
      "%time,field.header.seq,field.header.stamp,field.header.frame_id,field.name0,field.name1,"
      "field.name2,field.position0,field.position1,field.position2";
  const std::string rates = ",field.velocity0,field.velocity1,field.velocity2";
  const Recording ros1 =
      read_table(header + rates + "\n17,1,1714550400000000000,,joint3,joint1,joint2,3,1,2,6,4,5\n" +
                 "18,2,1714550400500000001,base,joint1,joint2,joint3,7,8,9,10,11,12\n");
  EXPECT_EQ(ros1.trajectory.times, (Seconds{0, 0.500000001}));
  EXPECT_EQ(ros1.trajectory.positions[0], Vector3(1, 2, 3));
  EXPECT_EQ(ros1.trajectory.velocities[0], Vector3(4, 5, 6));
  EXPECT_EQ(ros1.trajectory.positions[1], Vector3(7, 8, 9));
  const std::string names = "joint1,joint2,joint3,";
  const Recording ros2 = read_table("5,0,base," + names + "1,2,3,4,5,6,0,0,0\n5,500000000,," +
                                    names + "2,3,4,5,6,7,0,0,0\n");
  EXPECT_EQ(ros2.trajectory.times, (Seconds{5, 5.5}));
  EXPECT_EQ(ros2.trajectory.velocities[1], Vector3(5, 6, 7));
  EXPECT_TRUE(read_table("5,0,," + names + "1,2,3\n").notes.empty());
  const Recording either = read_table("5,0,," + names + "1,2,3,4,5,6\n");
  EXPECT_TRUE(either.trajectory.velocities.empty());
  EXPECT_EQ(either.notes.at(0).kind, RecordingNoteKind::unread_rates);
  EXPECT_EQ(
      read_table(header + ",field.velocity0\n17,1,5,," + names + "1,2,3,4\n").notes.at(0).kind,
      RecordingNoteKind::unread_rates);
  EXPECT_REFUSED(
      read_table("5,0,," + names + "1,2\n"),
      "a.csv:1: seems to be what `ros2 topic echo --csv` prints of another message than "
      "sensor_msgs/JointState; `ros2 topic echo /joint_states > FILE.yaml` writes a file");
  EXPECT_REFUSED(read_table("%time,field.joint_names0,field.actual.positions0\n1,joint1,2\n"),
                 "a.csv:2: seems to be what `rostopic echo -p` prints of another message");
  EXPECT_REFUSED(read_table("5,0,," + names + "1,2,3\n6,0,," + names + "1,2\n"),
                 "a.csv:2: this row has 8 items; the first has 9");
  EXPECT_REFUSED(read_table("5,0,," + names + "1,2,3\n6,0,," + names + "1,2,x\n"),
                 "a.csv:2: position[2]");
}

TEST(RecordingTables, SomeVelocitiesOfMessagesAreNoted) {
  const auto message = [](int sec, const std::string& velocity) {
    return "header: {stamp: {sec: " + std::to_string(sec) +
           ", nanosec: 0}}\nname: [joint1, joint2, joint3]\nposition: [1, 2, 3]\nvelocity: [" +
           velocity + "]\n---\n";
  };
  const auto notes = [&](const std::string& first, const std::string& second) {
    return read_table(message(1, first) + message(2, second), {}, "a.yaml").notes;
  };
  EXPECT_TRUE(notes("", "").empty());
  EXPECT_TRUE(notes(".nan, .nan, .nan", "").empty());
  EXPECT_TRUE(notes("1, 2, 3", "1, 2, 3").empty());
  for (const auto& [first, second] :
       {std::pair("1, 2, 3", ""), {"", "1, 2, 3"}, {"1, .nan, 3", "1, .nan, 3"}}) {
    const auto found = notes(first, second);
    ASSERT_EQ(found.size(), 1u) << first;
    EXPECT_EQ(
        sentence(found[0]),
        "a.yaml: column velocity is not read: rates must be there for all joints and samples, "
        "and accelerations need velocities");
  }
}

TEST(RecordingTables, OtherTimesAreNoted) {
  for (const auto& [columns, unread] :
       std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"stamp.sec,stamp.nanosec,rx.sec,rx.nanosec", {"rx.sec", "rx.nanosec"}},
           {"__time,a,/h/stamp/sec,/h/stamp/nanosec", {"/h/stamp/sec", "/h/stamp/nanosec"}}}) {
    const std::string names =
        columns.starts_with("__") ? "__time,/h/stamp/sec,/h/stamp/nanosec" : columns;
    const std::string items = columns.starts_with("__") ? "5,6,0" : "5,0,6,0";
    const Recording read = timed_table(names, {items});
    ASSERT_EQ(read.notes.size(), 1u) << names;
    EXPECT_EQ(read.notes[0].kind, RecordingNoteKind::other_times);
    EXPECT_EQ(read.notes[0].columns, unread);
    EXPECT_EQ(read.trajectory.times, Seconds{5});
  }
  EXPECT_EQ(timed_table("sec,nanosec", {"1714550400,0"}).notes.at(0).finer_unit,
            TimeUnit::nanoseconds);
}

TEST(RecordingTables, ATimeUnitMustBeTheNamedOne) {
  const RecordingOptions seconds{.time_unit = TimeUnit::seconds};
  EXPECT_REFUSED(timed_table("time_ms", {"5"}, seconds),
                 "a.csv: column time_ms is in ms, as its name says, but the time unit (time_unit, "
                 "--time-unit) is s");
  EXPECT_REFUSED(
      timed_table("time_ms,time_us", {"5,1"}, seconds),
      "a.csv: columns time_ms and time_us are milliseconds and microseconds; a time unit");
  EXPECT_EQ(timed_table("time_ms", {"5"}, {.time_unit = TimeUnit::milliseconds}).trajectory.times,
            Seconds{0.005});
  const RecordingOptions optional{.time_unit = TimeUnit::seconds, .time_unit_is_optional = true};
  const Recording read = timed_table("time_ms", {"5"}, optional);
  EXPECT_EQ(read.trajectory.times, Seconds{0.005});
  EXPECT_FALSE(read.in_time_unit);
}

/// A unit is inferred for times of the years 1990 to 2100 alone.
TEST(RecordingTables, UptimesAreNoDates) {
  for (const char* time : {"500000000000", "86400000000", "86400000000000", "12345678901234"}) {
    for (const char* column : {"time", "timestamp", "t"}) {
      EXPECT_REFUSED(
          timed_table(column, {time}),
          "is a time of the years 1990 to 2100 in none of s, ms, us and ns since 1970; its "
          "unit must stand in the column's name, as time_ns, or in a time unit");
      EXPECT_GT(
          timed_table(column, {time}, {.time_unit = TimeUnit::nanoseconds}).trajectory.times[0], 0);
    }
  }
  EXPECT_EQ(timed_table("time_ns", {"500000000000"}).trajectory.times, Seconds{500});
  EXPECT_EQ(timed_table("t", {"1714550400000", "1714550400500"}).trajectory.times,
            (Seconds{0, 0.5}));
  EXPECT_EQ(timed_table("elapsed_ms", {"500"}).trajectory.times, Seconds{0.5});
  EXPECT_EQ(timed_table("tv_sec,tv_usec", {"5,500000"}).trajectory.times, Seconds{5.5});
}

/// The first of two columns agrees with the second one to its last digit.
TEST(RecordingTables, TwoTimesAgreeToTheDigitsThatAreWritten) {
  testing::Random random;
  for (int i = 0; i < testing::cases(900); ++i) {
    const int decimals = random.integer(1, 8);
    const double digit = std::pow(10, -decimals);
    const auto ticks = std::int64_t{random.integer(2'000'000'000, 2'100'000'000)} * 7 + 1;
    const double fine = static_cast<double>(ticks) / 1e9;
    const double off = random.uniform(-4, 4);
    char coarse[64];
    std::snprintf(coarse, sizeof coarse, "%.*f", decimals, fine + off * digit);
    const double apart = fine - std::atof(coarse);
    const bool near = std::abs(apart) < 0.499 * digit || (apart > 0 && apart < 0.999 * digit);
    const bool far = std::abs(apart) > 1.001 * digit || (apart < 0 && apart < -0.501 * digit);
    if (!near && !far) continue;
    const std::string row = std::string(coarse) + "," + std::to_string(ticks);
    const auto read = [&] { return timed_table("time_s,time_ns", {row}).trajectory.times; };
    if (near) {
      ASSERT_EQ(read(), Seconds{fine}) << row;
    } else {
      EXPECT_REFUSED(read(), "a.csv:2: column time_");
    }
  }
}

}  // namespace
}  // namespace beeline
