#include "command.h"

#include <cli/command/program.h>
#include <cli/command/progress.h>
#include <cli/verbs.h>
#include <string>

#include "fault.h"
#include "progress.h"

int beeline_command(int argc, char** argv) {
  beeline::command::listen_to_progress(report_progress);
  std::string refusal;
  const int code =
      beeline::command::run_program(beeline::command::all_verbs(), argc, argv, &refusal);
  beeline::web::set_error(refusal);
  return code;
}
