#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>

#include <beeline/io/internal/joint_states.h>
#include <beeline/io/text/numbers.h>
#include <beeline/model/catalog.h>

#include <tests/random.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline::internal {
namespace {

std::string yaml_list(const std::vector<std::string>& items, bool block) {
  std::string text = block ? "\n" : " [";
  for (std::size_t i = 0; i < items.size(); ++i) {
    text += block ? "- " + items[i] + "\n" : (i == 0 ? "" : ", ") + items[i];
  }
  return block ? text : text + "]\n";
}

/// A message as `ros2 topic echo` or, of ROS 1, `rostopic echo` prints it.
std::string state_message(std::int64_t nanoseconds, const std::vector<std::string>& names,
                          const std::vector<std::string>& position,
                          const std::vector<std::string>& velocity, bool block = true,
                          bool ros_1 = false) {
  const std::string sec = std::to_string(nanoseconds / 1'000'000'000);
  const std::string nsec = std::to_string(nanoseconds % 1'000'000'000);
  return "header:" + std::string(ros_1 ? "\n  seq: 7" : "") + "\n  stamp:\n    " +
         (ros_1 ? "secs: " : "sec: ") + sec + "\n    " + (ros_1 ? "nsecs: " : "nanosec: ") + nsec +
         "\n  frame_id: ''\nname:" + yaml_list(names, block) +
         "position:" + yaml_list(position, block) +
         "velocity:" + (velocity.empty() ? " []\n" : yaml_list(velocity, block)) + "effort: []\n";
}

const std::vector<std::string> state_joints{"joint1", "joint2", "joint3"};

Recording states_of(const std::string& text) { return recording_from_joint_states(text, "a.yaml"); }

/// Messages of any form, whose state_joints are in any order, are the samples that they were made
/// of.
TEST(JointStates, MessagesAreSamples) {
  testing::Random random;
  const testing::TemporaryFolder folder;
  for (int i = 0; i < testing::cases(60); ++i) {
    const bool ros_1 = random.integer(0, 1) == 0, velocities = random.integer(0, 1) == 0;
    const bool since_1970 = random.integer(0, 1) == 0, last = random.integer(0, 1) == 0;
    std::int64_t time = since_1970 ? 1'700'000'000'123'456'789 : 1'999'999'000;
    const std::int64_t first = since_1970 ? time : 0;
    std::string text = random.integer(0, 1) == 0 ? "" : "---\n";
    Trajectory expected{state_joints, {}, {}, {}, {}};
    const int count = random.integer(1, 6);
    for (int k = 0; k < count; ++k) {
      Vector3 q, v;
      std::vector<int> order(3);
      std::iota(order.begin(), order.end(), 0);
      if (k > 0) std::rotate(order.begin(), order.begin() + random.integer(0, 2), order.end());
      std::vector<std::string> names, position, velocity;
      for (const int j : order) {
        q[j] = random.uniform(-3, 3);
        v[j] = random.uniform(-3, 3);
        names.push_back(state_joints[static_cast<std::size_t>(j)]);
        position.push_back(exact(q[j]));
        if (velocities) velocity.push_back(exact(v[j]));
      }
      expected.times.push_back(static_cast<double>(time - first) / 1e9);
      expected.positions.emplace_back(q);
      if (velocities) expected.velocities.emplace_back(v);
      text += state_message(time, names, position, velocity, random.integer(0, 1) == 0, ros_1) +
              (k + 1 == count && last ? "" : "---\n");
      time += random.integer(1, 2'000'000'000);
    }
    if (random.integer(0, 1) == 0) {
      std::string dos;
      for (const char c : text) dos += c == '\n' ? "\r\n" : std::string(1, c);
      text = dos;
    }
    for (const char* name : {"a.yaml", "a.log", "a"}) {
      const Recording found = read_recording(folder.write(name, text), built_in("rrr"));
      ASSERT_EQ(found.trajectory.times, expected.times) << text;
      ASSERT_EQ(found.trajectory.positions, expected.positions) << text;
      ASSERT_EQ(found.trajectory.velocities, expected.velocities) << text;
      ASSERT_EQ(found.notes.size(), since_1970 ? 1u : 0u);
    }
    ASSERT_EQ(parse_recording(text, "a.yaml", built_in("rrr")).trajectory.times, expected.times);
  }
}

TEST(JointStates, VelocitiesOfSomeMessagesAreNotRead) {
  const std::vector<std::string> zero{"0", "0", "0"}, nan{".nan", ".nan", ".nan"};
  const std::string with = state_message(0, state_joints, zero, zero) + "---\n";
  EXPECT_EQ(states_of(with).trajectory.velocities.size(), 1u);
  EXPECT_TRUE(
      states_of(with + state_message(5, state_joints, zero, nan)).trajectory.velocities.empty());
  EXPECT_TRUE(states_of(with + state_message(5, state_joints, zero, {}) + "---\n" +
                        state_message(6, state_joints, zero, zero))
                  .trajectory.velocities.empty());
}

TEST(JointStates, MistakesAreNamedWithTheirLines) {
  const std::vector<std::string> zero{"0", "0", "0"};
  const std::string first = state_message(0, state_joints, zero, {}, false) + "---\n";  // 10 lines
  EXPECT_REFUSED(states_of(first + state_message(0, state_joints, zero, {})),
                 "a.yaml:11: the document is at time 0, not after 0; times must increase");
  EXPECT_REFUSED(states_of(first + state_message(5, {"joint1", "joint2", "hand"}, zero, {}, false)),
                 "a.yaml:16: name must have the joints of the first message, joint1, joint2, "
                 "joint3, not joint1, joint2, hand; keep the messages of one publisher alone");
  EXPECT_REFUSED(states_of(first + state_message(5, {"joint1", "joint2"}, {"0", "0"}, {}, false)),
                 "must have the joints of the first message");
  EXPECT_REFUSED(states_of(first + state_message(5, state_joints, {"0", "0"}, {}, false)),
                 "a.yaml:17: position must be a list of 3 numbers; it has 2");
  EXPECT_REFUSED(states_of(first + state_message(5, state_joints, {"0", "x", "0"}, {}, false)),
                 "a.yaml:17: position");
  EXPECT_REFUSED(states_of(first + "points: []\n"), "unknown key \"points\"");
  EXPECT_REFUSED(states_of(first + "name: [\n"), "is not YAML");
  EXPECT_REFUSED(states_of("---\n"), "a.yaml: has no messages");
  EXPECT_REFUSED(states_of("name: [a]\nposition: [" + std::string(2'000'000, ' ') + "0]\n"),
                 "a message is longer than 1 MiB");
  const std::string trajectory = "joint_names: [a]\npoints: []\n---\n";
  EXPECT_REFUSED(parse_trajectory(trajectory + trajectory, "a.yaml"),
                 "a.yaml:4: has a second message; a file has one JointTrajectory, or many "
                 "JointState");
}

}  // namespace
}  // namespace beeline::internal
