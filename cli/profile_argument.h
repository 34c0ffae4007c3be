#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/timing/retime.h>

#include "command/option.h"

/// --interpolation: the motion between the samples that are written.
struct InterpolationArgument {
  std::string text = "quintic";

  Option option(const std::vector<std::string>& methods = {});
  beeline::Interpolation read() const { return beeline::interpolation_named(text); }
};

/// --profile: the time profile.
struct ProfileArgument {
  std::string text = {};

  Option option(const std::vector<std::string>& methods = {});
  std::optional<beeline::Profile> read() const;
};
