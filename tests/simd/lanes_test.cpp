#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/simd/lanes_test.cpp"
#include <hwy/foreach_target.h>

#include <beeline/simd/trigonometry-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

void sines(const double* x, double* sine, double* cosine) {
  Lanes s, c;
  sine_cosine(Lanes::load(x), s, c);
  s.store(sine);
  c.store(cosine);
}

void arc_tangents(const double* y, const double* x, double* angle) {
  arc_tangent(Lanes::load(y), Lanes::load(x)).store(angle);
}

/// The results of each operation, one row of eight after the other.
void operations(const double* three_rows, double* out) {
  const Lanes a = Lanes::load(three_rows), b = Lanes::load(three_rows + lane_count),
              c = Lanes::load(three_rows + 2 * lane_count);
  Lanes added = a, taken = a, times = a;
  added += b;
  taken -= b;
  times *= b;
  const Lanes results[] = {a + b,
                           a - b,
                           a * b,
                           a / b,
                           -a,
                           fma(a, b, c),
                           fnma(a, b, c),
                           sqrt(abs(a)),
                           abs(a),
                           round(a),
                           floor(a),
                           ceil(a),
                           min(a, b),
                           max(a, b),
                           with_sign(a, b),
                           choose(a < b, a, b),
                           choose(a <= b, a, c),
                           choose(a > b, a, c),
                           choose(a >= b, a, c),
                           choose(a == b, b, c),
                           choose((a < b) & (b < c), a, b),
                           choose((a < b) | (b < c), a, b),
                           choose(!(a < b), a, b),
                           added,
                           taken,
                           times,
                           Lanes(3.5),
                           Lanes(smallest_of(a)),
                           Lanes(largest_of(a))};
  for (const Lanes& result : results) {
    result.store(out);
    out += lane_count;
  }
}

int64_t this_target() { return HWY_TARGET; }

unsigned bits_there_and_back(unsigned chosen) { return bits(mask_of(chosen)); }

}  // namespace
}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <hwy/targets.h>

#include <tests/random.h>

