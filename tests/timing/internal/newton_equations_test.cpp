#include <cmath>
#include <gtest/gtest.h>

#include <beeline/timing/internal/minimise_duration.h>
#include <beeline/timing/internal/newton_equations.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A random motion and a spline of squared rates well inside all its limits, which are all 1, of
/// acceleration or of jerk.
struct NewtonCase {
  SquaredRateSpline spline;
  DurationProblem problem;
  std::vector<MotionSample> samples;  ///< at problem.times()
  double acceleration, jerk;
};
NewtonCase random_case(testing::Random& random, bool jerks) {
  const int joints = random.integer(1, 9);
  std::vector<double> knots{0};
  const int steps = random.integer(9, 30);
  for (int k = 0; k < steps; ++k) knots.push_back(knots.back() + random.uniform(0.5, 1.5));
  SquaredRateSpline spline(knots);
  const double acceleration = jerks ? HUGE_VAL : 1, jerk = jerks ? 1 : HUGE_VAL;
  DurationProblem problem(spline, VectorXd::Constant(joints, acceleration),
                          VectorXd::Constant(joints, jerk));
  std::vector<MotionSample> samples;
  for (std::size_t k = 0; k < problem.times().size(); ++k) {
    MotionSample sample{std::size_t(joints)};
    for (auto* kind : {&sample.half_velocity, &sample.acceleration, &sample.jerk}) {
      for (double& value : *kind) value = random.uniform(-0.2, 0.2);
    }
    sample.inverse_max = random.uniform(0, 0.5);
    problem.set(k, sample);
    samples.push_back(sample);
  }
  for (double& c : spline.coefficients) c = random.uniform(0.8, 1.2);
  return {spline, problem, samples, acceleration, jerk};
}

std::vector<double> padded(const DurationProblem& problem, const VectorXd& c) {
  std::vector<double> numbers(problem.coefficients(), 1);
  std::copy(c.begin(), c.end(), numbers.begin());
  return numbers;
}

/// The slacks of all limits in the order of the multipliers, and the duration as a fraction of that
/// at b = 1, by Simpson's rule.
struct Slacks {
  std::vector<double> slack;
  double duration = 0;
};
Slacks slacks_of(const NewtonCase& made, const VectorXd& coefficients) {
  const DurationProblem& problem = made.problem;
  SquaredRateSpline spline = made.spline;
  spline.coefficients = coefficients;
  const std::vector<double>& knots = spline.knots();
  Slacks all;
  for (std::size_t k = 0; k < spline.steps(); ++k) {
    const double length = knots[k + 1] - knots[k];
    const auto integrand = [&](double u) {
      return 1 / std::sqrt(spline.begin_of(k).after(u * length).b);
    };
    all.duration +=
        length / knots.back() / 6 * (integrand(1e-6) + 4 * integrand(0.5) + integrand(1 - 1e-6));
  }
  all.slack.assign(problem.multipliers(), 1);
  constexpr std::size_t lanes = DurationProblem::lanes;
  for (std::size_t m = 0; m < problem.times().size(); ++m) {
    const double tau = problem.times()[m];
    if (tau == knots.back()) continue;  // past the end of the spline
    const auto next = std::upper_bound(knots.begin(), knots.end(), tau);
    const auto k = static_cast<std::size_t>(next - knots.begin()) - 1;
    const SquaredRate rate = spline.begin_of(k).after(tau - knots[k]);
    const MotionSample& motion = made.samples[m];
    double* slack = &all.slack[m / lanes * lanes * (1 + 4 * problem.joints()) + m % lanes];
    *slack = 1 - motion.inverse_max * rate.b;
    for (std::size_t i = 0; i < problem.joints(); ++i) {
      const double v = 2 * motion.half_velocity[i], a = motion.acceleration[i];
      const double acceleration = (a * rate.b + v * rate.db / 2) / made.acceleration;
      const double jerk = std::sqrt(rate.b) / made.jerk *
                          (motion.jerk[i] * rate.b + 1.5 * a * rate.db + v * rate.ddb / 2);
      for (const double value : {1 - acceleration, 1 + acceleration, 1 - jerk, 1 + jerk}) {
        *(slack += lanes) = value;
      }
    }
  }
  return all;
}

double barrier(const NewtonCase& made, const VectorXd& c, double gap) {
  const Slacks all = slacks_of(made, c);
  double value = all.duration;
  for (const double slack : all.slack) value -= gap * std::log(slack);
  return value;
}

/// The multipliers with exactly this gap.
std::vector<double> fitting(const NewtonCase& made, const VectorXd& c, double gap) {
  std::vector<double> multipliers = slacks_of(made, c).slack;
  for (double& m : multipliers) m = gap / m;
  return multipliers;
}

