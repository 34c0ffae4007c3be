#pragma once

#include <string>
#include <vector>

#include "verb.h"

namespace beeline::command {

/// `beeline completion bash|zsh|fish`. `verbs` must outlive the verb.
Verb completion_verb(const std::vector<Verb>& verbs);

/// A script for the shell that completes verbs, options, values and built-in arms.
std::string bash_completion(const std::vector<Verb>& verbs);
std::string fish_completion(const std::vector<Verb>& verbs);
std::string zsh_completion(const std::vector<Verb>& verbs);

/// The words in one text.
std::string words_text(const std::vector<std::string>& words, const char* separator = " ");

/// A verb that takes options, with the words that lead to it: {"batch", "fk"}.
struct Leaf {
  std::vector<std::string> words;
  const Verb* verb;
};

/// All verbs that take options, in their order.
std::vector<Leaf> leaves(const std::vector<Verb>& verbs);

}  // namespace beeline::command
