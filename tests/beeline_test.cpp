#include <gtest/gtest.h>
#include <sstream>

#include <beeline/beeline.h>

namespace {

using beeline::operator<<;  // for poses, which are Eigen's type

template <class T>
std::string printed(const T& value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

TEST(Umbrella, IsAllThatAFirstProgramIncludes) {
  const beeline::Arm arm = beeline::built_in("panda");
  const beeline::Pose pose = beeline::forward_kinematics(arm, {0, -0.8, 0, -2.4, 0, 1.6, 0.8});
  EXPECT_EQ(printed(pose).substr(0, 2), "x ");
  EXPECT_EQ(beeline::jacobian(arm, std::vector<double>(7, -0.1)).cols(), 7);
  const beeline::InverseResult answer = beeline::inverse_kinematics(arm, pose);
  EXPECT_EQ(printed(answer.status), "solved");
  EXPECT_EQ(printed(answer).substr(0, 8), "solved, ");
  beeline::InverseResult none = beeline::inverse_kinematics(arm, beeline::make_pose({9, 0, 0}));
  beeline::explain(none);
  EXPECT_EQ(printed(none), "unreachable: " + sentence(none.reason));
}

}  // namespace
