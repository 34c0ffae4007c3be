#include <beeline/model/moving_base.h>

#include <tests/planning/motion_promises.h>

namespace beeline {
namespace {

using namespace testing;

Limits equal_limits(double value) { return {.lower = value, .upper = value}; }

/// Checks that the first coordinates stand still at `q` exactly.
void expect_at_rest(const Trajectory& trajectory, const Configuration& q) {
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    ASSERT_EQ(trajectory.positions[k].head(q.size()), q);
    ASSERT_TRUE(trajectory.velocities[k].head(q.size()).isZero(0));
    ASSERT_TRUE(trajectory.accelerations[k].head(q.size()).isZero(0));
  }
}

/// Two poses of the arm, from one to the other a short line.
std::vector<Pose> short_line(Random& random, const Arm& arm) {
  const Pose from = forward_kinematics(arm, inner_configuration(random, arm));
  Pose to = from;
  to.translation() += random.direction() * random.uniform(0.05, 0.5);
  to.linear() = so3_exp(random.direction() * random.uniform(0, 0.8)) * to.linear();
  return {from, to};
}

/// Counts the motions, and checks those that are reached.
struct Outcomes {
  int all = 0, reached = 0;

  void add(const PathMotion& motion, const Configuration& base) {
    ++all;
    const std::string name = joint(motion.reason);
    EXPECT_FALSE(motion.reason.code == ReasonCode::spline_outside_limits &&
                 (name == "rail" || name.starts_with("base_")))
        << motion.reason;
    if (!motion) return;
    ++reached;
    expect_at_rest(motion.trajectory, base);
  }
};

// A joint whose limits are equal stands still between the samples too, and so it is never the
// reason why the spline through them leaves the limits.
TEST(EqualLimits, OfARailOrABaseHoldBetweenSamples) {
  Random random;
  Outcomes on_rail, on_base;
  for (const char* name : {"ur5", "puma560", "panda"}) {
    const Arm alone = built_in(name);
    for (int i = 0; i < cases(25); ++i) {
      const std::vector<Pose> poses = short_line(random, alone);
      if (!move_in_lines(alone, poses)) continue;
      const Vector3 shift = random.vector(3);
      std::vector<Pose> on_a_rail = poses, on_a_base = poses;
      for (Pose& pose : on_a_rail) pose.translation() += shift;
      for (Pose& pose : on_a_base) pose.translation().head<2>() += shift.head<2>();
      on_rail.add(move_in_lines(with_rail(alone, shift, equal_limits(shift.norm())), on_a_rail),
                  Configuration::Constant(1, shift.norm()));
      const MobileBase base{
          .x = equal_limits(shift.x()), .y = equal_limits(shift.y()), .heading = equal_limits(0)};
      on_base.add(move_in_lines(with_mobile_base(alone, base), on_a_base),
                  Vector3(shift.x(), shift.y(), 0));
    }
  }
  std::cout << on_rail.reached << " and " << on_base.reached << " of " << on_rail.all << '\n';
  EXPECT_GE(on_rail.reached, on_rail.all * 3 / 4);
  EXPECT_GE(on_base.reached, on_base.all * 3 / 4);
}

}  // namespace
}  // namespace beeline
