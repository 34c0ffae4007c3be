#include <beeline/io/text/urdf.h>
#include <beeline/model/catalog.h>

#include <tests/fuzz/target.h>

BEELINE_FUZZ_TARGET(srdf) {
  using namespace beeline;
  fuzz::may_refuse([&] {
    const Srdf read = srdf_from_text(input, "fuzzed.srdf");
    const Arm arm = built_in("rrr");
    fuzz::may_refuse([&] { named_state(read, arm, "home"); });
  });
}
