#pragma once

#include <vector>

#include "verb.h"

namespace beeline::command {

/// Runs the command: finds the verb, parses its options, prints the answer, and returns the exit
/// code. The verbs help, completion and man are added to `verbs`.
int run_program(std::vector<Verb> verbs, int argc, char** argv);

}  // namespace beeline::command
