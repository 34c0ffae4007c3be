#include <gtest/gtest.h>

#include <beeline/error.h>
#include <beeline/path/joint_path.h>

#include <tests/path/random_joint_path.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

Configuration one(double value) { return Configuration::Constant(1, value); }

TEST(Spline, IsExactForCubicsWhateverTheParameters) {
  testing::Random random;
  const auto cubic = [](double s) { return 1 + s * (-2 + s * (0.5 + 3 * s)); };
  for (int i = 0; i < 100; ++i) {
    std::vector<double> s{random.uniform(-1, 1)};
    for (int k = random.integer(3, 9); k > 0; --k) s.push_back(s.back() + random.uniform(0.01, 1));
    std::vector<Configuration> samples;
    for (const double at : s) samples.push_back(one(cubic(at)));
    const JointPath path = joint_spline(samples, s);
    for (std::size_t k = 0; k < s.size(); ++k) {
      ASSERT_EQ(path.q[k], samples[k]);
      ASSERT_NEAR(path.dq[k][0], -2 + s[k] * (1 + 9 * s[k]), 1e-8 * (1 + s[k] * s[k]));
      ASSERT_NEAR(path.ddq[k][0], 1 + 18 * s[k], 1e-7 * (1 + s[k] * s[k]));
    }
  }
}

TEST(SmoothDerivatives, ReproduceAQuinticFromItsValuesAndEnds) {
  testing::Random random;
  for (int i = 0; i < 100; ++i) {
    Eigen::Matrix<double, 6, 1> c;
    for (double& value : c) value = random.uniform(-2, 2);
    const auto at = [&](double s, int order) {
      double sum = 0;
      for (int k = 5; k >= order; --k) {
        double factor = c[k];
        for (int j = 0; j < order; ++j) factor *= k - j;
        sum = sum * s + factor;
      }
      return sum;
    };
    JointPath path;
    double s = random.uniform(-1, 0);
    for (int k = random.integer(2, 9); k >= 0; --k, s += random.uniform(0.05, 0.4)) {
      path.s.push_back(s);
      path.q.push_back(one(at(s, 0)));
      path.dq.push_back(one(at(s, 1) + 1));  // wrong inside
      path.ddq.push_back(one(at(s, 2) - 1));
    }
    for (auto* end : {&path.s.front(), &path.s.back()}) {
      const auto k = static_cast<std::size_t>(end - path.s.data());
      path.dq[k] = one(at(*end, 1));
      path.ddq[k] = one(at(*end, 2));
    }
    smooth_derivatives(path);
    for (std::size_t k = 0; k < path.size(); ++k) {
      ASSERT_NEAR(path.dq[k][0], at(path.s[k], 1), 1e-10);
      ASSERT_NEAR(path.ddq[k][0], at(path.s[k], 2), 1e-8);
    }
  }
}

TEST(SmoothDerivatives, MakeTheThirdAndFourthContinuousAndKeepTheEnds) {
  testing::Random random;
  for (int i = 0; i < 100; ++i) {
    const auto samples = testing::random_waypoints(random, 3, random.integer(2, 12));
    const JointPath cubic = joint_spline(samples, chord_length(samples));
    JointPath path = cubic;
    smooth_derivatives(path);
    EXPECT_EQ(path.dq.front(), cubic.dq.front());
    EXPECT_EQ(path.ddq.back(), cubic.ddq.back());
    for (std::size_t k = 1; k + 1 < path.size(); ++k) {
      const PathPoint end = path_point(path, k - 1, 1), begin = path_point(path, k, 0);
      ASSERT_LT((end.dddq - begin.dddq).norm(), 1e-8 * (1 + begin.dddq.norm()));
      const double h = 1e-5;  // of a step
      const Configuration before =
          (end.dddq - path_point(path, k - 1, 1 - h).dddq) / (h * (path.s[k] - path.s[k - 1]));
      const Configuration after =
          (path_point(path, k, h).dddq - begin.dddq) / (h * (path.s[k + 1] - path.s[k]));
      ASSERT_LT((before - after).norm(), 1e-2 * (1 + after.norm() + before.norm()));
    }
  }
}

TEST(Spline, OfThreeSamplesIsAParabolaOfTwoALine) {
  const std::vector<double> s{0, 1, 3};
  const std::vector<Configuration> samples{one(0), one(1), one(9)};  // s^2
  const JointPath parabola = joint_spline(samples, s);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(parabola.dq[k][0], 2 * s[k], 1e-14);
    EXPECT_NEAR(parabola.ddq[k][0], 2, 1e-14);
  }
  const JointPath line = joint_spline(std::span(samples).first(2), std::span(s).first(2));
  EXPECT_EQ(line.dq[0][0], 1);
  EXPECT_EQ(line.ddq[1][0], 0);
}

