#include "help.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>

#include <beeline/error.h>

namespace beeline::command {
namespace {

constexpr std::size_t page_width = 80, column = 26;
const std::string usage_line = "Usage: beeline VERB [ARM] [options]\n";

/// Breaks text into lines of the page's width. Lines that begin with a blank stay as they are.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::istringstream lines(text);
  std::string result, line;
  while (std::getline(lines, line)) {
    const bool as_it_is = line.starts_with(' ') || line.empty();
    if (as_it_is) {
      result += (line.empty() ? "" : std::string(indent, ' ') + line) + "\n";
      continue;
    }
    std::istringstream words(line);
    std::string word, row;
    while (words >> word) {
      if (!row.empty() && indent + row.size() + 1 + word.size() > page_width) {
        result += std::string(indent, ' ') + row + "\n";
        row.clear();
      }
      row += (row.empty() ? "" : " ") + word;
    }
    result += std::string(indent, ' ') + row + "\n";
  }
  return result;
}

/// A name on the left, its help in the right column.
std::string help_entry(const std::string& name, const std::string& help) {
  std::string right = wrapped(help, column);
  const std::string left = "  " + name;
  if (left.size() + 2 > column) return left + "\n" + right;
  return left + right.substr(left.size());
}

/// The options that require the same values of --method, in their order.
std::vector<std::vector<std::string>> method_groups(const std::vector<Option>& options) {
  std::vector<std::vector<std::string>> groups{{}};
  for (const Option& option : options) {
    if (std::find(groups.begin(), groups.end(), option.methods) == groups.end()) {
      groups.push_back(option.methods);
    }
  }
  return groups;
}

std::string options_text(const Verb& verb) {
  const std::vector<Option> options = all_options(verb);
  std::string text;
  for (const std::vector<std::string>& methods : method_groups(options)) {
    text += methods.empty() ? "\nOptions:\n" : "\nOptions with --method " + listed(methods) + ":\n";
    for (const Option& option : options) {
      if (option.methods == methods) text += help_entry(heading(option), full_help(option));
    }
  }
  return text;
}

std::string examples_text(const Verb& verb) {
  std::string text = verb.examples.empty() ? "" : "\nExamples:\n";
  for (const Example& example : verb.examples) {
    text += "  # " + example.purpose + "\n";
    std::istringstream lines(example.commands);
    for (std::string line; std::getline(lines, line);) text += "  " + line + "\n";
  }
  return text;
}

std::string verbs_text(const std::vector<Verb>& verbs) {
  std::string text = "\nVerbs:\n";
  for (const Verb& verb : verbs) text += help_entry(verb.name, verb.summary);
  return text;
}

}  // namespace

std::string full_help(const Option& option) {
  std::string text = option.help;
  if (option.required) text += " Required.";
  const std::string default_value = default_text(option);
  if (!default_value.empty()) text += " Default: " + default_value + ".";
  if (!range_text(option).empty()) text += " Range: " + range_text(option) + ".";
  if (!option.needs.empty()) text += " Needs " + option.needs + ".";
  if (!option.excludes.empty()) text += " Excludes " + option.excludes + ".";
  return text;
}

std::string heading(const Option& option) {
  std::string text = option.name;
  if (!option.alias.empty()) {
    text = option.alias.size() == 2 ? option.alias + ", " + text : text + ", " + option.alias;
  }
  return option.value.empty() ? text : text + " " + option.value;
}

std::string help_text(const Verb& verb, const std::string& command) {
  std::string text = verb.summary + ".\n\nUsage: " + usage(verb, command) + "\n";
  if (!verb.description.empty()) text += "\n" + wrapped(verb.description, 0);
  if (!verb.verbs.empty()) text += verbs_text(verb.verbs);
  if (!verb.arguments.empty()) text += "\nArguments:\n";
  for (const Positional& argument : verb.arguments)
    text += help_entry(argument.name, argument.help);
  return text + options_text(verb) + examples_text(verb);
}

const std::string& conventions() {
  static const std::string text =
      "ARM is a built-in arm (panda; `beeline arms` lists them, in upper or lower case), a joint "
      "string with link lengths in metres (RRR:3.5,3.5,2), or a file (.urdf, .xacro, MuJoCo's "
      ".xml, .json).\n"
      "\n"
      "Units are metres, radians and seconds. With --degrees, angles are read and printed in "
      "degrees; the value of a prismatic joint is always in metres.\n"
      "\n"
      "The answer is printed on stdout, reasons and warnings on stderr. Exit codes: 0 yes, 1 the "
      "computed answer is no, 2 bad usage, 3 a file that cannot be read or written.";
  return text;
}

std::string short_help() {
  return "Beeline plans and proves motions of serial-link robot arms: where the tool is, the "
         "joint\n"
         "values that bring it to a pose, and motions in straight lines within the joint limits.\n"
         "\n"
         "  beeline fk panda --q 0,-0.785,0,-2.356,0,1.571,0.785\n"
         "  beeline ik rrr --pose 4.459,5.226,0 --all --degrees\n"
         "  beeline move ur5 --from 0,-90,90,0,90,0 --to 60,-60,80,0,90,0 --degrees --method "
         "quickest\n"
         "\n"
         "`beeline help` lists the verbs; `beeline help VERB` describes one, with examples.\n";
}

std::string overview(const std::vector<Verb>& verbs) {
  return "Plans and proves motions of serial-link robot arms.\n\n" + usage_line +
         verbs_text(verbs) + "\nOptions:\n" + help_entry("-h, --help", "Print this help.") +
         help_entry("--version", "Print the version.") + "\n" + wrapped(conventions(), 0) +
         "\n`beeline help VERB` describes a verb and its options, with examples.\n";
}

Verb help_verb(const std::vector<Verb>& verbs) {
  const auto name = std::make_shared<std::string>(), part = std::make_shared<std::string>();
  Verb verb{.name = "help",
            .summary = "Describe a verb, its options and examples",
            .description = "Prints what `beeline VERB --help` prints, or the list of verbs."};
  std::vector<std::string> names, kinds, parts;
  for (const Verb& other : verbs) {
    names.push_back(other.name);
    if (other.verbs.empty()) continue;
    std::vector<std::string> own;
    for (const Verb& kind : other.verbs) own.push_back(kind.name);
    kinds.insert(kinds.end(), own.begin(), own.end());
    parts.push_back(fmt::format("Of `{}`: {}", other.name, fmt::join(own, ", ")));
  }
  names.push_back(verb.name);
  verb.arguments = {
      {.name = "VERB",
       .help = "The verb to describe.",
       .target = name.get(),
       .required = false,
       .choices = names,
       .other_values = true},  // find_verb() suggests another
      {.name = "KIND",
       .help = fmt::format("The part of a verb that has several. {}.", fmt::join(parts, ". ")),
       .target = part.get(),
       .required = false,
       .choices = kinds}};
  verb.examples = {{"All options of the verb fk", "beeline help fk"},
                   {"The options of batch ik", "beeline help batch ik"}};
  verb.json = nullptr;
  verb.run = [&verbs, name, part]() -> Answer {
    if (name->empty()) return {.text = overview(verbs)};
    const Verb& described = find_verb(verbs, *name);
    const std::string command = "beeline " + *name;
    if (part->empty()) return {.text = help_text(described, command)};
    if (described.verbs.empty()) throw Error("the verb " + *name + " has no kinds");
    return {.text = help_text(find_verb(described.verbs, *part), command + " " + *part)};
  };
  return verb;
}

}  // namespace beeline::command
