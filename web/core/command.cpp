#include "command.h"

#include <cli/command/program.h>
#include <cli/command/progress.h>
#include <cli/verbs.h>

#include "progress.h"

int beeline_command(int argc, char** argv) {
  listen_to_progress(report_progress);
  return run_program(all_verbs(), argc, argv);
}
