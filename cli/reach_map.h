#pragma once

#include <functional>
#include <memory>
#include <string>

#include <beeline/reach/reach.h>
#include <beeline/reach/reach_map.h>

#include "command/verb.h"
#include "scene_argument.h"

namespace beeline::command {

/// What `reach map` is to compute.
struct ReachMapJob {
  Arm arm;
  ReachGrid grid;
  std::string out;
  ReachMapOptions options = {};
  std::shared_ptr<const CheckedScene> scene = {};  ///< which options.reach asks; none: no scene
};

/// The answer of a map that was computed: its totals, and the scene.
Answer computed_map(const ReachMapJob& job);

/// Makes the job of the options that were typed. Throws Error as ReachGrid does.
using MakeReachMapJob = std::function<ReachMapJob()>;

/// The verb `reach map` whose jobs are computed by this function.
Verb reach_map_verb(const std::function<Answer(const MakeReachMapJob&)>& compute);

}  // namespace beeline::command
