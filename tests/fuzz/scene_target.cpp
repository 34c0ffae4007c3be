#include <beeline/io/text/scene.h>

#include <tests/fuzz/target.h>

// A scene of each format that is read and written as JSON reads back.
BEELINE_FUZZ_TARGET(scene) {
  using namespace beeline;
  for (const char* path : {"fuzzed.json", "fuzzed.scene", "fuzzed.yaml"}) {
    fuzz::may_refuse([&] {
      const Scene scene = scene_from_text(input, path);
      const Scene again = scene_from_json(scene_to_json(scene), "written.json");
      fuzz::require(again.obstacles.size() == scene.obstacles.size(), "the same obstacles");
    });
  }
}
