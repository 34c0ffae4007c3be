#include <beeline/collision/collision_model.h>
#include <beeline/io/text/scene.h>

#include <tests/fuzz/target.h>

// A URDF file that is read is an arm that JSON can describe, and its shapes are on its links.
BEELINE_FUZZ_TARGET(urdf) {
  using namespace beeline;
  fuzz::may_refuse([&] {
    const Arm arm = arm_from_text(input, "fuzzed.urdf");
    fuzz::may_refuse([&] { arm_from_json(arm_to_json(arm), "written.json"); });
    const ArmShapes shapes = arm_shapes_from_text(input, "fuzzed.urdf");
    CollisionModel(arm, shapes.links, {}, {.budget = {.max_work = 10}});
  });
}
