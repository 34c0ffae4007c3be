#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/timing/point_to_point.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

constexpr double none = Limits::none;

double log_uniform(testing::Random& random, double lower, double upper) {
  return std::exp(random.uniform(std::log(lower), std::log(upper)));
}

/// Limits of any size; a quarter of them infinite, but never all three.
Limits random_limits(testing::Random& random, double lower, double upper) {
  Limits limits;
  do {
    for (double* limit : {&limits.velocity, &limits.acceleration, &limits.jerk}) {
      *limit = random.integer(0, 3) == 0 ? none : log_uniform(random, lower, upper);
    }
  } while (std::min({limits.velocity, limits.acceleration, limits.jerk}) == none);
  return limits;
}

std::string text(double d, const Limits& limits) {
  std::ostringstream out;
  out.precision(17);
  out << "d " << d << " v " << limits.velocity << " a " << limits.acceleration << " j "
      << limits.jerk;
  return out.str();
}

/// The optimum by another way: the velocity reached is sought by bisection, in long double. A ramp
/// to velocity u takes u / a + a / j, or 2 sqrt(u / j) where the acceleration stays below its
/// limit, and covers u / 2 times that, as it is symmetric.
long double searched_duration(long double d, const Limits& limits) {
  const long double v = limits.velocity, a = limits.acceleration, j = limits.jerk;
  const auto ramp = [&](long double u) -> long double {
    if (std::isinf(j)) return std::isinf(a) ? 0 : u / a;
    if (std::isinf(a) || u / a < a / j) return 2 * std::sqrt(u / j);
    return u / a + a / j;
  };
  long double low = 0, high = 1;
  if (std::isinf(v)) {
    while (high * ramp(high) < d) high *= 2;
  } else {
    if (v * ramp(v) <= d) return ramp(v) + d / v;
    high = v;
  }
  for (int i = 0; i < 400; ++i) {
    const long double middle = (low + high) / 2;
    (middle * ramp(middle) < d ? low : high) = middle;
  }
  return 2 * ramp(high);
}

TEST(SCurve, HasTheTextbooksDurations) {
  EXPECT_EQ(s_curve(0, {}).duration, 0);
  EXPECT_EQ(s_curve(3, {.velocity = 2}).duration, 1.5);
  EXPECT_EQ(s_curve(4, {.acceleration = 1}).duration, 4);                  // 2 sqrt(d / a)
  EXPECT_EQ(s_curve(16, {.jerk = 1}).duration, 8);                         // 4 cbrt(d / 2 j)
  EXPECT_EQ(s_curve(10, {.velocity = 2, .acceleration = 1}).duration, 7);  // d / v + v / a
  const SCurve all = s_curve(-20, {.velocity = 3, .acceleration = 2, .jerk = 4});
  EXPECT_NEAR(all.duration, 20.0 / 3 + 3.0 / 2 + 2.0 / 4, 1e-14);  // d / v + v / a + a / j
  EXPECT_EQ(all.jerk_time, 0.5);
  EXPECT_EQ(all.acceleration_time, 1);
  EXPECT_EQ(all.velocity, -3);
  EXPECT_EQ(all.acceleration, -2);
  EXPECT_EQ(all.jerk, -4);
}

TEST(SCurve, DurationsAreTheOptimumFoundBySearchAtAnyMagnitude) {
  testing::Random random;
  for (int i = 0; i < 20000; ++i) {
    const double d = log_uniform(random, 1e-12, 1e6);
    const Limits limits = random_limits(random, 1e-3, 1e6);
    const SCurve curve = s_curve(d, limits);
    const auto expected = static_cast<double>(searched_duration(d, limits));
    ASSERT_NEAR(curve.duration / expected, 1, 1e-13) << text(d, limits);
    const double sum = 4 * curve.jerk_time + 2 * curve.acceleration_time + curve.cruise_time;
    ASSERT_NEAR(sum / curve.duration, 1, 1e-14);
  }
}

