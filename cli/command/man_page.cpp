#include "man_page.h"

#include <sstream>

#include "help.h"

namespace beeline::command {
namespace {

/// Text as roff prints it: backslashes, hyphens that are typed, and lines that begin with a dot.
std::string roff_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool line_begins = result.empty() || result.back() == '\n';
    if (line_begins && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
  }
  return result;
}

std::string roff_paragraphs(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    result += line.empty() ? ".PP\n" : roff_escaped(line) + "\n";
  }
  return result;
}

std::string roff_entry(const std::string& name, const std::string& help) {
  return ".TP\n.B " + roff_escaped(name) + "\n" + roff_paragraphs(help);
}

std::string roff_examples(const Verb& verb) {
  std::string text;
  for (const Example& example : verb.examples) {
    text += ".PP\n" + roff_escaped(example.purpose) + ":\n.PP\n.nf\n" +
            roff_escaped(example.commands) + "\n.fi\n";
  }
  return text;
}

std::string roff_section(const Verb& verb, const std::string& command) {
  std::string text = ".SS " + roff_escaped(command) + "\n" + roff_escaped(verb.summary) +
                     ".\n.PP\n.B " + roff_escaped(usage(verb, command)) + "\n";
  if (!verb.description.empty()) text += ".PP\n" + roff_paragraphs(verb.description);
  for (const Positional& argument : verb.arguments)
    text += roff_entry(argument.name, argument.help);
  for (const Option& option : all_options(verb)) {
    std::string help = full_help(option);
    for (const std::string& method : option.methods) {
      help += (&method == &option.methods.front() ? " With --method " : " or ") + method;
    }
    text += roff_entry(heading(option), help + (option.methods.empty() ? "" : "."));
  }
  text += roff_examples(verb);
  for (const Verb& part : verb.verbs) text += roff_section(part, command + " " + part.name);
  return text;
}

}  // namespace

std::string man_page(const std::vector<Verb>& verbs) {
  std::string text = ".TH BEELINE 1 \"\" \"Beeline " BEELINE_VERSION
                     "\" \"User Commands\"\n"
                     ".SH NAME\nbeeline \\- plan and prove motions of serial\\-link robot arms\n"
                     ".SH SYNOPSIS\n.B beeline\n.I VERB\n.RI [ ARM ]\n.RI [ options ]\n"
                     ".SH DESCRIPTION\n" +
                     roff_paragraphs(conventions()) + ".SH VERBS\n";
  for (const Verb& verb : verbs) text += roff_section(verb, "beeline " + verb.name);
  return text;
}

Verb man_verb(const std::vector<Verb>& verbs) {
  return {.name = "man",
          .summary = "Print the manual page in roff",
          .description = "Prints the page that `man beeline` shows where Beeline is installed.",
          .examples = {{"Write the page to a file", "beeline man > beeline.1"}},
          .json = nullptr,
          .run = [&verbs]() -> Answer { return {.text = man_page(verbs)}; }};
}

}  // namespace beeline::command
