#include <cstdint>
#include <ctime>
#include <gtest/gtest.h>
#include <utility>

#include <beeline/io/internal/time_column.h>
#include <beeline/io/text/internal/date.h>
#include <beeline/io/text/numbers.h>
#include <beeline/io/trajectory_file.h>
#include <beeline/model/catalog.h>

#include <tests/random.h>
#include <tests/refusal.h>

// Times of recordings in two columns, and as dates.

namespace beeline {
namespace {

using testing::Random;
using Seconds = std::vector<double>;

const char* const joint_items = ",joint1,joint2,joint3\n";

Recording timed(const std::string& columns, const std::vector<std::string>& rows,
                const RecordingOptions& options = {}) {
  std::string text = columns + joint_items;
  for (const std::string& row : rows) text += row + ",0,0,0\n";
  return parse_recording(text, "a.csv", built_in("rrr"), options);
}

/// Two columns of one time, and how many of the first and of the second are a second.
struct TimePair {
  std::string names;
  std::int64_t coarse = 1, fine = 1;
};

const std::vector<TimePair>& pairs() {
  constexpr std::int64_t k = 1000, m = k * k, g = m * k;
  static const std::vector<TimePair> all{{"sec,nanosec", 1, g},
                                         {"secs,nsecs", 1, g},
                                         {"sec,nanosecs", 1, g},
                                         {"s,ns", 1, g},
                                         {"sec,usec", 1, m},
                                         {"sec,msec", 1, k},
                                         {"seconds,microseconds", 1, m},
                                         {"time_s,time_ns", 1, g},
                                         {"time_sec,time_usec", 1, m},
                                         {"time_sec,time_msec", 1, k},
                                         {"time_secs,time_nsecs", 1, g},
                                         {"Time (s),Time (us)", 1, m},
                                         {"t [s],t [ms]", 1, k},
                                         {"t/s,t/ns", 1, g},
                                         {"time,time_ns", 1, g},
                                         {"time,nsec", 1, g},
                                         {"timestamp,nanosec", 1, g},
                                         {"t,t_ns", 1, g},
                                         {"t,usec", 1, m},
                                         {"time_ms,time_us", k, m},
                                         {"header.stamp.sec,header.stamp.nanosec", 1, g},
                                         {"/a/header/stamp/secs,/a/header/stamp/nsecs", 1, g},
                                         {"time_from_start.sec,time_from_start.nanosec", 1, g}};
  return all;
}

/// A remainder below one unit of the first column, and both at once in the second one, are the same
/// time, in either order of the columns.
TEST(RecordingTimes, TwoColumnsAreOneTime) {
  Random random;
  for (int i = 0; i < testing::cases(900); ++i) {
    const TimePair& pair = pairs()[static_cast<std::size_t>(random.integer(0, 22))];
    const std::int64_t per_coarse = pair.fine / pair.coarse;
    const bool whole = random.integer(0, 1) == 0;
    std::int64_t ticks = random.integer(1, 5) * per_coarse + random.integer(1, 999);
    const std::size_t comma = pair.names.find(',');
    const bool reversed = random.integer(0, 1) == 0 && pair.names.front() != 't';
    Seconds expected;
    std::vector<std::string> rows;
    for (int row = 0; row < 5; ++row) {
      expected.push_back(static_cast<double>(ticks) / static_cast<double>(pair.fine));
      const std::string first =
          whole ? exact(static_cast<double>(ticks) / static_cast<double>(per_coarse))
                : std::to_string(ticks / per_coarse);
      const std::string second = std::to_string(whole ? ticks : ticks % per_coarse);
      rows.push_back(reversed ? second + "," + first : first + "," + second);
      ticks += random.integer(1, static_cast<int>(per_coarse));
    }
    const std::string names =
        reversed ? pair.names.substr(comma + 1) + "," + pair.names.substr(0, comma) : pair.names;
    ASSERT_EQ(timed(names, rows).trajectory.times, expected) << names << " " << rows.front();
  }
}

TEST(RecordingTimes, WholeSecondsBesideTheTimeInAFinerUnit) {
  EXPECT_EQ(timed("time_s,time_ms", {"0,500", "1,1500", "2,2000"}).trajectory.times,
            (Seconds{0.5, 1.5, 2}));
  EXPECT_EQ(timed("time_s,time_ms", {"0.123,123.5", "0.124,124.5"}).trajectory.times,
            (Seconds{0.1235, 0.1245}));
  const Recording since = timed("time_s,time_ns", {"1700000000.123,1700000000123456789",
                                                   "1700000000.123,1700000000123456790"});
  EXPECT_EQ(since.trajectory.times, (Seconds{0, 1e-9}));
  ASSERT_EQ(since.notes.size(), 1u);
  EXPECT_EQ(sentence(since.notes[0]),
            "a.csv: column time_ns has times since 1970 in ns, which count from the first sample");
  EXPECT_EQ(
      sentence(timed("sec,usec", {"1700000000,5"}).notes.at(0)),
      "a.csv: columns sec, usec have times since 1970 in s and us, which count from the first "
      "sample");
}

TEST(RecordingTimes, ColumnsThatAreNeitherAreRefused) {
  for (const auto& [first, second] : std::vector<std::pair<const char*, const char*>>{
           {"0.5,400000000", "must be whole seconds, as column time_ns has the nanoseconds"},
           {"1,3000000000", "must be below 1000000000, nanoseconds of a second"}}) {
    EXPECT_REFUSED(timed("time_s,time_ns", {first}), second);
  }
  EXPECT_REFUSED(timed("time_s,time_ns", {"1,5", "2.5,2500000000"}), "a.csv:3: column time_s: 2.5");
  EXPECT_REFUSED(timed("time_s,time_ns", {"1.5,1500000000", "2,5"}),
                 "a.csv:3: column time_s: 2 must be the same time as 5 in column time_ns");
  EXPECT_REFUSED(timed("sec,msec,usec", {"0,0,0"}),
                 "columns msec and usec both refine the times in column sec; keep one of them");
}

TEST(RecordingTimes, AnotherTimeOfTheRowIsNotRead) {
  EXPECT_EQ(timed("Time,header.stamp.sec,header.stamp.nanosec", {"0.5,3,999", "1.5,4,5"})
                .trajectory.times,
            (Seconds{0.5, 1.5}));
  EXPECT_EQ(timed("time,sec,nanosec", {"0.5,3,999", "1.5,4,5"}).trajectory.times,
            (Seconds{0.5, 1.5}));
}

/// `seconds` since 1970 as a date in this zone, of the C library.
std::string date_text(std::int64_t seconds, const std::string& fraction, const std::string& zone,
                      int minutes_east) {
  const auto shifted = static_cast<std::time_t>(seconds + 60 * minutes_east);
  std::tm parts{};
  gmtime_r(&shifted, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &parts);
  return text + fraction + zone;
}

TEST(RecordingTimes, DatesAreThoseOfTheCLibrary) {
  Random random;
  for (int i = 0; i < testing::cases(3000); ++i) {
    const std::int64_t seconds =
        4 * std::int64_t{random.integer(-2'000'000'000, 2'000'000'000)} / 4;
    const int digits = random.integer(0, 9);
    std::string fraction;
    std::int64_t nanoseconds = 0;
    for (int d = 0; d < 9; ++d) {
      const int digit = d < digits ? random.integer(0, 9) : 0;
      nanoseconds = 10 * nanoseconds + digit;
      if (d < digits) fraction += (d == 0 ? "." : "") + std::to_string(digit);
    }
    const std::pair<std::string, int> zones[] = {{"Z", 0},        {"", 0},      {"+02:00", 120},
                                                 {"-0330", -210}, {"+05", 300}, {" +00:00", 0}};
    const auto& [zone, minutes] = zones[random.integer(0, 5)];
    const std::string text = date_text(seconds, fraction, zone, minutes);
    const std::optional<internal::Date> found = internal::parse_date(text);
    ASSERT_TRUE(found) << text;
    ASSERT_EQ(found->nanoseconds, seconds * 1'000'000'000 + nanoseconds) << text;
    ASSERT_EQ(found->has_zone, !zone.empty()) << text;
  }
  EXPECT_EQ(internal::parse_date("1970-01-01 00:01")->nanoseconds, 60'000'000'000);
  for (const char* text : {"", "12", "1.5", "2024-05", "24-05-01T12:00", "2024/05/01 12:00:00"}) {
    EXPECT_FALSE(internal::parse_date(text)) << text;
  }
  for (const char* text :
       {"2024-13-01T12:00", "2023-02-29T12:00", "2024-05-01", "2024-05-01T24:00:00",
        "2024-05-01T12:00:00.", "2024-05-01T12:00:00Zx", "2024-05-01T12:00:00.1234567891Z",
        "1600-05-01T12:00:00Z", "2024-05-01T12"}) {
    EXPECT_REFUSED(internal::parse_date(text), "is not a date with a time");
  }
}

TEST(RecordingTimes, DatesCountFromTheFirstSample) {
  const Recording recording =
      timed("time", {"2024-05-01T12:00:00.123Z", "2024-05-01T14:00:00.123000001+02:00",
                     "\"2024-05-02 12:00:00,123Z\""});
  EXPECT_EQ(recording.trajectory.times, (Seconds{0, 1e-9, 86400}));
  for (const char* column : {"t", "Date", "datetime", "stamp", "time_from_start"}) {
    EXPECT_EQ(timed(column, {"2024-05-01T12:00:00Z", "2024-05-01T12:00:01Z"}).trajectory.times,
              (Seconds{0, 1}));
  }
  ASSERT_EQ(recording.notes.size(), 1u);
  EXPECT_EQ(sentence(recording.notes[0]),
            "a.csv: column time has dates; times count from the first sample");
  EXPECT_EQ(parse_recording("2024-05-01T12:00:00Z,0,0,0\n2024-05-01T12:00:01Z,0,0,0\n", "a.csv",
                            built_in("rrr"))
                .trajectory.times,
            (Seconds{0, 1}));
  EXPECT_REFUSED(timed("time", {"2024-05-01T12:00:00Z", "5"}),
                 "a.csv:3: column time has dates and numbers; write one of them throughout");
  EXPECT_REFUSED(timed("time", {"5", "2024-05-01T12:00:00Z"}),
                 "a.csv:3: column time has dates and numbers");
  EXPECT_REFUSED(timed("time", {"2024-05-01T12:00:00Z", "2024-05-01T12:00:01"}),
                 "a.csv:3: column time has dates with and without a zone");
  EXPECT_REFUSED(timed("time", {"2024-05-01T12:00:01Z", "2024-05-01T12:00:01Z"}),
                 "a.csv:3: column time: time 0 is not after 0");
  EXPECT_REFUSED(timed("time", {"2024-05-01T12:00:61Z"}),
                 "a.csv:2: column time: \"2024-05-01T12:00:61Z\" is not a date with a time");
  EXPECT_REFUSED(timed("time", {"2024-05-01T12:00:00Z"}, {.time_unit = TimeUnit::milliseconds}),
                 "column time has dates, which need no time unit (time_unit, --time-unit)");
  EXPECT_REFUSED(timed("time,nsec", {"2024-05-01T12:00:00Z,5"}),
                 "column time has dates, which column nsec cannot refine; remove that column");
}

/// Times that count days: a recording of a few samples a second would be one of more than 20 kHz.
TEST(RecordingTimes, DaysAreRefused) {
  Random random;
  for (int i = 0; i < 100; ++i) {
    const double days = random.integer(0, 1) ? random.uniform(15'001, 79'998)     // Excel
                                             : random.uniform(700'001, 779'998);  // MATLAB
    const double period = random.uniform(0.01, 4) / 86400;
    const std::vector<std::string> rows{exact(days), exact(days + period),
                                        exact(days + 2 * period)};
    EXPECT_REFUSED(timed("time", rows), "look like days, as Excel and MATLAB count them");
    EXPECT_EQ(timed("time", rows, {.time_unit = TimeUnit::seconds}).trajectory.times[0], days);
    EXPECT_EQ(timed("time_s", rows).trajectory.times[0], days);
    const std::vector<std::string> uptime{exact(days), exact(days + 0.01), exact(days + 0.02)};
    EXPECT_EQ(timed("time", uptime).trajectory.times[0], days);
  }
}

TEST(RecordingTimes, OtherDatesAreRefusedWithTheRightForm) {
  for (const char* text : {"01.05.2024 12:00:00", "05/01/2024", "12:00:00", "0 days 00:00:01"}) {
    EXPECT_REFUSED(timed("time", {text}), "is not a date with a time, such as 2024-05-01T12:00:00");
  }
}

}  // namespace
}  // namespace beeline
