#include "command.h"

#include <cli/command/program.h>
#include <cli/verbs.h>

int beeline_command(int argc, char** argv) {
  return beeline::command::run_program(beeline::command::all_verbs(), argc, argv);
}
