#include <beeline/io/text/arm.h>
#include <beeline/model/catalog.h>

#include "completion.h"

namespace beeline::command {
namespace {

/// Text inside single quotes and brackets of an _arguments specification.
std::string zsh_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else if (c == '[' || c == ']' || c == ':' || c == '\\') {
      result += std::string("\\") + c;
    } else if (c == '\n') {
      result += ' ';
    } else {
      result += c;
    }
  }
  return result;
}

std::string zsh_first_sentence(const std::string& text) {
  const std::size_t end = text.find(". ");
  return end == std::string::npos ? text : text.substr(0, end + 1);
}

/// The action that completes a value: (a b c), _files, or _beeline_arms.
std::string zsh_action(Completes completes, const std::vector<std::string>& choices) {
  if (completes == Completes::arm) return "_beeline_arms";
  if (completes == Completes::file) return "_files";
  return choices.empty() ? " " : "(" + words_text(choices) + ")";
}

std::string zsh_specification(const Option& option, const std::string& name) {
  const std::string help = "[" + zsh_escaped(zsh_first_sentence(option.help)) + "]";
  if (is_flag(option)) return "'" + name + help + "'";
  return "'" + name + "=" + help + ":" + zsh_escaped(option.value) + ":" +
         zsh_action(option.completes, option.choices) + "'";
}

std::string zsh_arguments(const Verb& verb, const std::string& indent) {
  std::string text = indent + "_arguments";
  const std::string next = " \\\n" + indent + "  ";
  for (const Option& option : all_options(verb)) {
    for (const std::string& name : {option.name, option.alias}) {
      if (!name.empty()) text += next + zsh_specification(option, name);
    }
  }
  int position = 1;
  for (const Positional& argument : verb.arguments) {
    const std::string place = argument.targets == nullptr ? std::to_string(position++) : "*";
    text += next + "'" + place + (argument.required ? ":" : "::") + zsh_escaped(argument.name) +
            ":" + zsh_action(argument.completes, argument.choices) + "'";
  }
  return text + "\n";
}

/// The function that completes one of `verbs` and then what belongs to it.
std::string zsh_function(const std::string& name, const std::vector<Verb>& verbs) {
  std::string text =
      name +
      "() {\n  local curcontext=$curcontext state line\n  local -a verbs\n"
      "  _arguments -C '--help[Print this help.]' '1:verb:->verb' '*::argument:->arguments'\n"
      "  case $state in\n    verb)\n      verbs=(\n";
  for (const Verb& verb : verbs) {
    text += "        '" + verb.name + ":" + zsh_escaped(verb.summary) + "'\n";
  }
  text +=
      "      )\n      _describe verb verbs\n      ;;\n    arguments)\n      case $words[1] in\n";
  for (const Verb& verb : verbs) {
    text += "        " + verb.name + ")\n";
    text += verb.verbs.empty() ? zsh_arguments(verb, "          ")
                               : "          " + name + "_" + verb.name + "\n";
    text += "          ;;\n";
  }
  return text + "      esac\n      ;;\n  esac\n}\n\n";
}

}  // namespace

std::string zsh_completion(const std::vector<Verb>& verbs) {
  std::string arms;
  for (const std::string& arm : built_in_names()) arms += " " + arm;
  std::string endings;
  for (const std::string& ending : arm_file_endings()) {
    endings += (endings.empty() ? "" : "|") + ending;
  }
  std::string text =
      "#compdef beeline\n# zsh completion for beeline, printed by `beeline completion zsh`\n\n"
      "_beeline_arms() {\n  compadd --" +
      arms + "\n  _files -g '*.(" + endings + ")'\n}\n\n";
  for (const Verb& verb : verbs) {
    if (!verb.verbs.empty()) text += zsh_function("_beeline_" + verb.name, verb.verbs);
  }
  return text + zsh_function("_beeline", verbs) +
         "if [[ $funcstack[1] == _beeline ]]; then\n  _beeline \"$@\"\nelse\n"
         "  compdef _beeline beeline\nfi\n";
}

}  // namespace beeline::command
