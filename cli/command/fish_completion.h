#pragma once

#include <string>
#include <vector>

#include "verb.h"

/// A script for fish that completes verbs, options, values and built-in arms.
std::string fish_completion(const std::vector<Verb>& verbs);
