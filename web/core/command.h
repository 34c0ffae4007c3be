#pragma once

extern "C" {

/// Runs the command `beeline` with these arguments, argv[0] included, and returns its exit code.
/// Its files are those of the module's file system. Only once in an instance of the module, as the
/// verbs keep their arguments.
int beeline_command(int argc, char** argv);
}
