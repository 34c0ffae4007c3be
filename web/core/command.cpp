#include "command.h"

#include <cli/command/program.h>
#include <cli/command/progress.h>
#include <cli/verbs.h>

#include "progress.h"

int beeline_command(int argc, char** argv) {
  beeline::command::listen_to_progress(report_progress);
  return beeline::command::run_program(beeline::command::all_verbs(), argc, argv);
}
