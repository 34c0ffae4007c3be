#pragma once

#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

/// Throws Error, of the option, unless a motion can start at q: within the position limits.
inline void check_start(const Arm& arm, const ConfigurationRef& q, const char* option = "start") {
  const auto outside = limit_violations(arm, q);
  if (outside.empty()) return;
  throw Error::of(option, "the motion cannot start: " + sentence(outside.front()));
}

}  // namespace beeline::internal
