#include "animation_argument.h"

#include <beeline/error.h>

#include "result_files.h"

namespace beeline::command {

std::vector<Option> AnimationArgument::options() {
  return {
      Option("--animate FILE",
             "Write an animation in real time, which repeats: .svg, which browsers play; .gif, "
             ".mp4 or .webp by the program ffmpeg.",
             &file),
      Option("--playback-speed FACTOR", "Speed of the animation: 2 is twice as fast as the motion.",
             &playback.speed, {.range = {1e-3, 1e3}, .needs = "--animate"}),
      Option("--fps N",
             "Frames per second of .gif, .mp4 and .webp, which have at most 1500 frames: a longer "
             "animation has fewer per second.",
             &playback.frames_per_second, {.range = {1, 60}, .needs = "--animate"})};
}

void AnimationArgument::check(const std::string& picture,
                              const std::vector<std::string>& inputs) const {
  if (!wanted()) return;
  for_option("--animate", [&] { return animation_format_of(file); });
  refuse_overwriting(file, inputs);
  if (!picture.empty() && same_file(file, picture)) {
    throw Error("--animate and --out name the same file: " + file);
  }
}

void AnimationArgument::write(const Animation& animation) const {
  for_option("--animate", [&] { save(animation, file, playback); });
}

}  // namespace beeline::command
