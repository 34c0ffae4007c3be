#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/timing/retime.h>

#include "command/option.h"

/// --profile: the time profile.
struct ProfileArgument {
  std::string text = {};

  Option option(const std::vector<std::string>& methods = {});
  std::optional<beeline::Profile> read() const;
};
