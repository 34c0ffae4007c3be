#include <gtest/gtest.h>
#include <set>
#include <sstream>

#include <beeline/planning/branch.h>

namespace beeline {
namespace {

constexpr std::pair<MotionStatus, const char*> names[] = {
    {MotionStatus::reached, "reached"},
    {MotionStatus::unreachable, "unreachable"},
    {MotionStatus::not_found, "not_found"},
    {MotionStatus::outside_limits, "outside_limits"},
    {MotionStatus::singular, "singular"},
    {MotionStatus::not_proved, "not_proved"},
    {MotionStatus::too_many_samples, "too_many_samples"},
    {MotionStatus::not_converged, "not_converged"},
    {MotionStatus::collides, "collides"},
    {MotionStatus::not_decided, "not_decided"}};

TEST(MotionStatus, HasANameOfItsOwnThatIsPrinted) {
  std::set<std::string> seen;
  for (const auto& [status, expected] : names) {
    EXPECT_EQ(name(status), expected);
    std::ostringstream out;
    out << status;
    EXPECT_EQ(out.str(), expected);
    EXPECT_TRUE(seen.insert(name(status)).second) << expected;
  }
}

// A proof for a pose holds for the motion; a failed search proves nothing.
TEST(MotionStatus, FollowsFromTheStatusOfAPose) {
  EXPECT_EQ(motion_status(InverseStatus::unreachable), MotionStatus::unreachable);
  EXPECT_EQ(motion_status(InverseStatus::orientation_unreachable), MotionStatus::unreachable);
  EXPECT_EQ(motion_status(InverseStatus::outside_limits), MotionStatus::outside_limits);
  EXPECT_EQ(motion_status(InverseStatus::not_found), MotionStatus::not_found);
}

}  // namespace
}  // namespace beeline
