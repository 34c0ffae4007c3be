#pragma once

#include <string>
#include <vector>

#include "verb.h"

/// A script for zsh that completes verbs, options, values and built-in arms.
std::string zsh_completion(const std::vector<Verb>& verbs);
