#include <beeline/io/text/arm.h>

#include <tests/fuzz/target.h>

BEELINE_FUZZ_TARGET(joint_string) {
  using namespace beeline;
  fuzz::may_refuse([&] {
    if (input.size() > 2000) return;
    const Arm arm = arm_from_joint_string(input);
    fuzz::require(arm.name() == input.substr(0, 1000), "the name is the string");
  });
}
