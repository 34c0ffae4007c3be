#pragma once

#include <string>
#include <vector>

#include "verb.h"

/// A script for bash that completes verbs, options, values and built-in arms.
std::string bash_completion(const std::vector<Verb>& verbs);
