#include "command.h"

#include <cli/command/program.h>
#include <cli/verbs.h>

int beeline_command(int argc, char** argv) { return run_program(all_verbs(), argc, argv); }
