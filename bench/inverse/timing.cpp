#include "timing.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string>

#include <beeline/error.h>

#include <sched.h>

namespace beeline::bench {

int stay_on_one_core() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  sched_getaffinity(0, sizeof allowed, &allowed);
  int core = 0;
  for (int i = 0; i < CPU_SETSIZE; ++i) {
    if (CPU_ISSET(i, &allowed)) core = i;
  }
  if (const char* wanted = std::getenv("BENCH_CORE")) core = std::atoi(wanted);
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<unsigned>(core), &one);
  if (sched_setaffinity(0, sizeof one, &one) != 0) {
    throw Error("cannot run on core " + std::to_string(core) + " (BENCH_CORE)");
  }
  return core;
}

double microseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start)
      .count();
}

double cpu_microseconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

double clock_cost() {
  std::vector<double> costs;
  for (int i = 0; i < 1001; ++i) {
    costs.push_back(microseconds_since(std::chrono::steady_clock::now()));
  }
  std::nth_element(costs.begin(), costs.begin() + 500, costs.end());
  return costs[500];
}

Timing timing_of(std::vector<double> passes, std::vector<double> calls) {
  if (passes.empty() || calls.empty()) return {};
  std::sort(passes.begin(), passes.end());
  std::sort(calls.begin(), calls.end());
  const auto at = [&calls](double share) {
    return calls[static_cast<std::size_t>(share * static_cast<double>(calls.size() - 1))];
  };
  return {.mean = passes[passes.size() / 2],
          .median = at(0.5),
          .p99 = at(0.99),
          .p999 = at(0.999),
          .max = calls.back()};
}

}  // namespace beeline::bench
