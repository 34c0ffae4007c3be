#include <gtest/gtest.h>

#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>

#include <tests/path/random_line.h>

namespace beeline {
namespace {

using testing::cases;
using testing::Random;

/// Options of a random refusal: a dense rate, a duration, or neither.
PathMotionOptions random_options(Random& random) {
  PathMotionOptions options{.suggest = true};
  switch (random.integer(0, 3)) {
    case 0:
      options.rate = 2000;
      break;
    case 1:
      options.rate = 50;
      options.tolerance = options.orientation_tolerance = 1e-6;
      break;
    case 2:
      options.duration = random.uniform(0.3, 10);
      break;
    default:
      options.interpolation = Interpolation::cubic;
  }
  return options;
}

// What is suggested works with the same options, whatever they are.
TEST(Suggestions, WorkWithTheOptionsOfTheRefusal) {
  Random random;
  int suggested = 0;
  for (const char* name : {"puma560", "ur5e", "irb120", "rrr"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < cases(12); ++i) {
      const Configuration q = random.configuration(arm);
      const Pose from = forward_kinematics(arm, q);
      const std::vector<Pose> poses{from, testing::nearby_pose(random, arm, from)};
      const auto start = i % 2 == 0 ? std::optional(q) : std::nullopt;
      const PathMotionOptions options = random_options(random);
      const Route route = route_of(lines_through(poses), PathKind::line);
      const PathMotion refused = move_along(arm, start, route, options);
      if (refused) continue;
      for (const NearbyPath& nearby : refused.nearby) {
        ++suggested;
        const PathMotion motion = move_along(arm, nearby.start ? nearby.start : start,
                                             route_of(nearby.path, PathKind::line), options);
        ASSERT_EQ(motion.status, MotionStatus::reached)
            << name << ' ' << options.rate << nearby.description << '\n'
            << motion.reason;
        if (options.duration) {
          EXPECT_NEAR(motion.trajectory.times.back(), *options.duration, 1e-6);
        }
      }
    }
  }
  EXPECT_GE(suggested, cases(12) / 2);
}

}  // namespace
}  // namespace beeline
