#include <gtest/gtest.h>
#include <numbers>

#include <beeline/inverse/numerical/posture_index.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/model/catalog.h>

#include "../../random.h"

namespace beeline::internal {
namespace {

TEST(PostureIndex, AgreesWithTheComparisonWithAll) {
  testing::Random random;
  for (const char* name : {"ur5", "scara", "gantry"}) {
    const Arm arm = built_in(name);
    std::vector<Configuration> known;
    const auto at = [&](std::size_t i) -> const Configuration& { return known[i]; };
    PostureIndex index;
    int found = 0;
    for (int i = 0; i < testing::cases(2000); ++i) {
      Configuration q = random.configuration(arm);
      if (!known.empty() && random.integer(0, 2) > 0) {  // one that is known, or nearly
        q = known[static_cast<std::size_t>(random.integer(0, static_cast<int>(known.size()) - 1))];
        for (Eigen::Index k = 0; k < q.size(); ++k) {
          if (arm.periodic(k)) {
            q[k] += 2 * std::numbers::pi * random.integer(-3, 3);
          }
          q[k] += random.uniform(-1.2e-6, 1.2e-6);
        }
      }
      if (i % 5 == 0) q[0] = std::numbers::pi * random.integer(-4, 4);  // where it wraps
      bool expected = false;
      for (const Configuration& each : known) expected = expected || same_posture(arm, each, q);
      ASSERT_EQ(index.contains(arm, known.size(), at, q), expected) << name << ' ' << i;
      found += expected ? 1 : 0;
      if (!expected) known.push_back(q);
    }
    EXPECT_GT(found, testing::cases(2000) / 20);
    const Configuration other = known.back();
    known.resize(known.size() / 2);  // another set
    EXPECT_FALSE(index.contains(arm, known.size(), at, other));
    EXPECT_TRUE(index.contains(arm, known.size(), at, known.front()));
  }
}

}  // namespace
}  // namespace beeline::internal
