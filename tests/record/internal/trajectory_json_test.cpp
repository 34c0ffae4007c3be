#include <gtest/gtest.h>

#include <beeline/record/internal/trajectory_json.h>

#include <tests/record/random_trajectory.h>
#include <tests/refusal.h>

namespace beeline::internal {
namespace {

using testing::random_trajectory;
using testing::same;

Trajectory parse_json(const std::string& text) { return trajectory_from_json(text, "a.json"); }

std::string points(const std::string& list) {
  return "{\"joint_names\": [\"a\", \"b\"],\n\"points\": [" + list + "]}";
}

TEST(TrajectoryJson, AnyTrajectoryReadsBackToTheLastBit) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    const Trajectory trajectory = random_trajectory(random);
    ASSERT_TRUE(same(parse_json(trajectory_to_json(trajectory)), trajectory)) << i;
  }
  const Trajectory odd =
      random_trajectory(random, {"t", "a", "a_vel", "say \"x\"\\", "gr\xc3\xbc"});
  EXPECT_TRUE(same(parse_json(trajectory_to_json(odd)), odd));
}

/// A ROS reader uses time_from_start only, which is accurate to half a nanosecond.
TEST(TrajectoryJson, TheDurationIsTheTimeToANanosecond) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    const Trajectory trajectory = random_trajectory(random);
    std::string text = trajectory_to_json(trajectory);
    for (std::size_t at; (at = text.find(", \"time\": ")) != std::string::npos;) {
      text.erase(at, text.find('}', at) - at);
    }
    const Trajectory read = parse_json(text);
    ASSERT_EQ(read.size(), trajectory.size());
    for (std::size_t k = 0; k < read.size(); ++k) {
      EXPECT_NEAR(read.times[k], trajectory.times[k], 0.51e-9);
    }
    EXPECT_EQ(read.positions, trajectory.positions);
  }
}

TEST(TrajectoryJson, DurationsAreWholeNumbersWithinTheirRange) {
  Trajectory trajectory;
  trajectory.joint_names = {"a"};
  trajectory.times = {-0.25, 0, 0.9999999999, 2.5};
  trajectory.positions.assign(4, Configuration::Zero(1));
  const std::string text = trajectory_to_json(trajectory);
  for (const char* duration :
       {"{\"sec\": -1, \"nanosec\": 750000000}", "{\"sec\": 0, \"nanosec\": 0}",
        "{\"sec\": 1, \"nanosec\": 0}, \"time\": 0.9999999999",
        "{\"sec\": 2, \"nanosec\": 500000000}"}) {
    EXPECT_NE(text.find(duration), std::string::npos) << duration << " in " << text;
  }
  for (const double far : {3e9, 1e300}) {
    trajectory.times.back() = far;
    EXPECT_REFUSED(trajectory_to_json(trajectory), "exceeds the 32 bits of ROS's seconds");
  }
}

TEST(TrajectoryJson, RosMessagesAreUnderstood) {
  const Trajectory trajectory = parse_json(R"({
    "header": {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": "base"},
    "joint_names": ["a", "b"],
    "points": [
      {"positions": [1, 2], "velocities": [3, 4], "accelerations": [], "effort": [],
       "time_from_start": {"sec": 0, "nanosec": 0}},
      {"positions": [5, 6], "velocities": [7, 8], "accelerations": [], "effort": [],
       "time_from_start": {"sec": 1, "nanosec": 500000000}}]})");
  EXPECT_EQ(trajectory.times, (std::vector<double>{0, 1.5}));
  EXPECT_EQ(trajectory.velocities[1], Eigen::Vector2d(7, 8));
  EXPECT_TRUE(trajectory.accelerations.empty());
}

TEST(TrajectoryJson, MistakesAreNamed) {
  EXPECT_REFUSED(parse_json(points("")), "a.json: the trajectory has no samples");
  EXPECT_REFUSED(parse_json("{\"points\": []}"), "the document needs the key \"joint_names\"");
  EXPECT_REFUSED(parse_json("{\"joint_names\": [\"a\"]}"), "needs the key \"points\"");
  EXPECT_REFUSED(parse_json("{\"joint_names\": [1], \"points\": []}"),
                 "joint_names[0] must be text");
  EXPECT_REFUSED(parse_json("{\"joint_names\": [\"a\", \"a\"], \"points\": []}"), "a.json: ");
  EXPECT_REFUSED(parse_json(points(R"({"positions": [1], "time": 0})")),
                 "a.json:2: points[0].positions must be a list of 2 numbers; it has 1");
  EXPECT_REFUSED(parse_json(points(R"({"time": 0})")), "points[0] needs the key \"positions\"");
  EXPECT_REFUSED(parse_json(points(R"({"positions": [1, 2]})")),
                 "points[0] needs the key \"time_from_start\"");
  EXPECT_REFUSED(parse_json(points(R"({"positions": [1, 2], "time": 0, "velocity": [1, 2]})")),
                 "points[0]: unknown key \"velocity\"; did you mean \"velocities\"?");
  EXPECT_REFUSED(
      parse_json(points(R"({"positions": [1, 2], "time": 0}, {"positions": [1, 2], "time": 0})")),
      "points[1] is at time 0, not after 0; times must increase");
  EXPECT_REFUSED(parse_json(points(R"({"positions": [1, 2], "time": 0},
                                 {"positions": [1, 2], "time": 1, "velocities": [1, 2]})")),
                 "a.json:3: points[1] has velocities, unlike the points before it");
  EXPECT_REFUSED(parse_json(points(R"({"positions": [1, 2], "time": 0, "accelerations": [1, 2]},
                                 {"positions": [1, 2], "time": 1})")),
                 "points[1] has no accelerations, unlike the points before it");
  EXPECT_REFUSED(parse_json(points(R"({"positions": [1, 2], "time_from_start": {"sec": 1}})")),
                 "points[0].time_from_start needs the key \"nanosec\"");
  EXPECT_REFUSED(
      parse_json(points(R"({"positions": [1, 2], "time_from_start": {"sec": 1, "nanosec": 1e9}})")),
      "points[0].time_from_start.nanosec must be at least 0 and below 1e9");
  EXPECT_REFUSED(parse_json("{\n\"joint_names\": ["), "a.json:2: is not JSON");
}

}  // namespace
}  // namespace beeline::internal
