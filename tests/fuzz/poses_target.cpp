#include <beeline/io/text/pose_list.h>

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
  for (const std::string& form : pose_form_names()) {
    fuzz::may_refuse([&] {
      const PoseFormat format{.pose_form = pose_form_named(form), .millimetres = true};
      pose_numbers(checked_pose(parse_pose(input, format).pose), format);
    });
  }
}
