#include <gtest/gtest.h>

#include <beeline/io/internal/trajectory_csv.h>
#include <beeline/io/internal/trajectory_json.h>
#include <beeline/io/text/file.h>
#include <beeline/io/trajectory_file.h>

#include <tests/io/random_trajectory.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline {
namespace {

TEST(TrajectoryFile, TheEndingGivesTheFormat) {
  testing::Random random;
  const testing::TemporaryFolder folder;
  for (const char* name : {"a.csv", "a.json", "b.CSV"}) {
    const Trajectory trajectory = testing::in_nanoseconds(testing::random_trajectory(random));
    write_trajectory(folder.file(name), trajectory);
    EXPECT_TRUE(testing::same(read_trajectory(folder.file(name)), trajectory)) << name;
  }
  EXPECT_EQ(folder.content("a.csv").substr(0, 2), "t,");
  EXPECT_EQ(folder.content("a.json").front(), '{');
  EXPECT_EQ(folder.count(), 3u);
}

TEST(TrajectoryFile, PlansOfMoveItHoldATrajectory) {
  testing::Random random;
  const Trajectory trajectory = testing::in_nanoseconds(testing::random_trajectory(random));
  const std::string message = internal::trajectory_to_json(trajectory);
  for (const auto& [before, after] : std::vector<std::pair<std::string, std::string>>{
           {R"({"joint_trajectory": )", R"(, "multi_dof_joint_trajectory": {"points": []}})"},
           {R"({"trajectory": )", "}"},
           {R"({"model_id": "a", "trajectory": [{"joint_trajectory": )", "}]}"}}) {
    const std::string text = before + message + after;
    EXPECT_TRUE(testing::same(internal::trajectory_from_json(text, "a.json"), trajectory)) << text;
  }
  EXPECT_REFUSED(internal::trajectory_from_json(R"({"joint_trajectory": {}})", "a.json"),
                 "joint_names");
  EXPECT_REFUSED(internal::trajectory_from_json(R"({"trajectory": [1, 2]})", "a.json"),
                 "a.json:1: has 2 trajectories; a file has one");
  EXPECT_REFUSED(internal::trajectory_from_json(
                     R"({"joint_trajectory": {"joint_names": ["a"], "points": [{}]}})", "a.json"),
                 "points[0]");
}

TEST(TrajectoryFile, OtherFormatsAreRefused) {
  testing::Random random;
  const testing::TemporaryFolder folder;
  const Trajectory trajectory = testing::random_trajectory(random);
  for (const char* name : {"a.txt", "a", "a.csv.bak"}) {
    const std::string path = folder.file(name);
    const std::string said = ".csv, .json or .yaml files, not \"" + path;
    EXPECT_REFUSED(trajectory_format(path), said);
    EXPECT_REFUSED(write_trajectory(path, trajectory), said);
    if (name == std::string("a.csv.bak")) {
      EXPECT_REFUSED(read_trajectory(path),
                     "is not a known kind of trajectory file; known are .csv, .json, .yaml");
    }
  }
  EXPECT_EQ(folder.count(), 0u);
}

TEST(TrajectoryFile, WithoutAnEndingTheTextDecides) {
  testing::Random random;
  const testing::TemporaryFolder folder;
  const Trajectory trajectory = testing::in_nanoseconds(testing::random_trajectory(random));
  for (const TrajectoryFormat format : {TrajectoryFormat::csv, TrajectoryFormat::json}) {
    write_file(folder.file("pipe"), trajectory_text(trajectory, format));
    EXPECT_TRUE(testing::same(read_trajectory(folder.file("pipe")), trajectory));
  }
}

/// More than the 64 MiB that are read as a whole, and than the 8 million values of a JSON document
/// (not under a sanitizer).
TEST(TrajectoryFile, AnyLengthIsRead) {
  const testing::TemporaryFolder folder;
  const int samples = testing::slow_build ? 14'000 : 1'400'000;
  std::string csv = "t,a\n", json = "{\"joint_names\": [\"a\"], \"points\": [";
  const std::string blanks(40, ' ');
  for (int k = 0; k < samples; ++k) {
    const std::string time = std::to_string(k);
    csv += blanks + time + ",0.25\n";
    json += (k == 0 ? "" : ",\n") +
            ("{\"positions\": [0.25], \"time_from_start\": {\"sec\": " + time) +
            ", \"nanosec\": 5}}";
  }
  EXPECT_GT(csv.size(), max_file_size / 1'400'000 * static_cast<std::size_t>(samples));
  write_file(folder.file("a.csv"), csv);
  write_file(folder.file("a.json"), json + "]}");
  for (const char* name : {"a.csv", "a.json"}) {
    const Trajectory trajectory = read_trajectory(folder.file(name));
    EXPECT_EQ(trajectory.size(), samples) << name;
    EXPECT_NEAR(trajectory.times.back(), samples - 1, 1e-8);
    EXPECT_EQ(trajectory.positions.back()[0], 0.25);
  }
  write_file(folder.file("a.json"), json + "x");
  EXPECT_REFUSED(read_trajectory(folder.file("a.json")),
                 "a.json:" + std::to_string(samples) + ": is not JSON");
}

TEST(TrajectoryFile, ManyJointsAreRefusedAtOnce) {
  std::string names, values;
  for (int i = 0; i < 50'000; ++i) {
    names += (i == 0 ? "\"j" : "\",\"j") + std::to_string(i);
    values += i == 0 ? "0" : ",0";
  }
  EXPECT_REFUSED(
      parse_trajectory("{\"joint_names\": [" + names + "\"], \"points\": [{\"positions\": [" +
                           values + "], \"time\": 0}]}",
                       "a.json"),
      "a.json: the trajectory has 50000 joints; at most 10000 are accepted");
}

TEST(TrajectoryFile, EndlessFilesAreRefused) {
  EXPECT_REFUSED(read_trajectory("/dev/zero"), "/dev/zero:1: has a byte of 0");
  const testing::TemporaryFolder folder;
  write_file(folder.file("a.csv"), std::string(5 << 20, '1'));
  EXPECT_REFUSED(read_trajectory(folder.file("a.csv")), "line 1 is longer than");
}

TEST(TrajectoryFile, NothingHalfMadeIsLeft) {
  testing::Random random;
  const testing::TemporaryFolder folder;
  const Trajectory bad = testing::random_trajectory(random, {"a", "a_vel"});
  EXPECT_REFUSED(write_trajectory(folder.file("a.csv"), bad), "write .json instead");
  EXPECT_REFUSED(write_trajectory(folder.file("none/a.csv"), testing::random_trajectory(random)),
                 "none/a.csv: cannot be written");
  EXPECT_REFUSED(read_trajectory(folder.file("a.csv")), "a.csv: cannot be read");
  EXPECT_EQ(folder.count(), 0u);
}

TEST(TrajectoryFile, BrokenTextsAreReadOrRefused) {
  testing::Random random;
  for (int i = 0; i < testing::cases(120); ++i) {
    const Trajectory trajectory = testing::random_trajectory(random);
    for (const bool csv : {true, false}) {
      const std::string whole =
          csv ? internal::trajectory_to_csv(trajectory) : internal::trajectory_to_json(trajectory);
      const auto read = [csv](const std::string& text) {
        return testing::refusal([&] {
          (void)(csv ? internal::trajectory_from_csv(text, "a")
                     : internal::trajectory_from_json(text, "a"));
        });
      };
      const auto place = [&] { return random.integer(0, static_cast<int>(whole.size()) - 1); };
      int refused = 0;
      for (int k = 0; k < 200; ++k) {
        std::string text = whole;
        text[place()] = static_cast<char>(random.integer(0, 255));
        text.erase(static_cast<std::size_t>(place()),
                   static_cast<std::size_t>(random.integer(0, 9)));
        const std::string said = read(text);
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
        refused += said != "accepted";
      }
      EXPECT_GT(refused, 0);
      for (int k = 0; k < 50; ++k) {
        const auto length = static_cast<std::size_t>(place());
        const std::string said = read(whole.substr(0, length));
        EXPECT_TRUE(csv || length + 2 >= whole.size() || said != "accepted") << length;
      }
    }
  }
}

}  // namespace
}  // namespace beeline
