#include <cmath>
#include <gtest/gtest.h>

#include <beeline/timing/internal/minimise_duration.h>
#include <beeline/timing/internal/newton_equations.h>

#include <tests/random.h>

namespace beeline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A clock for a motion without sense, well inside all its limits.
struct Case {
  SquaredRateSpline clock;
  DurationProblem problem;
};
Case random_case(testing::Random& random, bool jerks) {
  const int joints = random.integer(1, 9);
  std::vector<double> knots{0};
  const int steps = random.integer(9, 30);
  for (int k = 0; k < steps; ++k) knots.push_back(knots.back() + random.uniform(0.5, 1.5));
  SquaredRateSpline clock(knots);
  const VectorXd none = VectorXd::Constant(joints, HUGE_VAL), one = VectorXd::Ones(joints);
  DurationProblem problem(clock, jerks ? none : one, jerks ? one : none);
  for (std::size_t k = 0; k < problem.moments().size(); ++k) {
    MotionSample moment{std::size_t(joints)};
    for (auto* kind : {&moment.half_velocity, &moment.acceleration, &moment.jerk}) {
      for (double& value : *kind) value = random.uniform(-0.2, 0.2);
    }
    moment.inverse_most = random.uniform(0, 0.5);
    problem.set(k, moment);
  }
  for (double& c : clock.coefficients) c = random.uniform(0.8, 1.2);
  return {clock, problem};
}

std::vector<double> padded(const DurationProblem& problem, const VectorXd& c) {
  std::vector<double> numbers(problem.coefficients(), 1);
  std::copy(c.begin(), c.end(), numbers.begin());
  return numbers;
}

/// What is left of all limits, and the duration's share of each moment.
struct Left {
  std::vector<double> left;
  double duration = 0;
};
Left left_of(const DurationProblem& problem, const VectorXd& coefficients) {
  const std::vector<double> c = padded(problem, coefficients);
  constexpr std::size_t lanes = DurationProblem::lanes;
  Left all;
  all.left.resize(problem.multipliers());
  std::size_t first = 0;
  for (std::size_t block = 0; block < problem.blocks(); ++block) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double* numbers = problem.numbers(block) + lane;
      double rate[3] = {0, 0, 0};
      for (std::size_t r = 0; r < 9; ++r) {
        rate[r / 3] += numbers[r * lanes] * c[problem.first_step(block) + lane + r % 3];
      }
      const auto [b, slope, bend] = rate;
      all.duration += numbers[9 * lanes] / std::sqrt(b);
      double* left = all.left.data() + first + lane;
      *left = 1 - numbers[10 * lanes] * b;
      for (std::size_t i = 0; i < problem.joints(); ++i) {
        const double* motion = numbers + (11 + 3 * i) * lanes;
        const double v = motion[0], a = motion[lanes], j = motion[2 * lanes];
        const double* limits = problem.inverse_limits() + 2 * i;
        const double rise = limits[0] * (a * b + v * slope);
        const double jerk = limits[1] * std::sqrt(b) * (j * b + 1.5 * a * slope + v * bend);
        for (const double what : {1 - rise, 1 + rise, 1 - jerk, 1 + jerk}) *(left += lanes) = what;
      }
    }
    first += lanes * (1 + 4 * problem.joints());
  }
  return all;
}

double barrier(const DurationProblem& problem, const VectorXd& c, double gap) {
  const Left all = left_of(problem, c);
  double value = all.duration;
  for (const double left : all.left) value -= gap * std::log(left);
  return value;
}

/// Multipliers that fit the gap.
std::vector<double> fitting(const DurationProblem& problem, const VectorXd& c, double gap) {
  std::vector<double> multipliers = left_of(problem, c).left;
  for (double& m : multipliers) m = gap / m;
  return multipliers;
}

VectorXd gradient(const DurationProblem& problem, const VectorXd& c, double gap) {
  NewtonEquations equations(problem);
  const auto multipliers = fitting(problem, c, gap);
  EXPECT_TRUE(set_up(equations, problem, padded(problem, c).data(), multipliers.data(), gap));
  return Eigen::Map<VectorXd>(equations.gradient.data(), c.size());
}

TEST(NewtonEquations, GradientIsThatOfTheBarrier) {
  testing::Random random;
  for (int i = 0; i < 20; ++i) {
    const auto [clock, problem] = random_case(random, i % 2 == 0);
    const VectorXd& c = clock.coefficients;
    const VectorXd found = gradient(problem, c, 0.01);
    constexpr double h = 1e-5;
    for (Eigen::Index k = 0; k < c.size(); ++k) {
      const VectorXd aside = h * VectorXd::Unit(c.size(), k);
      const double slope =
          (barrier(problem, c + aside, 0.01) - barrier(problem, c - aside, 0.01)) / (2 * h);
      ASSERT_NEAR(found[k], slope, 1e-7);
    }
  }
}

