#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/trajectory/internal/limit_fraction.h>

#include <tests/trajectory/motion_by_columns.h>

namespace beeline::internal {
namespace {

using testing::derivative_between;
using testing::Random;

constexpr int fraction_points = 1000;  // in each interval
// A polynomial of degree 5 exceeds the largest of them by less (Markov's inequality).
constexpr double between_points = 1e-4;

/// Limits of all kinds, about one in five infinite.
std::vector<Limits> some_limits(Random& random, std::size_t count) {
  std::vector<Limits> limits(count);
  for (Limits& joint : limits) {
    for (double Limits::*kind : {&Limits::velocity, &Limits::acceleration, &Limits::jerk}) {
      joint.*kind = random.integer(0, 4) == 0 ? Limits::none : random.uniform(0.5, 5);
    }
  }
  return limits;
}

double limit_of_order(const Limits& limits, int order) {
  return order == 1 ? limits.velocity : order == 2 ? limits.acceleration : limits.jerk;
}

/// The largest fraction of the interval after sample k at many points, both ends included.
double dense_fraction(const std::vector<Limits>& limits, const Trajectory& motion, std::size_t k,
                      std::size_t coordinate, int order) {
  double largest = 0;
  for (int i = 0; i <= fraction_points; ++i) {
    const double u = static_cast<double>(i) / fraction_points;
    const double value = derivative_between(motion, k, Eigen::Index(coordinate), u, order);
    largest = std::max(largest, std::abs(value) / limit_of_order(limits[coordinate], order));
  }
  return largest;
}

/// The orders that an interpolation bounds.
int last_order(const Trajectory& motion) {
  return motion.velocities.empty() ? 1 : motion.accelerations.empty() ? 2 : 3;
}

TEST(LimitFractions, AreTheLargestOfADenseEvaluationOfEachInterval) {
  Random random;
  for (int i = 0; i < testing::cases(60); ++i) {
    const auto limits = some_limits(random, std::size_t(random.integer(1, 4)));
    const Trajectory motion =
        testing::random_motion(random, std::vector<std::string>(limits.size()),
                               random.integer(2, 6), testing::interpolations[i % 3]);
    for (int order = 1; order <= 3; ++order) {
      const std::vector<double> fractions = limit_fractions(limits, motion, order);
      ASSERT_EQ(fractions.size() + 1, motion.size());
      for (std::size_t k = 0; k < fractions.size(); ++k) {
        double largest = 0;
        for (std::size_t c = 0; c < limits.size() && order <= last_order(motion); ++c) {
          largest = std::max(largest, dense_fraction(limits, motion, k, c, order));
        }
        ASSERT_GE(fractions[k], largest * (1 - 1e-9) - 1e-9) << "order " << order;
        ASSERT_LE(fractions[k], largest * (1 + between_points) + 1e-9) << "order " << order;
      }
    }
  }
}

TEST(LimitFraction, IsTheLargestOfTheIntervalsWithItsPlace) {
  Random random;
  for (int i = 0; i < testing::cases(300); ++i) {
    const auto limits = some_limits(random, std::size_t(random.integer(1, 4)));
    const Trajectory motion =
        testing::random_motion(random, std::vector<std::string>(limits.size()),
                               random.integer(2, 9), testing::interpolations[i % 3]);
    for (int order = 1; order <= 3; ++order) {
      const CoordinateFraction found = limit_fraction(limits, motion, order);
      ASSERT_EQ(found.exact, order <= last_order(motion));
      if (!found.exact) continue;
      const auto all = limit_fractions(limits, motion, order);
      ASSERT_DOUBLE_EQ(found.fraction, *std::max_element(all.begin(), all.end()));
      if (found.fraction == 0) continue;
      const double there =
          dense_fraction(limits, motion, found.sample, std::size_t(found.coordinate), order);
      ASSERT_NEAR(there, found.fraction, between_points * found.fraction + 1e-9);
    }
  }
}

}  // namespace
}  // namespace beeline::internal
