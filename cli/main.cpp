#include <cstdint>

#include "command/program.h"
#include "verbs.h"

// Highway's library measures the resolution of the clock for its benchmarks whenever it is loaded,
// which takes 3 ms, a quarter of a short command. It calls this function instead of its own.
namespace hwy::platform {
std::uint64_t TimerResolution();  // NOLINT(readability-identifier-naming)
std::uint64_t TimerResolution() { return 1; }
}  // namespace hwy::platform

int main(int argc, char** argv) {
  return beeline::command::run_program(beeline::command::all_verbs(), argc, argv);
}
