#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/pose/so3.h>

#include <tests/random.h>

namespace beeline {
namespace {

using std::numbers::pi;

double any_magnitude(testing::Random& random) {
  return random.uniform(-1, 1) * std::pow(10, random.uniform(-300, 308));
}

TEST(WrapAngle, IsEquivalentAndWithinPi) {
  testing::Random random;
  for (int i = 0; i < 20000; ++i) {
    const double a = random.uniform(-1000, 1000);
    const double wrapped = wrap_angle(a);
    ASSERT_LE(std::abs(wrapped), pi) << a;
    ASSERT_NEAR(std::sin(wrapped), std::sin(a), 1e-12) << a;
    ASSERT_NEAR(std::cos(wrapped), std::cos(a), 1e-12) << a;
    ASSERT_EQ(wrap_angle(wrapped), wrapped);
  }
}

TEST(AngleDifference, IsWithinPiAndAntisymmetricAtAnyMagnitude) {
  testing::Random random;
  for (int i = 0; i < 20000; ++i) {
    const double a = any_magnitude(random), b = any_magnitude(random);
    const double difference = angle_difference(a, b);
    ASSERT_LE(std::abs(difference), pi) << a << " " << b;
    ASSERT_EQ(difference, -angle_difference(b, a)) << a << " " << b;
  }
  EXPECT_LE(std::abs(angle_difference(1.7e308, -1.7e308)), pi);
}

TEST(AngleDifference, AddedToTheSecondAngleGivesTheFirst) {
  testing::Random random;
  for (int i = 0; i < 20000; ++i) {
    const double a = random.uniform(-20, 20), b = random.uniform(-20, 20);
    const double reached = b + angle_difference(a, b);
    ASSERT_NEAR(std::remainder(reached - a, 2 * pi), 0, 3e-13) << a << " " << b;
  }
}

TEST(AngleDifference, IgnoresMultiplesOfTwoPi) {
  testing::Random random;
  for (int i = 0; i < 5000; ++i) {
    const double b = random.uniform(-10, 10), turn = random.uniform(-3.1, 3.1);
    const double turns = random.integer(-50, 50);
    ASSERT_NEAR(angle_difference(b + turn + turns * 2 * pi, b), turn, 1e-12);
  }
}

TEST(AngleDifference, IsPiAtPiAndZeroBetweenPiAndMinusPi) {
  EXPECT_EQ(angle_difference(pi, 0), pi);
  EXPECT_EQ(angle_difference(-pi, 0), -pi);
  EXPECT_EQ(std::abs(angle_difference(0, pi)), pi);
  EXPECT_EQ(angle_difference(pi, -pi), 0);
  EXPECT_EQ(angle_difference(-pi, pi), 0);
  EXPECT_NEAR(angle_difference(pi - 1e-9, -pi + 1e-9), -2e-9, 1e-15);
  EXPECT_NEAR(angle_difference(350 * pi / 180, 10 * pi / 180), -20 * pi / 180, 1e-15);
}

TEST(NearestTurn, IsEquivalentAndWithinPiOfTheReference) {
  testing::Random random;
  for (int i = 0; i < 20000; ++i) {
    const double a = random.uniform(-50, 50), reference = random.uniform(-50, 50);
    const double near = nearest_angle(a, reference);
    ASSERT_LE(std::abs(near - reference), pi + 1e-13);
    const double turns = (near - a) / (2 * pi);
    ASSERT_NEAR(turns, std::round(turns), 3e-13);
    ASSERT_EQ(nearest_angle(near, reference), near)
        << "a value within pi of the reference is unchanged";
  }
  EXPECT_EQ(nearest_angle(1e-20, 3), 1e-20) << "the reference does not enter the sum";
  EXPECT_EQ(nearest_angle(pi, 0), pi);
}

}  // namespace
}  // namespace beeline