TEST(Spline, DerivativesAgreeFromBothSidesOfEverySample) {
  testing::Random random;
  for (int i = 0; i < 100; ++i) {
    const auto samples = testing::random_waypoints(random, 3, random.integer(4, 12));
    const JointPath path = joint_spline(samples, chord_length(samples));
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      // The quintic between the samples is the cubic: its third derivative is the same everywhere.
      const PathPoint begin = path_point(path, k, 0), end = path_point(path, k, 1);
      ASSERT_LT((begin.dddq - end.dddq).norm(), 1e-8 * (1 + begin.dddq.norm()));
      ASSERT_LT((end.q - path.q[k + 1]).norm(), 1e-12);
      ASSERT_LT((end.dq - path.dq[k + 1]).norm(), 1e-11 * (1 + end.dq.norm()));
      ASSERT_LT((end.ddq - path.ddq[k + 1]).norm(), 1e-9 * (1 + end.ddq.norm()));
    }
    // Not-a-knot.
    const auto third = [&](std::size_t k) { return path_point(path, k, 0.5).dddq; };
    ASSERT_LT((third(0) - third(1)).norm(), 1e-8 * (1 + third(0).norm()));
    const std::size_t last = path.size() - 2;
    ASSERT_LT((third(last) - third(last - 1)).norm(), 1e-8 * (1 + third(last).norm()));
  }
}

TEST(Spline, RefusesSamplesThatDoNotFit) {
  const std::vector<Configuration> samples{one(0), one(1)};
  EXPECT_REFUSED(joint_spline(samples, std::vector<double>{0, 0}), "does not increase");
  EXPECT_REFUSED(joint_spline(samples, std::vector<double>{0, 1, 2}), "3 grid points has 2");
  EXPECT_REFUSED(joint_spline({}, {}), "two grid points");
}

TEST(JointPath, RefinedKeepsItsGridPointsAndItsShape) {
  testing::Random random;
  for (int i = 0; i < 50; ++i) {
    const auto samples = testing::random_waypoints(random, 2, random.integer(2, 9));
    const JointPath path = joint_spline(samples, chord_length(samples));
    const JointPath fine = refined(path, {.min_steps = 50});
    ASSERT_GE(fine.size(), 51u);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < fine.size(); ++k) {
      while (kept < path.size() && path.s[kept] < fine.s[k]) FAIL() << "lost grid point " << kept;
      if (kept < path.size() && path.s[kept] == fine.s[k]) {
        ASSERT_EQ(fine.q[k], path.q[kept++]);
      }
    }
    ASSERT_EQ(kept, path.size());
    for (std::size_t k = 0; k + 1 < fine.size(); ++k) {
      const double h = fine.s[k + 1] - fine.s[k];
      ASSERT_LE(h, path.s.back() / 50 * (1 + 1e-9));
      ASSERT_LT((fine.q[k + 1] - fine.q[k] - h * path_point(fine, k, 0.5).dq).norm(), 1e-3);
    }
  }
}

TEST(JointPath, RefinedDividesStepsThatCurveInTheirMiddleOnly) {
  const Configuration x = Eigen::Vector2d(1, 0), y = Eigen::Vector2d(0, 1), none = 0 * x;
  const JointPath corner{{0, 1}, {-0.5 * x, 0.5 * y}, {x, y}, {none, none}};
  const JointPath fine = refined(corner, {.min_steps = 1, .max_change = 0.1});
  EXPECT_GE(fine.size(), 15u);
  for (std::size_t k = 0; k + 1 < fine.size(); ++k) {
    EXPECT_LE((fine.dq[k + 1] - fine.dq[k]).norm(), 0.15);
  }
}

TEST(JointPath, RefinedIsEmptyWhereTheBudgetEndsIt) {
  const std::vector<Configuration> samples{Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 2)};
  const JointPath path = joint_spline(samples, std::vector<double>{0, 1});
  const JointPath whole = refined(path);
  std::vector<double> reported;
  const JointPath same = refined(
      path, {.budget = {.max_work = 1000,
                        .progress = [&](double fraction) { reported.push_back(fraction); }}});
  EXPECT_EQ(same.s, whole.s);
  EXPECT_EQ(reported, (std::vector<double>{0, 1}));
  EXPECT_EQ(refined(path, {.budget = {.max_work = 100}}).size(), 0u);
  EXPECT_REFUSED(refined(path, {.min_steps = 20'000'000, .max_parts = 100'000'000}),
                 "at most 1e+07 are possible");
}

}  // namespace
}  // namespace beeline
