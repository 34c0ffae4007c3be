#include "command/program.h"
#include "verbs.h"

int main(int argc, char** argv) { return run_program(all_verbs(), argc, argv); }