TEST(NewtonEquations, HessianIsTheGradientsDerivativeWhereLimitsDoNotBend) {
  testing::Random random;
  for (int i = 0; i < 10; ++i) {
    const auto [clock, problem] = random_case(random, false);
    const VectorXd& c = clock.coefficients;
    NewtonEquations equations(problem);
    const auto multipliers = fitting(problem, c, 0.01);
    ASSERT_TRUE(set_up(equations, problem, padded(problem, c).data(), multipliers.data(), 0.01));
    constexpr double h = 1e-5;
    for (Eigen::Index k = 0; k < c.size(); ++k) {
      const VectorXd aside = h * VectorXd::Unit(c.size(), k);
      const VectorXd column =
          (gradient(problem, c + aside, 0.01) - gradient(problem, c - aside, 0.01)) / (2 * h);
      for (Eigen::Index row = k; row < c.size(); ++row) {
        const auto band = std::size_t(row - k);
        const double found = band < 3 ? equations.bands[band][std::size_t(k)] : 0;
        ASSERT_NEAR(found, column[row], 1e-7);
      }
    }
  }
}

TEST(NewtonEquations, StepOfTheMultipliersBringsTheProductsToTheGap) {
  testing::Random random;
  for (int i = 0; i < 20; ++i) {
    const auto [clock, problem] = random_case(random, i % 2 == 0);
    const VectorXd& c = clock.coefficients;
    VectorXd dc(c.size());
    for (double& value : dc) value = random.uniform(-1, 1);
    std::vector<double> multipliers(problem.multipliers()), change(multipliers.size());
    for (double& m : multipliers) m = random.uniform(0.01, 1);
    std::vector<double> step(problem.coefficients(), 0);
    std::copy(dc.begin(), dc.end(), step.begin());
    const MultiplierStep found = multiplier_step(problem, padded(problem, c).data(), step.data(),
                                                 multipliers.data(), 0.01, change.data());
    constexpr double h = 1e-6;
    const auto left = left_of(problem, c).left, before = left_of(problem, c - h * dc).left,
               after = left_of(problem, c + h * dc).left;
    double nearest = HUGE_VAL, nearest_multiplier = HUGE_VAL, products = 0;
    for (std::size_t k = 0; k < left.size(); ++k) {
      const double dleft = (after[k] - before[k]) / (2 * h);
      // left m + dleft m + left dm = gap
      ASSERT_NEAR((left[k] + dleft) * multipliers[k] + left[k] * change[k], 0.01, 1e-7);
      if (dleft < 0) nearest = std::min(nearest, -left[k] / dleft);
      if (change[k] < 0)
        nearest_multiplier = std::min(nearest_multiplier, -multipliers[k] / change[k]);
      products += (left[k] + 0.3 * dleft) * (multipliers[k] + 0.7 * change[k]);
    }
    ASSERT_NEAR(found.products_after(0.3, 0.7), products, 1e-6 * double(left.size()));
    ASSERT_LE(found.coefficients, nearest * (1 + 1e-6));  // b has to stay above zero too
    ASSERT_NEAR(found.multipliers, nearest_multiplier, 1e-6 * nearest_multiplier);
  }
}

TEST(MinimiseDuration, HastensUpToTheLimits) {
  testing::Random random;
  for (int i = 0; i < 20; ++i) {
    auto [clock, problem] = random_case(random, i % 2 == 0);
    const double before = left_of(problem, clock.coefficients).duration;
    minimise_duration(clock, problem);
    const Left after = left_of(problem, clock.coefficients);
    ASSERT_LT(after.duration, before);
    ASSERT_GT(*std::min_element(after.left.begin(), after.left.end()), 0);
    // No direction is left that is quicker by much: the barrier's own, for a small gap.
    const double gap = 1e-4 / double(clock.steps());
    const double value = barrier(problem, clock.coefficients, gap);
    for (int k = 0; k < 100; ++k) {
      VectorXd aside(clock.coefficients.size());
      for (double& x : aside) x = random.uniform(-1e-3, 2e-3);
      const VectorXd tried = clock.coefficients + aside;
      const Left there = left_of(problem, tried);
      const bool inside = *std::min_element(there.left.begin(), there.left.end()) > 0;
      if (inside) {
        ASSERT_GT(barrier(problem, tried, gap), value * (1 - 1e-3));
      }
    }
  }
}

TEST(MinimiseDuration, LeavesAClockThatKeepsNoLimits) {
  testing::Random random;
  auto [clock, problem] = random_case(random, true);
  clock.coefficients.setConstant(1e3);
  minimise_duration(clock, problem);
  EXPECT_EQ(clock.coefficients, VectorXd::Constant(clock.coefficients.size(), 1e3));
}

TEST(SquaredRateSpline, IsSmoothAtItsKnots) {
  testing::Random random;
  for (int i = 0; i < 50; ++i) {
    const SquaredRateSpline clock = random_case(random, true).clock;
    for (std::size_t k = 0; k + 1 < clock.steps(); ++k) {
      const SquaredRate end = clock.begin_of(k).after(clock.knots()[k + 1] - clock.knots()[k]);
      ASSERT_NEAR(end.b, clock.begin_of(k + 1).b, 1e-12);
      ASSERT_NEAR(end.slope, clock.begin_of(k + 1).slope, 1e-12);
    }
  }
}

}  // namespace
}  // namespace beeline
