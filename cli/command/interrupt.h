#pragma once

namespace beeline::command {

/// From now on the first interrupt (Ctrl-C) does not end the process: interrupted() reports it, so
/// that a computation can end with what it has found. A second one ends the process.
void catch_interrupt();

/// The same for SIGTERM, with which init systems and containers end a server.
void catch_termination();

bool interrupted();

}  // namespace beeline::command
