#include <beeline/planning/program.h>

#include <tests/planning/pick.h>

namespace beeline {
namespace {

using namespace testing;

TEST(VerifyProgram, RefusesPlantedFaults) {
  const Arm arm = built_in("panda");
  const Program program = pick();
  const ProgramMotion motion = move_program(arm, home, program);
  ASSERT_TRUE(motion) << motion.reason;
  ASSERT_TRUE(verify(arm, motion.trajectory, program));
  const auto fault = [&](auto change) {
    Trajectory trajectory = motion.trajectory;
    Program asked = program;
    change(trajectory, asked.moves);
    return verify(arm, trajectory, asked);
  };
  using Moves = std::vector<Move>;
  const std::size_t at = motion.moves[1].end;
  const Verification shorter = fault([&](Trajectory& moved, Moves&) {
    for (std::size_t k = at + 1; k < moved.size(); ++k) moved.times[k] -= 0.01;
  });
  EXPECT_EQ(shorter.fault, Fault::dwell) << shorter.reason;
  EXPECT_EQ(shorter.sample, at);
  EXPECT_NE(shorter.reason.find("0.29 s at the waypoint of move 2 (line), not for 0.3 s"),
            std::string::npos)
      << shorter.reason;
  EXPECT_EQ(fault([](Trajectory&, Moves& moves) { moves[1].speed = 0.0999; }).fault,
            Fault::tool_speed);
  EXPECT_EQ(fault([](Trajectory&, Moves& moves) { moves[0].speed = 0.1; }).fault,
            Fault::tool_speed);
  EXPECT_EQ(
      fault([](Trajectory&, Moves& moves) { moves[1].target.translation().y() += 3e-4; }).fault,
      Fault::not_through);
  EXPECT_NE(fault([](Trajectory&, Moves& moves) { std::swap(moves[0], moves[1]); }).fault,
            Fault::none);
  const std::size_t middle = (motion.moves[1].begin + at) / 2;
  const Verification off =
      fault([&](Trajectory& moved, Moves&) { moved.positions[middle][5] += 1e-3; });
  EXPECT_NE(off.fault, Fault::none);
  EXPECT_NE(
      fault([&](Trajectory& moved, Moves&) { moved.positions[moved.size() - 1] = home; }).fault,
      Fault::none);
  const Verification cut = fault([&](Trajectory& moved, Moves&) {
    moved.times.resize(at + 1);
    moved.positions.resize(at + 1);
    moved.velocities.resize(at + 1);
    moved.accelerations.resize(at + 1);
  });
  EXPECT_NE(cut.fault, Fault::none);
  const Verification extra = fault(
      [&](Trajectory&, Moves& moves) { moves.push_back({.kind = MoveKind::joint, .q = home}); });
  EXPECT_EQ(extra.fault, Fault::not_through) << extra.reason;
}

}  // namespace
}  // namespace beeline
