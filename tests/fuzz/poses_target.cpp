#include <beeline/read/pose_list.h>

#include <tests/fuzz/target.h>

BEELINE_FUZZ_TARGET(poses) {
  using namespace beeline;
  fuzz::may_refuse([&] {
    for (const Pose& pose : poses_from_csv(input, "fuzzed.csv").poses) {
      fuzz::require(pose.matrix().allFinite(), "finite poses");
    }
  });
  fuzz::may_refuse([&] {
    if (is_program(input)) program_rows_from_csv(input, "fuzzed.csv");
  });
  fuzz::may_refuse([&] { parse_pose(input); });
}
