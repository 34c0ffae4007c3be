#pragma once

#include <string_view>

namespace beeline::command {

/// The standard streams. An stderr that is closed or full never changes the exit code; an stdout
/// that cannot be written does. A pipe whose reader has closed it ends the command quietly, as
/// `head` ends other programs.

/// Opens /dev/null for each closed standard stream, so that no output file gets its descriptor, and
/// ignores SIGPIPE, so that writing to a closed pipe fails instead of ending the process.
void prepare_streams();

/// Prints the line `beeline: TEXT` on stderr, made one line of UTF-8 as the message of an Error is.
void print_error(std::string_view text);

/// Prints the line `beeline: warning: TEXT` on stderr.
void warn(std::string_view text);

/// Writes text on stderr without changes.
void write_stderr(std::string_view text);

/// Writes text on stdout, to the last byte. Throws ClosedPipe if its reader has closed
/// it, FileError if the write fails otherwise.
void write_stdout(std::string_view text);

}  // namespace beeline::command
