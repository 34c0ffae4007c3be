#include <beeline/record/trajectory_file.h>
#include <beeline/trajectory/trajectory.h>

#include <tests/fuzz/target.h>

// The first byte selects the format.
BEELINE_FUZZ_TARGET(trajectory) {
  using namespace beeline;
  if (input.empty()) return;
  const char* path = input.front() % 2 == 0 ? "fuzzed.csv" : "fuzzed.json";
  fuzz::may_refuse([&] {
    const Trajectory read = parse_trajectory(input.substr(1), path);
    for (const Configuration& q : read.positions) fuzz::require(q.allFinite(), "finite positions");
  });
}
