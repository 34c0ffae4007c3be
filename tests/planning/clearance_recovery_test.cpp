#include <beeline/model/catalog.h>
#include <beeline/planning/free_path.h>

#include <tests/certificate/led_out.h>
#include <tests/collision/random_model.h>
#include <tests/reason.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using namespace testing;

/// A configuration that keeps the clearance.
std::optional<Configuration> free_configuration(Random& random, const CollisionModel& model) {
  for (int tries = 0; tries < 100; ++tries) {
    Configuration q = random.configuration(model.arm());
    if (!blocked_by(model, q)) return q;
  }
  return std::nullopt;
}

/// Options of a motion: a rate, a duration, a profile or an interpolation of several.
FreeMotionOptions various_options(Random& random, double depth) {
  FreeMotionOptions options{.max_edges = 2000, .recover_clearance = depth};
  switch (random.integer(0, 4)) {
    case 0:
      options.rate = 100;
      break;
    case 1:
      options.duration = 20;
      break;
    case 2:
      options.profile = Profile::trapezoidal;
      break;
    case 3:
      options.interpolation = Interpolation::cubic;
      options.joint_blend = 0;
      break;
    default:
      break;
  }
  return options;
}

/// Expects that the motion stops where it is out of the clearance, and is within the limits.
void expect_begins_at_rest(const Arm& arm, const FreeMotion& motion) {
  ASSERT_GE(motion.path.waypoints.size(), 2U);
  ASSERT_EQ(motion.blends.size(), motion.path.waypoints.size() - 2);
  EXPECT_TRUE(motion.blends.empty() || motion.blends.front() == 0);
  double length = 0;
  for (std::size_t k = 1; k < motion.path.waypoints.size(); ++k) {
    length += (motion.path.waypoints[k] - motion.path.waypoints[k - 1]).norm();
  }
  EXPECT_NEAR(motion.path.length, length, 1e-12 * (1 + length));
  for (const Configuration& q : motion.trajectory.positions) {
    EXPECT_TRUE(limit_violations(arm, q, 1e-9).empty());
  }
  const LimitUsage use = limit_usage(arm, motion.trajectory);
  for (const double fraction : {use.velocity.fraction, use.acceleration.fraction}) {
    EXPECT_LE(fraction, 1 + 1e-6);
  }
}

TEST(MoveAroundRecovery, LeadsOutOfTheClearanceAndThenAround) {
  Random random;
  int found = 0, stuck = 0, in_contact = 0, out = 0;
  const int count = cases(150);
  for (int i = 0; i < count; ++i) {
    const Arm arm = built_in(i % 2 == 0 ? "panda" : "ur5");
    const CollisionModel model(arm, random_link_shapes(random, arm, 0.06),
                               random_scene(random, arm, random.integer(1, 6), 0.15, 0.8),
                               {.clearance = random.uniform(0.002, 0.02)});
    const double depth = random.uniform(0.2, 2) * model.clearance();
    const auto start = start_too_close(random, model, depth);
    const auto goal = free_configuration(random, model);
    if (!start || !goal) continue;
    const FreeMotionOptions options = various_options(random, 1.001 * depth);
    const FreeMotion motion = move_around(model, *start, std::vector{*goal}, options);
    if (!motion) {
      stuck += motion.reason.code == ReasonCode::start_not_free;
      continue;
    }
    ++found;
    in_contact += motion.clearance.recovery->distance < 0;
    EXPECT_EQ(motion.trajectory.positions.front(), *start);
    EXPECT_LT((motion.trajectory.positions.back() - *goal).norm(), 1e-9);
    expect_begins_at_rest(arm, motion);
    expect_leads_out(model, motion.trajectory, motion.clearance);
    if (HasFailure()) return;
    FreeMotionOptions hurried = options;
    hurried.budget.max_work = 1;
    EXPECT_EQ(move_around(model, *start, std::vector{*goal}, hurried).status,
              MotionStatus::work_limit);
    FreeMotionOptions less = options;
    less.recover_clearance = 0.9 * motion.clearance.recovery->depth;
    const FreeMotion refused = move_around(model, *start, std::vector{*goal}, less);
    EXPECT_EQ(refused.reason.code, ReasonCode::start_not_free);
    EXPECT_TRUE(refused.path.waypoints.empty());
    // The goal is where the path leads out.
    const std::vector<Configuration> exit{motion.path.waypoints[1]};
    const FreeMotion only_out = move_around(model, *start, exit, options);
    out += bool(only_out);
    EXPECT_EQ(only_out.path.waypoints, (std::vector<Configuration>{*start, exit.front()}));
  }
  std::cout << found << " found, " << in_contact << " of them from contact, " << stuck
            << " did not lead out, of " << count << '\n';
  EXPECT_GE(found, count / 4);
  EXPECT_GE(out, found * 3 / 4);
}

TEST(MoveAroundRecovery, IsNoneFromAStartThatIsClear) {
  Random random;
  for (int i = 0; i < cases(9); ++i) {
    const Arm arm = built_in("ur5");
    const CollisionModel model(arm, random_link_shapes(random, arm, 0.06),
                               random_scene(random, arm, 3, 0.15, 0.8));
    const auto start = free_configuration(random, model), goal = free_configuration(random, model);
    if (!start || !goal) continue;
    const std::vector<Configuration> goals{*goal};
    const FreeMotion with =
        move_around(model, *start, goals, {.max_edges = 500, .recover_clearance = 0.05});
    const FreeMotion without = move_around(model, *start, goals, {.max_edges = 500});
    EXPECT_EQ(with.status, without.status);
    EXPECT_EQ(with.trajectory.positions, without.trajectory.positions);
    EXPECT_FALSE(with.clearance.recovery);
  }
}

TEST(MoveAroundRecovery, RefusesHostileDepthsAndStarts) {
  const Arm arm = built_in("ur5");
  const CollisionModel model(arm, {{"hand", 6, {{Sphere{0.1}}}}});
  const Configuration q = Configuration::Zero(6);
  const std::vector<Configuration> goals{q};
  for (const double depth : {-1.0, 0.2, std::nan(""), Limits::none}) {
    EXPECT_REFUSED(move_around(model, q, goals, {.recover_clearance = depth}), "recover_clearance");
  }
  EXPECT_REFUSED(move_around(model, Configuration::Zero(5), goals, {.recover_clearance = 0.01}),
                 "joint");
  const Configuration outside = Configuration::Constant(6, 7);
  EXPECT_EQ(move_around(model, outside, goals, {.recover_clearance = 0.01}).status,
            MotionStatus::outside_limits);
}

}  // namespace
}  // namespace beeline
