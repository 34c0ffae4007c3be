#include <beeline/io/text/arm.h>
#include <beeline/model/catalog.h>

#include <tests/fuzz/target.h>

// The first byte selects the format.
BEELINE_FUZZ_TARGET(joint_limits) {
  using namespace beeline;
  if (input.empty()) return;
  const char* path = input.front() % 2 == 0 ? "fuzzed.yaml" : "fuzzed.json";
  fuzz::may_refuse([&] { joint_limits_from_text(input.substr(1), path, built_in("rrr")); });
}
