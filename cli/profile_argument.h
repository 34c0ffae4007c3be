#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/timing/retime.h>

#include "command/option.h"

namespace beeline::command {

/// --interpolation: the motion between the samples that are written.
struct InterpolationArgument {
  std::string text = "quintic";

  Option option(const std::vector<std::string>& methods = {});
  Interpolation read() const { return interpolation_named(text); }
};

/// --profile: the time profile.
struct ProfileArgument {
  std::string text = {};

  Option option(const std::vector<std::string>& methods = {});
  std::optional<Profile> read() const;
};

}  // namespace beeline::command
