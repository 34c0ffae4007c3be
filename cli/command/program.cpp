#include "program.h"

#include <algorithm>
#include <new>

#include <beeline/error.h>

#include "completion.h"
#include "former_names.h"
#include "help.h"
#include "man_page.h"
#include "parse.h"
#include "streams.h"

using beeline::Error;

namespace {

enum class Exit { yes = 0, no = 1, usage = 2, file = 3 };

/// The verb that was typed, and what follows it.
struct Selection {
  const Verb* verb = nullptr;
  std::string command = "beeline";
  std::vector<std::string> arguments;
  std::vector<std::string> typed;  ///< options
};

bool asks_for_help(const std::vector<std::string>& arguments) {
  return std::any_of(arguments.begin(), arguments.end(),
                     [](const std::string& word) { return word == "--help" || word == "-h"; });
}

/// Follows verbs of verbs, such as `batch fk`.
void select(const std::vector<Verb>& verbs, Selection& selection) {
  std::vector<std::string>& arguments = selection.arguments;
  const bool named = !arguments.empty() && arguments.front()[0] != '-';
  if (!named && selection.verb != nullptr && asks_for_help(arguments)) return;
  if (!named) {
    std::vector<std::string> names;
    for (const Verb& verb : verbs) names.push_back(verb.name);
    throw Error(selection.command + " needs a verb: " + beeline::listed(names));
  }
  selection.verb = &find_verb(verbs, arguments.front());
  selection.command += " " + selection.verb->name;
  arguments.erase(arguments.begin());
  if (!selection.verb->verbs.empty()) select(selection.verb->verbs, selection);
}

/// The message with the option in front that it is about, if it mentions one that was typed by its
/// name in the library: "max samples" or max_samples for --max-samples.
std::string naming_the_option(std::string message, const std::vector<std::string>& typed) {
  std::string words = message;  // "the tool's speed" is --tool-speed
  for (std::size_t at = words.find("'s "); at != std::string::npos; at = words.find("'s ")) {
    words.erase(at, 2);
  }
  const auto mentions = [&words](const std::string& name) {
    const std::size_t at = words.find(name);
    const auto letter = [&words](std::size_t i) {
      return i < words.size() && std::isalnum(static_cast<unsigned char>(words[i])) != 0;
    };
    return at != std::string::npos && !letter(at - 1) && !letter(at + name.size());
  };
  std::string best;
  for (const std::string& option : typed) {
    if (mentions(option)) return message;
    std::string name = option.substr(option.find_first_not_of('-'));
    bool found = mentions(name);
    for (const char blank : {' ', '_'}) {
      std::replace_if(
          name.begin(), name.end(), [](char c) { return c == '-' || c == ' '; }, blank);
      found = found || mentions(name);
    }
    if (found && option.size() > best.size()) best = option;
  }
  return best.empty() ? message : best + ": " + message;
}

int print(const Answer& answer, bool json) {
  if (json) {
    write_stdout(answer.document.text() + "\n");
  } else if (answer.text_on_stderr) {
    write_stderr(answer.text);
  } else {
    write_stdout(answer.text);
  }
  if (!answer.yes) print_error(answer.reason);
  return static_cast<int>(answer.yes ? Exit::yes : Exit::no);
}

int run(Selection& selection) {
  const Verb& verb = *selection.verb;
  if (asks_for_help(selection.arguments)) {
    return print({.text = help_text(verb, selection.command)}, false);
  }
  selection.typed = parse(verb, selection.arguments);
  return print(verb.run(), verb.json != nullptr && *verb.json);
}

int fail(Exit exit, const std::string& message) {
  print_error(message);
  return static_cast<int>(exit);
}

}  // namespace

int run_program(std::vector<Verb> verbs, int argc, char** argv) {
  prepare_streams();
  verbs.push_back(completion_verb(verbs));
  verbs.push_back(man_verb(verbs));
  verbs.push_back(help_verb(verbs));
  Selection selection;
  selection.arguments.assign(argv + std::min(argc, 1), argv + argc);
  try {
    const std::string first = selection.arguments.empty() ? "" : selection.arguments.front();
    if (first == "--help" || first == "-h") return print({.text = overview(verbs)}, false);
    if (first == "--version") return print({.text = "beeline " BEELINE_VERSION "\n"}, false);
    select(verbs, selection);
    return run(selection);
  } catch (const beeline::FileError& error) {
    return fail(Exit::file, error.what());
  } catch (const Error& error) {
    return fail(Exit::usage, naming_the_option(error.what(), selection.typed) + " (see " +
                                 selection.command + " --help)");
  } catch (const std::bad_alloc&) {
    return fail(Exit::file, "the input needs more memory than is available");
  } catch (const std::exception& error) {
    return fail(Exit::usage, std::string("internal error, please report it: ") + error.what());
  }
}
