#pragma once

#include <functional>
#include <string>

#include <beeline/draw/animation.h>

namespace beeline::internal {

/// Images of one size at equal steps of time.
struct MovieFrames {
  int width = 0, height = 0;  ///< pixels, even numbers
  double per_second = 25;
  int count = 0;
  std::function<std::string(int)> pixels;  ///< pixels of image i, see pixels_of()
};

/// Returns the bytes of a gif, mp4 or webp file, encoded by the program `ffmpeg`. This one program
/// writes all three formats, and is needed only for them. Throws Error when it is missing or fails.
/// Exists only in builds with BEELINE_CAIRO, which draws the images.
std::string movie(const MovieFrames& frames, AnimationFormat format);

}  // namespace beeline::internal
