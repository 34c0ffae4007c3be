#pragma once

extern "C" {

/// Runs the command `beeline` with these arguments, argv[0] included, and returns its exit code.
/// It reads and writes files of the module's file system. Calls the module's function `progress`
/// with the fraction computed, now and then. If the command is refused, with an exit code above 1,
/// beeline_error() has the message.
int beeline_command(int argc, char** argv);
}