/// Limits kept at every sample and between them, and each state the last one carried on.
void expect_motion(const SCurve& curve, const Limits& limits, int samples,
                   const std::string& what) {
  const double slack = 1 + 1e-12;
  const double size = std::abs(curve.distance);
  JointState last = at(curve, 0);
  for (int k = 1; k <= samples; ++k) {
    const double before = curve.duration * (k - 1) / samples, t = curve.duration * k / samples;
    const double h = t - before;
    const JointState state = at(curve, t);
    ASSERT_LE(std::abs(state.velocity), limits.velocity * slack) << what;
    ASSERT_LE(std::abs(state.acceleration), limits.acceleration * slack) << what;
    ASSERT_LE(std::abs(state.jerk), limits.jerk * slack) << what;
    // Rounding: of the time, by which all else goes.
    const double grain = 1e-12;
    ASSERT_LE(std::abs(state.position - last.position),
              std::abs(curve.velocity) * h * slack + grain * size)
        << what;
    ASSERT_LE(std::abs(state.velocity - last.velocity),
              std::abs(curve.acceleration) * h * slack + grain * std::abs(curve.velocity))
        << what;
    ASSERT_LE(std::abs(state.acceleration - last.acceleration),
              std::abs(curve.jerk) * h * slack + grain * std::abs(curve.acceleration))
        << what << " at " << t;
    ASSERT_GE((state.position - last.position) * curve.distance, -grain * size * size) << what;
    const bool one_phase = state.jerk == last.jerk && k > 1 && k < samples &&
                           state.acceleration * last.acceleration >= 0 &&
                           (state.jerk != 0 || state.acceleration == last.acceleration);
    if (one_phase) {
      ASSERT_NEAR(state.acceleration, last.acceleration + last.jerk * h,
                  grain * std::abs(curve.acceleration));
      ASSERT_NEAR(state.velocity, last.velocity + h * (last.acceleration + h * last.jerk / 2),
                  grain * std::abs(curve.velocity))
          << what;
      ASSERT_NEAR(
          state.position,
          last.position + h * (last.velocity + h * (last.acceleration / 2 + h * last.jerk / 6)),
          grain * size)
          << what;
    }
    last = state;
  }
}

TEST(SCurve, KeepsItsLimitsAndMovesAsItsDerivativesSay) {
  testing::Random random;
  for (int i = 0; i < 3000; ++i) {
    const bool extreme = i % 2 == 0;
    const double d = log_uniform(random, extreme ? 1e-12 : 0.01, extreme ? 1e6 : 10);
    const Limits limits =
        extreme ? random_limits(random, 1e-3, 1e6) : random_limits(random, 0.1, 10);
    const SCurve curve = s_curve(d, limits);
    ASSERT_NO_FATAL_FAILURE(expect_motion(curve, limits, 300, text(d, limits)));
    const SCurve slow = stretched(curve, curve.duration * random.uniform(1, 10));
    ASSERT_NO_FATAL_FAILURE(expect_motion(slow, limits, 100, text(d, limits)));
  }
}

TEST(SCurve, ItsPhasesIntegratedOneByOneAreItsStatesAndItsDistance) {
  testing::Random random;
  for (int i = 0; i < 5000; ++i) {
    const double d = log_uniform(random, 0.01, 100);
    const Limits limits{.velocity = log_uniform(random, 0.1, 10),
                        .acceleration = log_uniform(random, 0.1, 10),
                        .jerk = log_uniform(random, 0.1, 10)};
    const SCurve curve = s_curve(d, limits);
    const double tj = curve.jerk_time, ta = curve.acceleration_time, tv = curve.cruise_time;
    double t = 0, q = 0, v = 0, a = 0;
    for (const auto& [sign, h] :
         {std::pair{1, tj}, {0, ta}, {-1, tj}, {0, tv}, {-1, tj}, {0, ta}, {1, tj}}) {
      const double j = sign * curve.jerk;
      q += h * (v + h * (a / 2 + h * j / 6));
      v += h * (a + h * j / 2);
      a += h * j;
      t += h;
      ASSERT_NEAR(at(curve, t).position, q, 1e-12 * d) << text(d, limits);
      ASSERT_NEAR(at(curve, t).velocity, v, 1e-12 * curve.velocity) << text(d, limits);
      ASSERT_NEAR(at(curve, t).acceleration, a, 1e-11 * curve.acceleration) << text(d, limits);
    }
    ASSERT_NEAR(q, d, 1e-12 * d) << text(d, limits);
  }
}

TEST(SCurve, BeginsAndEndsExactlyAtRestAndIsTheSameFromBothEnds) {
  testing::Random random;
  for (int i = 0; i < 5000; ++i) {
    const double d = log_uniform(random, 1e-12, 1e6);
    const Limits limits = random_limits(random, 1e-3, 1e6);
    const SCurve curve = s_curve(d, limits), back = s_curve(-d, limits);
    for (const double t : {0.0, -1.0, -none}) {
      ASSERT_EQ(at(curve, t).position, 0);
      ASSERT_EQ(at(curve, t).velocity, 0);
      ASSERT_EQ(at(curve, t).acceleration, 0);
    }
    for (const double t : {curve.duration, curve.duration + 1, none}) {
      ASSERT_EQ(at(curve, t).position, d);
      ASSERT_EQ(at(curve, t).velocity, 0);
      ASSERT_EQ(at(curve, t).acceleration, 0);
    }
    // A hair before the end it is there except for what the hair takes.
    const double eve = curve.duration * (1 - 1e-9);
    ASSERT_NEAR(at(curve, eve).position, d, 2e-9 * std::abs(curve.velocity) * curve.duration);
    ASSERT_EQ(back.duration, curve.duration);
    const double t = curve.duration * random.uniform(0, 1);
    const JointState there = at(curve, t), mirrored = at(back, t),
                     other = at(curve, curve.duration - t);
    ASSERT_EQ(mirrored.position, -there.position);
    ASSERT_EQ(mirrored.velocity, -there.velocity);
    ASSERT_EQ(mirrored.acceleration, -there.acceleration);
    ASSERT_NEAR(there.position + other.position, d, 1e-12 * d);
    ASSERT_NEAR(at(curve, curve.duration / 2).position, d / 2, 1e-14 * d);
  }
}

