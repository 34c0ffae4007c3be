#include <gtest/gtest.h>

#include <beeline/io/internal/trajectory_json.h>
#include <beeline/io/internal/trajectory_yaml.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/numbers.h>

#include <tests/io/random_trajectory.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline::internal {
namespace {

using testing::same;

Trajectory parse_yaml_text(const std::string& text) { return trajectory_from_yaml(text, "a.yaml"); }

/// The message in block style, as ROS prints it, with `front` before each line.
std::string block_style(const Trajectory& trajectory, const std::string& front = "") {
  std::string text = front + "header:\n" + front + "  stamp: {sec: 0, nanosec: 0}\n" + front +
                     "  frame_id: ''\n" + front + "joint_names:\n";
  for (const std::string& name : trajectory.joint_names) text += front + "- " + name + "\n";
  text += front + "points:\n";
  const auto column = [&](const std::string& key, const std::vector<Configuration>& values,
                          std::size_t k) {
    text += key + ":" + (values.empty() ? " []\n" : "\n");
    if (values.empty()) return;
    for (const double value : values[k]) text += front + "  - " + with_point(value) + "\n";
  };
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    const auto time = static_cast<std::int64_t>(std::llround(trajectory.times[k] * 1e9));
    column(front + "- positions", trajectory.positions, k);
    column(front + "  velocities", trajectory.velocities, k);
    column(front + "  accelerations", trajectory.accelerations, k);
    text += front + "  effort: []\n" + front + "  time_from_start:\n" + front +
            "    sec: " + std::to_string(time / 1'000'000'000) + "\n" + front +
            "    nanosec: " + std::to_string(time % 1'000'000'000) + "\n";
  }
  return text;
}

Trajectory random_message(testing::Random& random) {
  Trajectory trajectory = testing::random_trajectory(random);
  for (double& time : trajectory.times) time += 2;  // sec and nanosec have the same sign
  return testing::in_nanoseconds(trajectory);
}

TEST(TrajectoryYaml, MessagesOfEveryStyleReadBack) {
  testing::Random random;
  for (int i = 0; i < 100; ++i) {
    const Trajectory trajectory = random_message(random);
    const std::string block = block_style(trajectory), json = trajectory_to_json(trajectory);
    for (const std::string& text :
         {block, block + "---\n", "---\n" + block, "# a comment\n\n" + block,
          "trajectory:\n" + block_style(trajectory, "  "),
          "joint_trajectory:\n" + block_style(trajectory, "  ") +
              "multi_dof_joint_trajectory: {}\n",
          "model_id: a\ntrajectory:\n  - joint_trajectory:\n" + block_style(trajectory, "      ") +
              "trajectory_start: {}\n",
          json, "# a comment\n---\n" + json}) {
      ASSERT_TRUE(same(parse_yaml_text(text), trajectory)) << text;
    }
  }
}

TEST(TrajectoryYaml, BracesNeedNoQuotationMarks) {
  const Trajectory read = parse_yaml_text(
      "{joint_names: [a, b], points: [{positions: [1, +2.5], time_from_start: {secs: 1, nsecs: "
      "500000000}}]}");
  EXPECT_EQ(read.times, (std::vector<double>{1.5}));
  EXPECT_EQ(read.positions[0], Eigen::Vector2d(1, 2.5));
}

/// More than the 4 MiB of other styles.
TEST(TrajectoryYaml, ATextInBracesIsOfAnyLength) {
  const testing::TemporaryFolder folder;
  const std::string blanks(400, ' ');
  const int samples = testing::example_size(15'000);
  std::string text = "# comment\n{\"joint_names\": [\"a\"], \"points\": [";
  for (int k = 0; k < samples; ++k) {
    text += (k == 0 ? "" : ",\n") + blanks +
            "{\"positions\": [0.25], \"time_from_start\": {\"sec\": " + std::to_string(k) +
            ", \"nanosec\": 5}}";
  }
  write_file(folder.file("a.yaml"), text + "]}");
  InputFile file(folder.file("a.yaml"));
  EXPECT_EQ(trajectory_from_yaml(file).size(), samples);
  if (!testing::slow_build) {
    const std::string long_block = "joint_names: [a]\npoints: []\n#" + std::string(5 << 20, ' ');
    EXPECT_REFUSED(parse_yaml_text(long_block + "x"), "a.yaml: is larger than 4 MiB");
  }
}

TEST(TrajectoryYaml, MistakesAreNamed) {
  EXPECT_REFUSED(parse_yaml_text(""), "a.yaml");
  EXPECT_REFUSED(parse_yaml_text("- 1\n- 2\n"),
                 "a.yaml:1: is no map with the keys joint_names and");
  EXPECT_REFUSED(parse_yaml_text("joint_names: [a]\n"), "needs the key \"points\"");
  EXPECT_REFUSED(parse_yaml_text("points: []\n"), "needs the key \"joint_names\"");
  EXPECT_REFUSED(parse_yaml_text("joint_names: [a]\npoints:\n- positions: [1]\n"),
                 "a.yaml:3: points[0] needs the key \"time_from_start\"");
  const std::string time = "  time_from_start: {sec: 0, nanosec: 0}\n";
  EXPECT_REFUSED(parse_yaml_text("joint_names: [a]\npoints:\n- positions: ['1']\n" + time),
                 "a.yaml:3: points[0].positions[0] must be a number, not text");
  EXPECT_REFUSED(parse_yaml_text("joint_names: [a]\npoints:\n- positions: [.nan]\n" + time),
                 "must be a number");
  EXPECT_REFUSED(parse_yaml_text("joint_names: [a]\npoints:\n- positions: [1]\n" + time +
                                 "- positions: [1]\n" + time),
                 "a.yaml:5: points[1] is at time 0, not after 0");
  EXPECT_REFUSED(parse_yaml_text("a: [1\nb: 2\n"), "is not YAML");
  EXPECT_REFUSED(parse_yaml_text("{\"joint_names\": [\"a\"], \"points\": [}"), "a.yaml:1: is not");
}

TEST(TrajectoryYaml, BrokenTextsAreReadOrRefused) {
  testing::Random random;
  for (int i = 0; i < 10; ++i) {
    const std::string whole = block_style(random_message(random));
    int refused = 0;
    for (int k = 0; k < 60; ++k) {
      std::string text = whole;
      const auto place = [&] {
        return static_cast<std::size_t>(random.integer(0, static_cast<int>(text.size()) - 1));
      };
      text[place()] = static_cast<char>(random.integer(0, 255));
      text.erase(place(), static_cast<std::size_t>(random.integer(0, 30)));
      const std::string said = testing::refusal([&] { (void)parse_yaml_text(text); });
      EXPECT_EQ(said.find('\n'), std::string::npos) << said;
      refused += said != "accepted";
    }
    EXPECT_GT(refused, 0);
  }
}

}  // namespace
}  // namespace beeline::internal
