#include "animation_argument.h"

#include <beeline/error.h>

#include "result_files.h"

using namespace beeline;

std::vector<Option> AnimationArgument::options() {
  return {
      {.name = "--animate",
       .value = "FILE",
       .help = "Write an animation in real time, which repeats: .svg, which browsers play; .gif, "
               ".mp4 or .webp by the program ffmpeg.",
       .target = &file,
       .completes = Completes::file,
       .phrases = {"animated figure", "ffmpeg", "format of animations", "longer than a day"}},
      {.name = "--playback-speed",
       .value = "FACTOR",
       .help = "Speed of the animation: 2 is twice as fast as the motion.",
       .target = &playback.speed,
       .range = {1e-3, 1e3},
       .needs = "--animate",
       .phrases = {"playback speed"}},
      {.name = "--fps",
       .value = "N",
       .help =
           "Frames per second of .gif, .mp4 and .webp, which have at most 1500 frames: a longer "
           "animation has fewer per second.",
       .target = &playback.frames_per_second,
       .range = {1, 60},
       .needs = "--animate"}};
}

void AnimationArgument::check(const std::string& picture,
                              const std::vector<std::string>& inputs) const {
  if (!wanted()) return;
  animation_format_of(file);
  refuse_overwriting(file, inputs);
  if (!picture.empty() && same_file(file, picture)) {
    throw Error("--animate and --out name the same file: " + file);
  }
}

void AnimationArgument::write(const Animation& animation) const { save(animation, file, playback); }
