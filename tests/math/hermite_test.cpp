#include <algorithm>
#include <gtest/gtest.h>

#include <beeline/math/hermite.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

TEST(Quintic, HasTheDerivativesOfItsEndsAndThoseOfItsValues) {
  testing::Random random;
  for (int i = 0; i < 100; ++i) {
    const auto any = [&] { return random.uniform(-2, 2); };
    const double change = any(), d0 = any(), dd0 = any(), d1 = any(), dd1 = any();
    const Quintic<double> quintic = quintic_between(change, d0, dd0, d1, dd1);
    ASSERT_EQ(quintic.change(0), 0);
    ASSERT_NEAR(quintic.change(1), change, 1e-12);
    ASSERT_EQ(quintic.first(0), d0);
    ASSERT_NEAR(quintic.first(1), d1, 1e-12);
    ASSERT_EQ(quintic.second(0), dd0);
    ASSERT_NEAR(quintic.second(1), dd1, 1e-11);
    const double u = random.uniform(0.1, 0.9), h = 1e-5;
    ASSERT_NEAR((quintic.change(u + h) - quintic.change(u - h)) / (2 * h), quintic.first(u), 1e-6);
    ASSERT_NEAR((quintic.first(u + h) - quintic.first(u - h)) / (2 * h), quintic.second(u), 1e-6);
    ASSERT_NEAR((quintic.second(u + h) - quintic.second(u - h)) / (2 * h), quintic.third(u), 1e-5);
  }
}

TEST(RestToRest, IsTheQuinticBetweenTwoStops) {
  const Quintic<double> quintic = quintic_between(1.0, 0.0, 0.0, 0.0, 0.0);
  for (const double u : {0.0, 0.1, 0.25, 0.5, 0.8, 1.0}) {
    const RestToRest motion = rest_to_rest(u);
    EXPECT_NEAR(motion.value, quintic.change(u), 1e-14);
    EXPECT_NEAR(motion.first, quintic.first(u), 1e-13);
    EXPECT_NEAR(motion.second, quintic.second(u), 1e-12);
    EXPECT_NEAR(motion.third, quintic.third(u), 1e-11);
  }
  EXPECT_EQ(rest_to_rest(1).first, 0);
  EXPECT_EQ(rest_to_rest(1).second, 0);
}

}  // namespace
}  // namespace beeline::internal
