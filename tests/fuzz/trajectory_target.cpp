#include <beeline/io/trajectory_file.h>
#include <beeline/model/catalog.h>
#include <beeline/trajectory/trajectory.h>

#include <tests/fuzz/target.h>

// The first byte selects the format, and whether an arm reads a recording.
BEELINE_FUZZ_TARGET(trajectory) {
  using namespace beeline;
  if (input.empty()) return;
  static const Arm arm = built_in("ur5e");
  const unsigned selected = static_cast<unsigned char>(input.front());
  const char* const paths[] = {"fuzzed.csv", "fuzzed.json", "fuzzed.yaml"};
  const char* path = paths[selected % 3];
  const auto text = input.substr(1);
  fuzz::may_refuse([&] {
    const Trajectory read = parse_trajectory(text, path);
    for (const Configuration& q : read.positions) fuzz::require(q.allFinite(), "finite positions");
  });
  fuzz::may_refuse([&] {
    RecordingOptions options{.needs_times = selected % 2 == 0};
    const Recording read = parse_recording(text, path, arm, options);
    const Unwrapped turned = unwrapped(arm, read.trajectory);
    for (const Configuration& q : turned.trajectory.positions) {
      fuzz::require(q.size() == arm.dof() && q.allFinite(), "finite positions of the arm");
    }
  });
}
