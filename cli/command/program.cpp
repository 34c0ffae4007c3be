#include "program.h"

#include <algorithm>
#include <new>

#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/urdf.h>

#include "completion.h"
#include "help.h"
#include "man_page.h"
#include "parse.h"
#include "streams.h"

namespace beeline::command {
namespace {

/// closed_pipe is what a shell reports for a program that SIGPIPE ends.
enum class Exit { yes = 0, no = 1, usage = 2, file = 3, closed_pipe = 128 + 13 };

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

/// The error for words without a verb.
Error no_verb(const std::vector<Verb>& verbs, const Selection& selection) {
  std::vector<std::string> names;
  for (const Verb& verb : verbs) names.push_back(verb.name);
  std::string message;
  if (!selection.arguments.empty()) {
    message = "unknown option \"" + selection.arguments.front() + "\" before a verb; ";
  }
  return Error(message + selection.command + " needs a verb: " + listed(names));
}

/// Follows verbs of verbs, such as `batch fk`.
void select(const std::vector<Verb>& verbs, Selection& selection) {
  std::vector<std::string>& arguments = selection.arguments;
  const bool named = !arguments.empty() && arguments.front()[0] != '-';
  if (!named && selection.verb != nullptr && asks_for_help(arguments)) return;
  if (!named) throw no_verb(verbs, selection);
  selection.verb = &find_verb(verbs, arguments.front());
  selection.command += " " + selection.verb->name;
  arguments.erase(arguments.begin());
  if (!selection.verb->verbs.empty()) select(selection.verb->verbs, selection);
}

/// The library's name of an option: "max_samples" of --max-samples.
std::string library_name(const Option& option) {
  std::string name = option.name.substr(2);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// Whether the option sets the argument at fault.
bool sets(const Option& option, const std::string& argument) {
  return argument == library_name(option) ||
         std::find(option.arguments.begin(), option.arguments.end(), argument) !=
             option.arguments.end();
}

/// The message, with the option in place of the argument at fault: one that was typed or, if it is
/// missing, the one of its name.
std::string naming_the_option(const Error& error, const Selection& selection) {
  if (selection.verb == nullptr || error.argument().empty()) return error.what();
  const std::vector<Option> options = all_options(*selection.verb);
  for (const Option& option : options) {
    for (const std::string& name : selection.typed) {
      const bool typed = name == option.name || name == option.alias;
      if (typed && sets(option, error.argument())) return error.message_for(name);
    }
  }
  for (const Option& option : options) {
    if (library_name(option) == error.argument()) return error.message_for(option.name);
  }
  return error.what();
}

int exit_code(const Answer& answer) {
  if (!answer.yes) print_error(answer.reason);
  return static_cast<int>(answer.yes ? Exit::yes : Exit::no);
}

int print(const Answer& answer) {
  if (answer.text_on_stderr) {
    write_stderr(answer.text);
  } else {
    write_stdout(answer.text);
  }
  return exit_code(answer);
}

int print_json(const Verb& verb, const Answer& answer) {
  write_stdout(with_units(verb, answer).text() + "\n");
  return exit_code(answer);
}

/// The command as it can be pasted into a shell.
std::string command_line(const Selection& selection) {
  std::string line = selection.command;
  for (const std::string& word : selection.arguments) line += " " + shell_word(word);
  return line;
}

/// Takes the arguments of xacro, `NAME:=VALUE`, from the words. Throws Error if no word is a .xacro
/// file.
XacroArguments take_xacro_arguments(std::vector<std::string>& words) {
  XacroArguments arguments;
  const auto is_argument = [&](const std::string& word) {
    const std::size_t end = word.find(":=");
    const bool is = end != std::string::npos && end > 0 && word.front() != '-' &&
                    word.find_first_of("/ ,") > end;
    if (is) arguments.insert_or_assign(word.substr(0, end), word.substr(end + 2));
    return is;
  };
  words.erase(std::remove_if(words.begin(), words.end(), is_argument), words.end());
  const auto is_xacro = [](const std::string& word) { return extension(word) == "xacro"; };
  if (!arguments.empty() && std::none_of(words.begin(), words.end(), is_xacro)) {
    throw Error(arguments.begin()->first +
                ":= is an argument of a .xacro file, and no such file is given");
  }
  return arguments;
}

int run(Selection& selection) {
  const Verb& verb = *selection.verb;
  if (asks_for_help(selection.arguments)) {
    return print({.text = help_text(verb, selection.command)});
  }
  std::vector<std::string> words = selection.arguments;
  const KeptExpansions kept(take_xacro_arguments(words));  // files are expanded once
  selection.typed = parse(verb, words);
  if (verb.command_line != nullptr) *verb.command_line = command_line(selection);
  const bool json = verb.json != nullptr && *verb.json;
  return json ? print_json(verb, verb.run()) : print(verb.run());
}

int print_version(const std::vector<std::string>& arguments) {
  if (arguments.size() > 1) throw Error("unexpected argument \"" + arguments[1] + "\"");
  return print({.text = "beeline " BEELINE_VERSION "\n"});
}

/// Refuses a command: prints the message and stores it unless `refusal` is null.
int fail(Exit exit, const std::string& message, std::string* refusal) {
  print_error(message);
  if (refusal != nullptr) *refusal = message;
  return static_cast<int>(exit);
}

}  // namespace

int run_program(std::vector<Verb> verbs, int argc, char** argv, std::string* refusal) {
  prepare_streams();
  verbs.push_back(completion_verb(verbs));
  verbs.push_back(man_verb(verbs));
  verbs.push_back(help_verb(verbs));
  Selection selection;
  selection.arguments.assign(argv + std::min(argc, 1), argv + argc);
  try {
    const std::string first = selection.arguments.empty() ? "" : selection.arguments.front();
    if (first == "--help" || first == "-h") return print({.text = overview(verbs)});
    if (first == "--version") return print_version(selection.arguments);
    if (selection.arguments.empty()) {
      write_stderr(short_help());
      return static_cast<int>(Exit::usage);
    }
    select(verbs, selection);
    return run(selection);
  } catch (const ClosedPipe&) {
    return static_cast<int>(Exit::closed_pipe);
  } catch (const FileError& error) {
    return fail(Exit::file, error.what(), refusal);
  } catch (const Error& error) {
    return fail(Exit::usage,
                naming_the_option(error, selection) + " (see " + selection.command + " --help)",
                refusal);
  } catch (const std::bad_alloc&) {
    return fail(Exit::file, "the input needs more memory than is available", refusal);
  } catch (const std::exception& error) {
    return fail(Exit::usage, std::string("internal error, please report it: ") + error.what(),
                refusal);
  }
}

}  // namespace beeline::command
