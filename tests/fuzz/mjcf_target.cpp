#include <beeline/collision/collision_model.h>
#include <beeline/io/text/scene.h>

#include <tests/fuzz/target.h>

// An MJCF file that is read is an arm that JSON can describe, and its shapes are on its links. As a
// cell it is a scene that JSON can describe.
BEELINE_FUZZ_TARGET(mjcf) {
  using namespace beeline;
  fuzz::may_refuse([&] {
    const Arm arm = arm_from_text(input, "fuzzed.mjcf");
    fuzz::may_refuse([&] { arm_from_json(arm_to_json(arm), "written.json"); });
    const ArmShapes shapes = arm_shapes_from_text(input, "fuzzed.mjcf");
    CollisionModel(arm, shapes.links, {}, {.budget = {.max_work = 10}});
  });
  fuzz::may_refuse([&] {
    const Scene scene = scene_from_text(input, "fuzzed.mjcf");
    fuzz::may_refuse([&] { scene_from_json(scene_to_json(scene), "written.json"); });
  });
}
