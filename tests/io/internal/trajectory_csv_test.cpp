#include <gtest/gtest.h>

#include <beeline/io/internal/trajectory_csv.h>

#include <tests/io/random_trajectory.h>
#include <tests/refusal.h>

namespace beeline::internal {
namespace {

using testing::random_trajectory;
using testing::same;

Trajectory parse(const std::string& text) { return trajectory_from_csv(text, "a.csv"); }

TEST(TrajectoryCsv, AnyTrajectoryReadsBackToTheLastBit) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    const Trajectory trajectory = random_trajectory(random);
    ASSERT_TRUE(same(parse(trajectory_to_csv(trajectory)), trajectory)) << i;
  }
}

TEST(TrajectoryCsv, OddNamesReadBack) {
  testing::Random random;
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"a,b", "say \"x\"", " c ", "#d"},
        {"t_vel", "T", "_vel", "_acc"},
        {"x_vel", "y_acc"},
        {"1", "2"},
        {"vel", "acc"}}) {
    for (int i = 0; i < 20; ++i) {
      const Trajectory trajectory = random_trajectory(random, names);
      ASSERT_TRUE(same(parse(trajectory_to_csv(trajectory)), trajectory)) << names[0];
    }
  }
}

TEST(TrajectoryCsv, NamesThatWouldBeReadAsAnotherColumnAreNotWritten) {
  testing::Random random;
  const auto write = [&random](const std::vector<std::string>& names) {
    return trajectory_to_csv(random_trajectory(random, names));
  };
  EXPECT_REFUSED(
      write({"t"}),
      "joint \"t\" cannot be written to a .csv file, where this is the time; write .json");
  EXPECT_REFUSED(
      write({"a", "a_vel"}),
      "joint \"a_vel\" cannot be written to a .csv file, where this is the name of a column of "
      "joint \"a\"; write .json instead");
  EXPECT_REFUSED(write({"a_acc", "a"}), "joint \"a_acc\" cannot be written");
  EXPECT_REFUSED(write({"a", "a_VEL"}), "joint \"a_VEL\" cannot be written");
  EXPECT_REFUSED(write({"a\nb"}), "contains a control character");
  EXPECT_REFUSED(write({"a", "a"}), "two joints of the trajectory have the name \"a\"");
}

TEST(TrajectoryCsv, ColumnsMayBeInAnyOrder) {
  const Trajectory trajectory = parse("b_vel,a,t,a_vel,b\n1,2,0,3,4\n5,6,0.5,7,8\n");
  EXPECT_EQ(trajectory.joint_names, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(trajectory.times, (std::vector<double>{0, 0.5}));
  EXPECT_EQ(trajectory.positions[1], Eigen::Vector2d(6, 8));
  EXPECT_EQ(trajectory.velocities[0], Eigen::Vector2d(3, 1));
  EXPECT_TRUE(trajectory.accelerations.empty());
}

TEST(TrajectoryCsv, MistakesAreNamed) {
  EXPECT_REFUSED(parse(""), "a.csv: is empty");
  EXPECT_REFUSED(parse("t,a\n"), "has a header but no rows");
  EXPECT_REFUSED(parse("a,b\n1,2\n"), "a.csv: column \"t\" is missing");
  EXPECT_REFUSED(parse("t\n1\n"), "there are no columns besides \"t\"");
  EXPECT_REFUSED(parse("t,a,b,a_vel\n0,1,2,3\n"),
                 "a.csv: column \"b_vel\" is missing; all joints have _vel");
  EXPECT_REFUSED(parse("t,a,b,b_acc\n0,1,2,3\n"), "column \"a_acc\" is missing");
  EXPECT_REFUSED(parse("t,a,a_vel,a_vel_vel\n0,1,2,3\n"),
                 "column \"a_vel_vel\" does not belong to a joint");
  EXPECT_REFUSED(parse("t,a\n0,1\n\n0,2\n"), "a.csv:4: column t: time 0 is not after 0");
  EXPECT_REFUSED(parse("t,a\n0,1\n-1,2\n"), "a.csv:3: column t: time -1 is not after 0");
  EXPECT_REFUSED(parse("t,a\n0,x\n"), "a.csv:2: column a: \"x\" is not a number");
  EXPECT_REFUSED(parse("t,a\n0,inf\n"), "must be finite");
  EXPECT_REFUSED(parse("t,a\n0\n"), "a.csv:2: this row has 1 items");
}

TEST(TrajectoryCsv, InvalidTrajectoriesAreNotWritten) {
  EXPECT_REFUSED(trajectory_to_csv({}),
                 "the trajectory is empty, as after a motion that was refused");
  Trajectory trajectory;
  trajectory.joint_names = {"a"};
  EXPECT_REFUSED(trajectory_to_csv(trajectory), "the trajectory has no samples");
  trajectory.times = {0, 0};
  trajectory.positions = {Configuration::Zero(1), Configuration::Zero(1)};
  EXPECT_REFUSED(trajectory_to_csv(trajectory), "time does not increase");
  trajectory.times = {0, 1};
  trajectory.positions[1][0] = std::nan("");
  EXPECT_REFUSED(trajectory_to_csv(trajectory), "finite positions");
  trajectory.positions.pop_back();
  EXPECT_REFUSED(trajectory_to_csv(trajectory), "1 positions");
}

}  // namespace
}  // namespace beeline::internal
