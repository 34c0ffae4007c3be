#include <algorithm>
#include <gtest/gtest.h>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/internal/waypoint_rests.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

using beeline::testing::cases;
using beeline::testing::Random;

/// A trajectory that rests for some samples at each of a few configurations, in a random order.
Trajectory resting_motion(Random& random, const Arm& arm, std::vector<Configuration>& places) {
  places.clear();
  for (int i = random.integer(1, 6); i > 0; --i) places.push_back(random.configuration(arm));
  Trajectory motion{arm.joint_names(), {}, {}, {}, {}};
  for (int i = random.integer(1, 40); i > 0; --i) {
    const auto place =
        static_cast<std::size_t>(random.integer(0, static_cast<int>(places.size()) - 1));
    Configuration q = places[place];
    if (random.integer(0, 2) == 0) q[0] += random.uniform(-2e-4, 2e-4);  // about the tolerance
    const bool rests = random.integer(0, 3) > 0;
    for (int k = random.integer(1, 4); k > 0; --k) {
      motion.times.push_back(static_cast<double>(motion.times.size()));
      motion.positions.push_back(q);
      motion.velocities.push_back(Configuration::Constant(arm.dof(), rests ? 0 : 0.1));
    }
  }
  return motion;
}

TEST(WaypointRests, FindsTheRestsThatALookAtAllSamplesFinds) {
  Random random;
  constexpr Deviation tolerance{1e-4, 1e-4};
  int found = 0;
  for (const std::string name : {"ur5", "scara", "rrr", "gantry"}) {
    const Arm arm = built_in(name);
    const Task task = default_task(arm);
    for (int i = 0; i < cases(100); ++i) {
      SCOPED_TRACE(name + " " + std::to_string(i));
      std::vector<Configuration> places;
      const Trajectory motion = resting_motion(random, arm, places);
      const WaypointRests rests(arm, motion, task, tolerance);
      for (const Configuration& place : places) {
        Move move{.target = forward_kinematics(arm, place)};
        if (random.integer(0, 1) == 0) {
          move.kind = MoveKind::joint;
          move.q = place;
        }
        const auto first =
            static_cast<std::size_t>(random.integer(0, static_cast<int>(motion.size()) - 1));
        std::vector<std::size_t> listed = rests.rests(move, first);
        found += static_cast<int>(listed.size());
        std::sort(listed.begin(), listed.end());
        for (const std::size_t k : listed) {
          EXPECT_TRUE(k >= first && rests.rests_at(k) && rests.offset(move, k) <= 1) << k;
        }
        for (std::size_t k = first; k < motion.size(); ++k) {
          if (!rests.rests_at(k) || rests.offset(move, k) > 1) continue;
          // One sample of each rest is listed: between it and k all are at rest.
          const bool known = std::any_of(listed.begin(), listed.end(), [&](std::size_t other) {
            for (std::size_t j = std::min(k, other); j <= std::max(k, other); ++j) {
              if (!rests.rests_at(j)) return false;
            }
            return true;
          });
          EXPECT_TRUE(known) << k;
        }
      }
    }
  }
  EXPECT_GE(found, cases(100));
}

}  // namespace
}  // namespace beeline::internal
