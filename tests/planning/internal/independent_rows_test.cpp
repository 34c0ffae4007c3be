#include <gtest/gtest.h>

#include <beeline/model/catalog.h>
#include <beeline/planning/internal/independent_rows.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {
namespace {

TEST(IndependentRows, AreAllRowsOfArmsThatMoveThem) {
  for (const char* name : {"ur5", "panda", "puma560", "stanford"}) {
    const Arm arm = built_in(name);
    for (int bits = 1; bits < 64; ++bits) {
      Task task;
      for (std::size_t i = 0; i < 6; ++i) task.rows[i] = (bits >> i & 1) != 0;
      for (const Frame frame : {Frame::base, Frame::tool}) {
        task.frame = frame;
        EXPECT_EQ(independent_rows(arm, task), task) << name;
      }
    }
  }
}

TEST(IndependentRows, AreThoseThatArmsMove) {
  EXPECT_EQ(independent_rows(built_in("rrr"), Task::position()), task_named("110000"));
  EXPECT_EQ(independent_rows(built_in("rrr"), task_named("001001")), task_named("000001"));
  EXPECT_EQ(independent_rows(built_in("scara"), task_named("111100")), task_named("111000"));
  EXPECT_EQ(independent_rows(built_in("rp"), task_named("100100")), task_named("100000"));
  EXPECT_EQ(independent_rows(built_in("gantry"), task_named("101010")), task_named("100000"));
  EXPECT_EQ(independent_rows(built_in("rrr"), task_named("001110")).size(), 0);
  // With fewer joints than rows.
  EXPECT_EQ(independent_rows(built_in("scara"), Task::spatial()), Task::spatial());
  EXPECT_EQ(independent_rows(built_in("rp"), Task::planar()), Task::planar());
}

// The rows of a planar arm in a tilted plane all change; only two positions and one rotation are
// independent.
TEST(IndependentRows, AreAsManyAsTheRankOfATiltedPlane) {
  const Arm rrr = built_in("rrr");
  Pose base = Pose::Identity();
  base.linear() = so3_exp(Vector3(0.4, 0.5, 0));
  const Arm tilted(rrr.name(), rrr.joints(), rrr.tool(), base);
  EXPECT_EQ(independent_rows(tilted, Task::position()).size(), 2);
  EXPECT_EQ(independent_rows(tilted, task_named("000111")).size(), 1);
  EXPECT_FALSE(is_redundant(tilted, Task::spatial()));
  EXPECT_TRUE(is_redundant(tilted, Task::position()));
}

}  // namespace
}  // namespace beeline::internal
