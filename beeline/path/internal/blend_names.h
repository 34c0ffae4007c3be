#pragma once

#include <string>
#include <vector>

#include <beeline/path/blend.h>

namespace beeline::internal {

/// How the poses of a path are counted in messages.
struct PoseNumbers {
  std::string noun = "pose";
  bool start_first = false;  ///< the first pose is "start", and the next one has number 1
};

/// Names the segments of blended lines by the poses between which they are: "line 2 of 5 (pose 2 to
/// 3)" and "the blend at pose 3".
std::vector<std::string> blend_names(const BlendedPath& blended, const PoseNumbers& numbers = {});

}  // namespace beeline::internal