namespace beeline {

HWY_EXPORT(this_target);
HWY_EXPORT(sines);
HWY_EXPORT(arc_tangents);
HWY_EXPORT(operations);
HWY_EXPORT(bits_there_and_back);

namespace {

constexpr std::size_t eight = 8;
constexpr double ulp = 0x1p-53;  // of a number just below one

/// Runs on every instruction set that this machine has.
template <class Check>
void on_every_target(const Check& check) {
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    ASSERT_EQ(HWY_DYNAMIC_DISPATCH(this_target)(), target);
    check();
  }
  hwy::SetSupportedTargetsForTest(0);
}

/// Numbers of all sizes and signs, zeros among them.
double any(testing::Random& random, double smallest, double largest) {
  if (random.integer(0, 20) == 0) return random.integer(0, 1) == 0 ? 0.0 : -0.0;
  const double size = std::pow(10.0, random.uniform(smallest, largest));
  return random.integer(0, 1) == 0 ? size : -size;
}

TEST(Lanes, OperationsAreThoseOfTheScalars) {
  on_every_target([] {
    testing::Random random;
    for (int trial = 0; trial < 200; ++trial) {
      double in[3 * eight], out[29 * eight];
      for (double& x : in) x = trial % 2 == 0 ? any(random, -10, 10) : random.integer(-5, 5) / 2.0;
      HWY_DYNAMIC_DISPATCH(operations)(in, out);
      for (std::size_t lane = 0; lane < eight; ++lane) {
        const double a = in[lane], b = in[eight + lane], c = in[2 * eight + lane];
        const double product = std::abs(a * b) + std::abs(c);
        const double wanted[] = {a + b,
                                 a - b,
                                 a * b,
                                 a / b,
                                 -a,
                                 std::fma(a, b, c),
                                 std::fma(-a, b, c),
                                 std::sqrt(std::abs(a)),
                                 std::abs(a),
                                 std::nearbyint(a),
                                 std::floor(a),
                                 std::ceil(a),
                                 std::min(a, b),
                                 std::max(a, b),
                                 std::copysign(a, b),
                                 a < b ? a : b,
                                 a <= b ? a : c,
                                 a > b ? a : c,
                                 a >= b ? a : c,
                                 a == b ? b : c,
                                 a < b && b < c ? a : b,
                                 a < b || b < c ? a : b,
                                 !(a < b) ? a : b,
                                 a + b,
                                 a - b,
                                 a * b,
                                 3.5,
                                 *std::min_element(in, in + eight),
                                 *std::max_element(in, in + eight)};
        for (std::size_t i = 0; i < std::size(wanted); ++i) {
          const double seen = out[i * eight + lane];
          if (std::isnan(wanted[i])) {
            EXPECT_TRUE(std::isnan(seen)) << i;
          } else if (i == 5 || i == 6) {  // rounded once or twice
            EXPECT_NEAR(seen, wanted[i], 4 * ulp * product) << i;
          } else {
            EXPECT_EQ(seen, wanted[i]) << i << ": " << a << ' ' << b << ' ' << c;
          }
        }
      }
    }
  });
}

TEST(Lanes, MasksAreTheirBits) {
  on_every_target([] {
    for (unsigned chosen = 0; chosen < 256; ++chosen) {
      EXPECT_EQ(HWY_DYNAMIC_DISPATCH(bits_there_and_back)(chosen), chosen);
    }
  });
}

void expect_sines(const double (&x)[eight]) {
  double sine[eight], cosine[eight];
  HWY_DYNAMIC_DISPATCH(sines)(x, sine, cosine);
  for (std::size_t lane = 0; lane < eight; ++lane) {
    EXPECT_NEAR(sine[lane], std::sin(x[lane]), 2 * ulp) << x[lane];
    EXPECT_NEAR(cosine[lane], std::cos(x[lane]), 2 * ulp) << x[lane];
    // Near zero the error is relative to the sine.
    if (std::abs(x[lane]) < 0.5) {
      EXPECT_NEAR(sine[lane], std::sin(x[lane]), 2 * ulp * std::abs(x[lane]) * 2) << x[lane];
    }
    if (x[lane] != 0) {  // the sign of sin(-0) is not specified
      EXPECT_EQ(std::signbit(sine[lane]), std::signbit(std::sin(x[lane]))) << x[lane];
    }
  }
}

TEST(Trigonometry, SinesAreTheLibrarysAtEveryAngle) {
  on_every_target([] {
    testing::Random random;
    double x[eight];
    for (int trial = 0; trial < 20000; ++trial) {
      for (double& angle : x) {
        angle = trial % 2 == 0 ? random.uniform(-7, 7) : any(random, -300, 15);
      }
      expect_sines(x);
    }
  });
}

TEST(Trigonometry, SinesAreTheLibrarysNextToEveryQuarterTurn) {
  on_every_target([] {
    testing::Random random;
    double x[eight];
    for (int trial = 0; trial < 5000; ++trial) {
      for (double& angle : x) {
        angle = random.integer(-600000, 600000) * 1.57079632679489661923;
        if (trial % 3 != 0) angle = std::nextafter(angle, trial % 3 == 1 ? 1e9 : -1e9);
      }
      double sine[eight], cosine[eight];
      HWY_DYNAMIC_DISPATCH(sines)(x, sine, cosine);
      for (std::size_t lane = 0; lane < eight; ++lane) {
        EXPECT_NEAR(sine[lane], std::sin(x[lane]), 2 * ulp) << x[lane];
        EXPECT_NEAR(cosine[lane], std::cos(x[lane]), 2 * ulp) << x[lane];
      }
    }
  });
}

TEST(Trigonometry, SinesOfInfinityAndNanAreNan) {
  on_every_target([] {
    const double infinity = std::numeric_limits<double>::infinity();
    const double x[eight] = {infinity, -infinity, NAN, 1, -1, 1e300, 0.0, -0.0};
    double sine[eight], cosine[eight];
    HWY_DYNAMIC_DISPATCH(sines)(x, sine, cosine);
    for (std::size_t lane = 0; lane < 3; ++lane) {
      EXPECT_TRUE(std::isnan(sine[lane]) && std::isnan(cosine[lane])) << x[lane];
    }
    for (std::size_t lane = 3; lane < eight; ++lane) {
      EXPECT_NEAR(sine[lane], std::sin(x[lane]), 2 * ulp) << x[lane];
      EXPECT_NEAR(cosine[lane], std::cos(x[lane]), 2 * ulp) << x[lane];
    }
    EXPECT_EQ(sine[6], 0);
    EXPECT_EQ(sine[7], 0);
  });
}

TEST(Trigonometry, ArcTangentsAreTheLibrarysInAllQuadrants) {
  on_every_target([] {
    testing::Random random;
    for (int trial = 0; trial < 20000; ++trial) {
      double y[eight], x[eight], angle[eight];
      for (std::size_t lane = 0; lane < eight; ++lane) {
        y[lane] = trial % 2 == 0 ? random.uniform(-1, 1) : any(random, -150, 150);
        x[lane] = trial % 2 == 0 ? random.uniform(-1, 1) : any(random, -150, 150);
        if (x[lane] == 0) x[lane] = 0;  // the sign for x = -0 is not specified
      }
      HWY_DYNAMIC_DISPATCH(arc_tangents)(y, x, angle);
      for (std::size_t lane = 0; lane < eight; ++lane) {
        const double wanted = std::atan2(y[lane], x[lane]);
        EXPECT_NEAR(angle[lane], wanted, 5 * ulp * std::abs(wanted)) << y[lane] << ' ' << x[lane];
        EXPECT_EQ(std::signbit(angle[lane]), std::signbit(y[lane]));
      }
    }
  });
}

}  // namespace
}  // namespace beeline

#endif
