#pragma once

#include <string>
#include <vector>

#include <beeline/draw/animation.h>
#include <beeline/io/text/json.h>

#include "command/option.h"

namespace beeline::command {

/// --animate with --playback-speed and --fps: an animation in a file.
struct AnimationArgument {
  std::string file = {};
  PlaybackOptions playback = {};

  std::vector<Option> options();
  /// Throws Error for an unknown format and for the name of an input file or of `picture`.
  void check(const std::string& picture, const std::vector<std::string>& inputs) const;
  bool wanted() const { return !file.empty(); }
  void write(const Animation& animation) const;
};

}  // namespace beeline::command
