#pragma once

#include <vector>

#include <beeline/timing/time_scaling.h>

namespace beeline::testing {

/// Every profile, in the order of the enumeration.
inline const std::vector<Profile> profiles = [] {
  std::vector<Profile> all;
  for (const std::string& name : profile_names()) all.push_back(profile_named(name));
  return all;
}();

/// Returns each profile in turn.
inline Profile profile_of_case(int i) {
  return profiles[static_cast<std::size_t>(i) % profiles.size()];
}

}  // namespace beeline::testing
