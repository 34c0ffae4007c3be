#include <gtest/gtest.h>

#include <beeline/io/text/internal/json_write.h>
#include <beeline/io/text/internal/pose_json.h>
#include <beeline/pose/se3.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline::internal {
namespace {

Pose parse_pose(const std::string& text) {
  const JsonDocument document(text, "a.json");
  return pose_from_json(document, document.root());
}

TEST(PoseJson, AnyPoseReadsBackExactly) {
  testing::Random random;
  for (int i = 0; i < 5000; ++i) {
    const Pose pose = random.pose(random.uniform(0, 10));
    ASSERT_EQ(parse_pose(pose_to_json(pose)).matrix(), pose.matrix());
  }
}

TEST(PoseJson, TypedAnglesAreWrittenAsTyped) {
  const auto rewritten = [](const std::string& text) { return pose_to_json(parse_pose(text)); };
  for (const char* text : {"{\"xyz\": [0, 0, 0]}", "{\"xyz\": [0.1, -2.5, 1e-07]}",
                           "{\"xyz\": [0, 0, 0.333], \"rpy\": [1.5708, 0, 0]}",
                           "{\"xyz\": [0, 0, 0], \"rpy\": [0, 0, -0.7853]}",
                           "{\"xyz\": [0, 0, 0], \"rpy\": [0, 0, 1.570796326795]}"}) {
    EXPECT_EQ(rewritten(text), text);
  }
}

TEST(PoseJson, AllFormsGiveTheSamePose) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    const Pose pose = random.pose();
    const Quaternion u = quaternion(pose.linear());
    const RollPitchYaw angles = roll_pitch_yaw(pose.linear());
    const double rpy[] = {angles.roll, angles.pitch, angles.yaw};
    const std::string xyz = "{\"xyz\": " + json_numbers(pose.translation().data(), 3);
    const auto field = [](const char* key, double value) {
      return "\"" + std::string(key) + "\": " + std::to_string(value);
    };
    EXPECT_TRUE(parse_pose(xyz + ", \"rpy\": " + json_numbers(rpy, 3) + "}").isApprox(pose, 1e-14));
    EXPECT_TRUE(parse_pose(xyz + ", \"quaternion\": {" + field("qw", u.qw) + "," +
                           field("qx", u.qx) + "," + field("qy", u.qy) + "," + field("qz", u.qz) +
                           "}}")
                    .isApprox(pose, 1e-5));
  }
  EXPECT_EQ(parse_pose("{}").matrix(), Pose::Identity().matrix());
  EXPECT_EQ(parse_pose("{\"matrix\": [[0,-1,0,1],[1,0,0,2],[0,0,1,3],[0,0,0,1]]}").translation(),
            Vector3(1, 2, 3));
}

TEST(PoseJson, MistakesAreNamed) {
  EXPECT_REFUSED(parse_pose("{\"xyz\": [1, 2]}"), "xyz must be a list of 3 numbers; it has 2");
  EXPECT_REFUSED(parse_pose("{\"xyz\": [1, 2, \"3\"]}"), "xyz[2] must be a number, not text");
  EXPECT_REFUSED(parse_pose("{\"xzy\": [1, 2, 3]}"), "unknown key \"xzy\"; did you mean \"xyz\"?");
  EXPECT_REFUSED(parse_pose("{\"rpy\": [0,0,0], \"quaternion\": {}}"),
                 "has both rpy and quaternion");
  EXPECT_REFUSED(parse_pose("{\"matrix\": [], \"xyz\": [0,0,0]}"), "a matrix must be the only key");
  EXPECT_REFUSED(parse_pose("{\"matrix\": [[1,0,0,0]]}"), "matrix must be four rows");
  EXPECT_REFUSED(parse_pose("{\"matrix\": [[1,0,0,0],[0,1,0,0],[0,0,1],[0,0,0,1]]}"),
                 "matrix[2] must be a list of 4 numbers");
  EXPECT_REFUSED(parse_pose("{\"matrix\": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,0]]}"),
                 "its last row must be 0 0 0 1");
  EXPECT_REFUSED(parse_pose("{\"matrix\": [[1,0,0,0],[0,1,0,0],[0,0,-1,0],[0,0,0,1]]}"),
                 "matrix is not a rigid motion");
  EXPECT_REFUSED(parse_pose("{\"matrix\": [[2,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}"),
                 "matrix is not a rigid motion");
  EXPECT_REFUSED(parse_pose("{\"quaternion\": [1,0,0,0]}"),
                 "quaternion must be an object, not a list");
  EXPECT_REFUSED(parse_pose("{\"quaternion\": {\"qw\": 1}}"), "quaternion needs the key \"qx\"");
  EXPECT_REFUSED(parse_pose("{\"quaternion\": {\"qw\": 1, \"qx\": 1, \"qy\": 0, \"qz\": 0}}"),
                 "has length 1.41421; it must be 1");
}

}  // namespace
}  // namespace beeline::internal
