#pragma once

#include <string>
#include <vector>

#include "verb.h"

/// `beeline completion bash|zsh|fish`. `verbs` must outlive the verb.
Verb completion_verb(const std::vector<Verb>& verbs);

/// A verb that takes options, with the words that lead to it: {"batch", "fk"}.
struct Leaf {
  std::vector<std::string> words;
  const Verb* verb;
};

/// All verbs that take options, in their order.
std::vector<Leaf> leaves(const std::vector<Verb>& verbs);
