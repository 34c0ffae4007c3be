#include <gtest/gtest.h>

#include <beeline/planning/status.h>

namespace beeline {
namespace {

TEST(MotionStatus, IsNamedAsInOutputs) {
  EXPECT_EQ(name(MotionStatus::reached), "reached");
  EXPECT_EQ(name(MotionStatus::unreachable), "unreachable");
  EXPECT_EQ(name(MotionStatus::not_found), "not_found");
  EXPECT_EQ(name(MotionStatus::outside_limits), "outside_limits");
  EXPECT_EQ(name(MotionStatus::singular), "singular");
  EXPECT_EQ(name(MotionStatus::not_converged), "not_converged");
}

}  // namespace
}  // namespace beeline
