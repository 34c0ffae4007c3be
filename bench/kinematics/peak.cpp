// Measures the peak rate of fused multiply-adds of one core, to compare counted operations with.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/kinematics/peak.cpp"
#include <hwy/foreach_target.h>

#include <beeline/simd/lanes-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

/// Runs multiply-adds in `chains` independent chains; returns their sum, so that the compiler keeps
/// them.
double multiply_add(int rounds) {
  constexpr int chains = 12;
  Lanes sum[chains];
  for (int i = 0; i < chains; ++i) sum[i] = Lanes(1e-3 * i);
  const Lanes a(0.999), b(1e-3);
  for (int round = 0; round < rounds; ++round) {
#pragma GCC unroll 12
    for (int i = 0; i < chains; ++i) sum[i] = fma(sum[i], a, b);
  }
  double all = 0;
  for (const Lanes& each : sum) {
    double eight[lane_count];
    each.store(eight);
    all += eight[0];
  }
  return all;
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace beeline {
HWY_EXPORT(multiply_add);
}

int main() {
  using namespace beeline;
  constexpr int rounds = 2'000'000;
  std::vector<double> rates;
  double sum = 0;
  for (int pass = 0; pass < 9; ++pass) {
    const auto start = std::chrono::steady_clock::now();
    sum += HWY_DYNAMIC_DISPATCH(multiply_add)(rounds);
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    rates.push_back(2.0 * 8 * 12 * rounds / time.count());
  }
  std::nth_element(rates.begin(), rates.begin() + 4, rates.end());
  std::printf("Peak of fused multiply-adds on one core: %.1f GFLOP/s%s\n", rates[4],
              sum == 0.123 ? "." : "");
  return 0;
}
#endif
