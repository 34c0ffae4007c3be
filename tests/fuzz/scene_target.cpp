#include <beeline/io/text/scene.h>

#include <tests/fuzz/target.h>

// A scene that is read and written again reads back.
BEELINE_FUZZ_TARGET(scene) {
  using namespace beeline;
  fuzz::may_refuse([&] {
    const Scene scene = scene_from_json(input, "fuzzed.json");
    const Scene again = scene_from_json(scene_to_json(scene), "written.json");
    fuzz::require(again.obstacles.size() == scene.obstacles.size(), "the same obstacles");
  });
}
