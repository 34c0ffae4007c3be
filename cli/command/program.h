#pragma once

#include <string>
#include <vector>

#include "verb.h"

namespace beeline::command {

/// Runs the command: finds the verb, parses its options, prints the answer, and returns the exit
/// code. The verbs help, completion and man are added to `verbs`. A message of bad usage or a bad
/// file, exit codes 2 and 3, is printed on stderr and, unless null, stored in `refusal`.
int run_program(std::vector<Verb> verbs, int argc, char** argv, std::string* refusal = nullptr);

}  // namespace beeline::command
