#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <beeline/io/text/json.h>

#include "option.h"

namespace beeline::command {

/// What a verb answers. The text, or with --json the document, is printed on stdout. The document
/// of a verb with --degrees has the member "units", see with_units().
struct Answer {
  std::string text = {};
  Json document = {};
  Json units = {};              ///< of members in other units than the rest, by their keys
  bool yes = true;              ///< no ends with exit code 1
  std::string reason = {};      ///< why the answer is no, for stderr
  bool text_on_stderr = false;  ///< stdout holds other results
};

/// Commands that work when they are pasted into a shell, in the order of the verb's examples.
struct Example {
  std::string purpose;  ///< one line
  std::string commands;
};

/// A verb as data: the parser, the help, the man page and the shell completions read nothing else.
struct Verb {
  std::string name;
  std::string summary;  ///< one line: "Retime a trajectory: minimum time within the limits"
  std::string description = {};  ///< what is computed and printed, in paragraphs
  std::vector<Positional> arguments = {};
  std::vector<Option> options = {};
  std::vector<Example> examples = {};
  /// Set by --json; null for a verb without that option.
  std::shared_ptr<bool> json = std::make_shared<bool>(false);
  /// Set to the command line that was typed; null for a verb that does not need it.
  std::shared_ptr<std::string> command_line = nullptr;
  std::function<Answer()> run = {};
  std::vector<Verb> verbs = {};  ///< such as fk of batch; then run is empty
};

/// All options with --json and --help, as the help, the man page and the completions list them.
std::vector<Option> all_options(const Verb& verb);

/// The document with {"units": {"length": "m", "angle": "rad" or "deg", "time": "s"}}, with
/// --millimetres "position": "mm" of poses, and the answer's own units, if the verb has --degrees.
Json with_units(const Verb& verb, const Answer& answer);

/// "beeline line ARM --through FILE [options]".
std::string usage(const Verb& verb, const std::string& command);

/// Throws Error for an unknown name, with the nearest known one or the one that is meant.
const Verb& find_verb(const std::vector<Verb>& verbs, const std::string& name);

}  // namespace beeline::command
