#include <beeline/io/text/arm.h>

#include <tests/fuzz/target.h>

// A URDF file that is read is an arm that JSON can describe.
BEELINE_FUZZ_TARGET(urdf) {
  using namespace beeline;
  fuzz::may_refuse([&] {
    const Arm arm = arm_from_text(input, "fuzzed.urdf");
    fuzz::may_refuse([&] { arm_from_json(arm_to_json(arm), "written.json"); });
  });
}
