#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

namespace beeline::bench {

/// Microseconds for each call, over the poses.
struct Timing {
  double mean = 0;
  double median = 0;
  double p99 = 0;   ///< 99 of 100 calls take less
  double p999 = 0;  ///< 999 of 1000 calls take less
  double max = 0;
};

/// Pins this process to one core (BENCH_CORE, otherwise the last one allowed) and returns it.
int stay_on_one_core();

/// Returns the duration of two clock readings, microseconds.
double clock_cost();

double microseconds_since(std::chrono::steady_clock::time_point start);

/// CPU time of the process, microseconds: other programs on the machine do not lengthen it.
double cpu_microseconds();

/// `passes`: the mean of each pass, timed as a whole. `calls`: the shortest call of each pose.
Timing timing_of(std::vector<double> passes, std::vector<double> calls);

/// Times solve(0) ... solve(count - 1). The mean is taken from the median pass, the CPU time of
/// each pass measured as a whole. The percentiles come from passes with each call timed, minus the
/// cost of the clock; the time of a pose is its shortest of all passes, so that the tail shows hard
/// poses and not interruptions. A solver that takes more than a few seconds for each pass gets one
/// pass of each.
template <class Solve>
Timing timed(int count, int passes, Solve solve) {
  constexpr double patience = 5e6;  // microseconds
  const double cost = clock_cost();
  std::vector<double> means, calls(static_cast<std::size_t>(count), 1e300);
  for (int pass = 0; pass < passes; ++pass) {
    const double start = cpu_microseconds();
    for (int i = 0; i < count; ++i) solve(i);
    const double whole = cpu_microseconds() - start;
    means.push_back(whole / count);
    for (int i = 0; i < count; ++i) {
      const auto begin = std::chrono::steady_clock::now();
      solve(i);
      double& best = calls[i];
      best = std::min(best, std::max(0.0, microseconds_since(begin) - cost));
    }
    if (whole > patience) break;
  }
  return timing_of(means, calls);
}

}  // namespace beeline::bench