TEST(SCurve, IsNoSlowerWithWiderLimitsOrAShorterWay) {
  testing::Random random;
  for (int i = 0; i < 20000; ++i) {
    const double d = log_uniform(random, 1e-6, 1e3);
    const Limits limits = random_limits(random, 1e-2, 1e3);
    const double wider = 1 + log_uniform(random, 1e-9, 10);
    const double most = s_curve(d, limits).duration * (1 + 1e-14);
    for (double Limits::*kind : {&Limits::velocity, &Limits::acceleration, &Limits::jerk}) {
      Limits wide = limits;
      wide.*kind *= wider;
      ASSERT_LE(s_curve(d, wide).duration, most) << text(d, limits) << " times " << wider;
    }
    ASSERT_LE(s_curve(d / wider, limits).duration, most) << text(d, limits);
  }
}

TEST(SCurve, ScalesWithTheUnitsOfTimeAndLength) {
  testing::Random random;
  for (int i = 0; i < 5000; ++i) {
    const double d = log_uniform(random, 1e-3, 1e3);
    const Limits limits = random_limits(random, 1e-2, 1e3);
    const double k = log_uniform(random, 1e-3, 1e3);
    const SCurve curve = s_curve(d, limits);
    const SCurve slow = s_curve(d, {.velocity = limits.velocity / k,
                                    .acceleration = limits.acceleration / (k * k),
                                    .jerk = limits.jerk / (k * k * k)});
    ASSERT_NEAR(slow.duration / curve.duration / k, 1, 1e-13) << text(d, limits) << " " << k;
    const SCurve large = s_curve(k * d, {.velocity = limits.velocity * k,
                                         .acceleration = limits.acceleration * k,
                                         .jerk = limits.jerk * k});
    ASSERT_NEAR(large.duration / curve.duration, 1, 1e-13) << text(d, limits) << " " << k;
    const double fraction = random.uniform(0, 1);
    const SCurve longer = stretched(curve, 3 * curve.duration);
    ASSERT_EQ(longer.duration, 3 * curve.duration);
    const JointState quick = at(curve, fraction * curve.duration),
                     late = at(longer, fraction * longer.duration);
    ASSERT_NEAR(late.position, quick.position, 1e-12 * d);
    ASSERT_NEAR(late.velocity * 3, quick.velocity, 1e-12 * std::abs(curve.velocity));
  }
}

TEST(SCurve, IsFiniteForTheSmallestAndLargestNumbers) {
  for (const double d : {5e-324, 1e-310, 1e-200, 1e150, -1e150}) {
    for (const double rate : {1e-100, 1.0, 1e100, 1e300, none}) {
      for (const double jerk : {1e-100, 1.0, 1e100, none}) {
        if (rate == none && jerk == none) continue;
        const Limits limits{.velocity = rate, .acceleration = rate, .jerk = jerk};
        const SCurve curve = s_curve(d, limits);
        ASSERT_TRUE(std::isfinite(curve.duration) && curve.duration >= 0) << text(d, limits);
        for (const double fraction : {0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0}) {
          const JointState state = at(curve, fraction * curve.duration);
          ASSERT_TRUE(std::isfinite(state.position)) << text(d, limits) << " " << fraction;
          ASSERT_TRUE(std::isfinite(state.velocity)) << text(d, limits) << " " << fraction;
        }
      }
    }
  }
  EXPECT_REFUSED(s_curve(1e300, {.velocity = 1e-300}), "longer than a double");
}

TEST(SCurve, RefusesWhatIsNoMotion) {
  EXPECT_REFUSED(s_curve(NAN, {.velocity = 1}), "finite");
  EXPECT_REFUSED(s_curve(none, {.velocity = 1}), "finite");
  EXPECT_REFUSED(s_curve(1, {}), "all three are infinite");
  EXPECT_REFUSED(s_curve(0, {.velocity = 0}), "above zero");
  EXPECT_REFUSED(s_curve(1, {.acceleration = -1}), "above zero");
  EXPECT_REFUSED(s_curve(1, {.jerk = NAN}), "above zero");
  const SCurve curve = s_curve(1, {.velocity = 1});
  EXPECT_REFUSED(stretched(curve, 0.5), "stretched");
  EXPECT_REFUSED(stretched(curve, NAN), "stretched");
  EXPECT_REFUSED(stretched(curve, none), "stretched");
  EXPECT_REFUSED(at(curve, NAN), "NaN");
}

}  // namespace
}  // namespace beeline
