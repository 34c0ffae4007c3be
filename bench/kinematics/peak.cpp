// Measures the peak rate of fused multiply-adds of one core, to compare counted operations with.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/kinematics/peak.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

namespace lanes = hwy::HWY_NAMESPACE;

/// Runs multiply-adds in `chains` independent chains; returns their number. Adds a result to `sum`,
/// so that the compiler keeps them.
double multiply_add(int rounds, double& sum) {
  constexpr int chains = 12;
  const lanes::ScalableTag<double> tag;
  lanes::Vec<decltype(tag)> sums[chains];
  for (int i = 0; i < chains; ++i) sums[i] = lanes::Set(tag, 1e-3 * i);
  const auto a = lanes::Set(tag, 0.999), b = lanes::Set(tag, 1e-3);
  for (int round = 0; round < rounds; ++round) {
#pragma GCC unroll 12
    for (int i = 0; i < chains; ++i) sums[i] = lanes::MulAdd(sums[i], a, b);
  }
  for (const auto& each : sums) sum += lanes::GetLane(each);
  return 1.0 * chains * rounds * static_cast<double>(lanes::Lanes(tag));
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
    const double count = HWY_DYNAMIC_DISPATCH(multiply_add)(rounds, sum);
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    rates.push_back(2 * count / time.count());
  }
  std::nth_element(rates.begin(), rates.begin() + 4, rates.end());
  std::printf("Peak of fused multiply-adds on one core: %.1f GFLOP/s%s\n", rates[4],
              sum == 0.123 ? "." : "");
  return 0;
}
#endif
