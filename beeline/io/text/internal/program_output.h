#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace beeline::internal {

/// Returns the path of an executable file of this name in an absolute folder of the variable PATH.
std::optional<std::string> program_in_path(const std::string& name);

/// Bounds of a program that another one waits for.
struct ProgramBounds {
  std::size_t output = 0;  ///< bytes of its standard output
  std::chrono::milliseconds time{0};
};

/// How a program ended, and what it wrote.
struct ProgramOutput {
  enum class Ending { succeeded, failed, out_of_time, too_much_output };
  Ending ending = Ending::failed;
  std::string output;    ///< at most as long as the bound
  std::string messages;  ///< the first 64 kB of its standard error
};

/// Runs a program in a folder, without a shell and with an empty standard input, until it ends or
/// exceeds a bound, which kills it. `command` is its path and its arguments. Throws Error if no
/// process can be created.
ProgramOutput run_program(const std::vector<std::string>& command, const std::string& folder,
                          const ProgramBounds& bounds);

}  // namespace beeline::internal
