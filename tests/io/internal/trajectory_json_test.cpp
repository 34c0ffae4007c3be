#include <gtest/gtest.h>

#include <beeline/io/internal/trajectory_json.h>

#include <tests/io/random_trajectory.h>
#include <tests/refusal.h>

namespace beeline::internal {
namespace {

using testing::in_nanoseconds;
using testing::random_trajectory;
using testing::same;

Trajectory parse_json(const std::string& text) { return trajectory_from_json(text, "a.json"); }

std::string points(const std::string& list) {
  return "{\"joint_names\": [\"a\", \"b\"],\n\"points\": [" + list + "]}";
}

/// Times of whole nanoseconds are read as they were written, others to half a nanosecond.
TEST(TrajectoryJson, AnyTrajectoryOfWholeNanosecondsReadsBackToTheLastBit) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    const Trajectory any = random_trajectory(random), trajectory = in_nanoseconds(any);
    ASSERT_TRUE(same(parse_json(trajectory_to_json(any)), trajectory)) << i;
    ASSERT_TRUE(same(parse_json(trajectory_to_json(trajectory)), trajectory)) << i;
    for (std::size_t k = 0; k < any.size(); ++k) {
      EXPECT_NEAR(trajectory.times[k], any.times[k], 0.51e-9);
    }
  }
  const Trajectory odd =
      in_nanoseconds(random_trajectory(random, {"t", "a", "a_vel", "say \"x\"\\", "gr\xc3\xbc"}));
  EXPECT_TRUE(same(parse_json(trajectory_to_json(odd)), odd));
}

/// A strict converter takes the message as published: all members of each type and no other.
TEST(TrajectoryJson, TheTextIsTheMessage) {
  Trajectory trajectory{{"a"}, {0, 1e-7}, {}, {}, {}};
  trajectory.positions = {Configuration::Constant(1, 1e-7), Configuration::Constant(1, 2)};
  trajectory.velocities.assign(2, Configuration::Constant(1, -1e20));
  EXPECT_EQ(trajectory_to_json(trajectory),
            R"({"header": {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": ""},
 "joint_names": ["a"],
 "points": [
  {"positions": [1.0e-07], "velocities": [-1.0e+20], "accelerations": [], "effort": [], )"
            R"("time_from_start": {"sec": 0, "nanosec": 0}},
  {"positions": [2.0], "velocities": [-1.0e+20], "accelerations": [], "effort": [], )"
            R"("time_from_start": {"sec": 0, "nanosec": 100}}
 ]}
)");
}

TEST(TrajectoryJson, DurationsAreWholeNumbersWithinTheirRange) {
  Trajectory trajectory;
  trajectory.joint_names = {"a"};
  trajectory.times = {-0.25, 0, 0.9999999999, 2.5};
  trajectory.positions.assign(4, Configuration::Zero(1));
  const std::string text = trajectory_to_json(trajectory);
  for (const char* duration :
       {"{\"sec\": -1, \"nanosec\": 750000000}", "{\"sec\": 0, \"nanosec\": 0}",
        "{\"sec\": 1, \"nanosec\": 0}", "{\"sec\": 2, \"nanosec\": 500000000}"}) {
    EXPECT_NE(text.find(duration), std::string::npos) << duration << " in " << text;
  }
  for (const double far : {3e9, 1e300}) {
    trajectory.times.back() = far;
    EXPECT_REFUSED(trajectory_to_json(trajectory), "exceeds the 32 bits of ROS's seconds");
  }
  trajectory.times.back() = 1;
  EXPECT_REFUSED(trajectory_to_json(trajectory),
                 "samples 3 and 4 are at the same nanosecond, 1 s; ROS's times are whole");
}

/// Version 0.1 wrote the exact time beside the rounded one.
TEST(TrajectoryJson, FilesWithExactTimesAreRead) {
  const Trajectory trajectory = parse_json(points(
      R"({"positions": [1, 2], "time_from_start": {"sec": 0, "nanosec": 333333333}, "time": 0.3333333333333333},
         {"positions": [1, 2], "time": 1})"));
  EXPECT_EQ(trajectory.times, (std::vector<double>{0.3333333333333333, 1}));
}

TEST(TrajectoryJson, MembersMayBeInAnyOrder) {
  const auto parse = [](const std::string& names) {
    return parse_json(
        "{\"points\": [{\"time\": 0, \"positions\": [1, 2]},\n"
        "{\"positions\": [3, 4], \"time\": 1}],\n\"joint_names\": " +
        names + "}");
  };
  const Trajectory trajectory = parse(R"(["a", "b"])");
  EXPECT_EQ(trajectory.positions[1], Eigen::Vector2d(3, 4));
  EXPECT_REFUSED(parse(R"(["a"])"),
                 "a.json:3: joint_names has 1 names; the points have 2 positions");
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
