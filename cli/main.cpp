#include "command/program.h"
#include "verbs.h"

int main(int argc, char** argv) {
  return beeline::command::run_program(beeline::command::all_verbs(), argc, argv);
}
