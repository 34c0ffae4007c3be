#include <cli/command/program.h>
#include <cli/verbs.h>
#include <string>
#include <vector>

#include "bindings.h"
#include "interruption.h"

namespace beeline::python {
namespace nb = nanobind;

void bind_command_line(nb::module_& module) {
  module.def(
      "_command_line",
      [](const nb::list& words) {
        std::vector<std::string> arguments;
        for (const nb::handle word : words) {
          const auto bytes = nb::cast<nb::bytes>(word);
          arguments.emplace_back(bytes.c_str(), bytes.size());
        }
        std::vector<char*> argv;
        for (std::string& argument : arguments) argv.push_back(argument.data());
        argv.push_back(nullptr);
        const LockRelease release;
        return command::run_program(command::all_verbs(), static_cast<int>(arguments.size()),
                                    argv.data());
      },
      nb::sig("def _command_line(words: list[bytes], /) -> int"),
      "Runs the command `beeline` with these words, its own name first, and returns the exit "
      "code.");
}

}  // namespace beeline::python