VectorXd gradient(const NewtonCase& made, const VectorXd& c, double gap) {
  const DurationProblem& problem = made.problem;
  NewtonEquations equations(problem);
  const auto multipliers = fitting(made, c, gap);
  EXPECT_TRUE(set_up(equations, problem, padded(problem, c).data(), multipliers.data(), gap));
  return Eigen::Map<VectorXd>(equations.gradient.data(), c.size());
}

TEST(NewtonEquations, GradientIsThatOfTheBarrier) {
  testing::Random random;
  for (int i = 0; i < 20; ++i) {
    const NewtonCase made = random_case(random, i % 2 == 0);
    const VectorXd& c = made.spline.coefficients;
    const VectorXd found = gradient(made, c, 0.01);
    constexpr double h = 1e-5;
    for (Eigen::Index k = 0; k < c.size(); ++k) {
      const VectorXd aside = h * VectorXd::Unit(c.size(), k);
      const double slope =
          (barrier(made, c + aside, 0.01) - barrier(made, c - aside, 0.01)) / (2 * h);
      ASSERT_NEAR(found[k], slope, 1e-7);
    }
  }
}

TEST(NewtonEquations, HessianIsTheDerivativeOfTheGradientWhereLimitsAreLinear) {
  testing::Random random;
  for (int i = 0; i < 10; ++i) {
    const NewtonCase made = random_case(random, false);
    const DurationProblem& problem = made.problem;
    const VectorXd& c = made.spline.coefficients;
    NewtonEquations equations(problem);
    const auto multipliers = fitting(made, c, 0.01);
    ASSERT_TRUE(set_up(equations, problem, padded(problem, c).data(), multipliers.data(), 0.01));
    constexpr double h = 1e-5;
    for (Eigen::Index k = 0; k < c.size(); ++k) {
      const VectorXd aside = h * VectorXd::Unit(c.size(), k);
      const VectorXd column =
          (gradient(made, c + aside, 0.01) - gradient(made, c - aside, 0.01)) / (2 * h);
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
    const NewtonCase made = random_case(random, i % 2 == 0);
    const DurationProblem& problem = made.problem;
    const VectorXd& c = made.spline.coefficients;
    VectorXd dc(c.size());
    for (double& value : dc) value = random.uniform(-1, 1);
    std::vector<double> multipliers(problem.multipliers()), change(multipliers.size());
    for (double& m : multipliers) m = random.uniform(0.01, 1);
    std::vector<double> step(problem.coefficients(), 0);
    std::copy(dc.begin(), dc.end(), step.begin());
    const MultiplierStep found = multiplier_step(problem, padded(problem, c).data(), step.data(),
                                                 multipliers.data(), 0.01, change.data());
    constexpr double h = 1e-6;
    const auto left = slacks_of(made, c).slack, before = slacks_of(made, c - h * dc).slack,
               after = slacks_of(made, c + h * dc).slack;
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

TEST(MinimiseDuration, EndsAtTheLimits) {
  testing::Random random;
  for (int i = 0; i < 20; ++i) {
    NewtonCase made = random_case(random, i % 2 == 0);
    VectorXd& c = made.spline.coefficients;
    const double before = slacks_of(made, c).duration;
    minimise_duration(made.spline, made.problem);
    const Slacks after = slacks_of(made, c);
    ASSERT_LT(after.duration, before);
    ASSERT_GT(*std::min_element(after.slack.begin(), after.slack.end()), 0);
    // Nearby coefficients have no much smaller value of the barrier function, for a small gap.
    const double gap = 1e-4 / double(made.spline.steps());
    const double value = barrier(made, c, gap);
    for (int k = 0; k < 100; ++k) {
      VectorXd aside(c.size());
      for (double& x : aside) x = random.uniform(-1e-3, 2e-3);
      const VectorXd tried = c + aside;
      const Slacks there = slacks_of(made, tried);
      const bool inside = *std::min_element(there.slack.begin(), there.slack.end()) > 0;
      if (inside) {
        ASSERT_GT(barrier(made, tried, gap), value * (1 - 1e-3));
      }
    }
  }
}

TEST(MinimiseDuration, LeavesCoefficientsThatViolateLimits) {
  testing::Random random;
  NewtonCase made = random_case(random, true);
  VectorXd& c = made.spline.coefficients;
  c.setConstant(1e3);
  minimise_duration(made.spline, made.problem);
  EXPECT_EQ(c, VectorXd::Constant(c.size(), 1e3));
}

TEST(SquaredRateSpline, IsSmoothAtItsKnots) {
  testing::Random random;
  for (int i = 0; i < 50; ++i) {
    const SquaredRateSpline spline = random_case(random, true).spline;
    for (std::size_t k = 0; k + 1 < spline.steps(); ++k) {
      const SquaredRate end = spline.begin_of(k).after(spline.knots()[k + 1] - spline.knots()[k]);
      ASSERT_NEAR(end.b, spline.begin_of(k + 1).b, 1e-12);
      ASSERT_NEAR(end.db, spline.begin_of(k + 1).db, 1e-12);
    }
  }
}

}  // namespace
}  // namespace beeline::internal
