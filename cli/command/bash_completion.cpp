#include <beeline/model/catalog.h>

#include "completion.h"

namespace beeline::command {
namespace {

/// Finds the verb, the number of arguments behind it and the option whose value is completed, then
/// offers words. _beeline_words sets, for a verb: its options, those with a value, the values of
/// the option `prev`, and what its arguments are: one that takes several words begins with *.
constexpr const char* bash_functions = R"(
_beeline() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]}
  if [[ $cur == "=" ]]; then
    cur=
  elif [[ $prev == "=" ]]; then
    prev=${COMP_WORDS[COMP_CWORD-2]}
  fi
  local command= position=0 value= i word verbs options valued values arguments
  _beeline_words ""
  for ((i = 1; i < COMP_CWORD; i++)); do
    word=${COMP_WORDS[i]}
    if [[ -n $value ]]; then
      [[ $word == "=" ]] || value=
    elif [[ $word == -* ]]; then
      [[ " $valued " != *" $word "* ]] || value=yes
    elif [[ " $verbs " == *" $word "* ]]; then
      command+="${command:+ }$word"
      _beeline_words "$command"
    else
      position=$((position + 1))
    fi
  done
  local offered
  if [[ -n $value ]]; then
    offered=$values
  elif [[ $cur == -* ]]; then
    offered=$options
  elif [[ -n $verbs ]]; then
    offered=$verbs
  else
    local -a kinds=($arguments)
    local last=${kinds[${#kinds[@]} - 1]}
    [[ $last != \** ]] || ((position < ${#kinds[@]})) || position=$((${#kinds[@]} - 1))
    offered=${kinds[position]#\*}
    offered=${offered//,/ }
    [[ $offered != "-" ]] || offered=
  fi
  COMPREPLY=()
  if [[ " $offered " == *" @file "* ]]; then
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$cur")
  fi
  mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -W "${offered//@file/}" -- "$cur")
}
complete -F _beeline beeline
)";

/// The words offered for an argument or a value; @file represents names of files.
std::vector<std::string> bash_offered(Completes completes, std::vector<std::string> words) {
  if (completes == Completes::arm) words = built_in_names();
  if (completes != Completes::nothing) words.push_back("@file");
  return words;
}

std::string bash_case(const Leaf& leaf) {
  std::string options, valued, values, arguments;
  for (const Option& option : all_options(*leaf.verb)) {
    for (const std::string& name : {option.name, option.alias}) {
      if (name.empty()) continue;
      options += " " + name;
      if (is_flag(option)) continue;
      valued += " " + name;
      const std::string words = words_text(bash_offered(option.completes, option.choices));
      if (!words.empty()) values += "        " + name + ") values='" + words + "' ;;\n";
    }
  }
  for (const Positional& argument : leaf.verb->arguments) {
    const std::string words = words_text(bash_offered(argument.completes, argument.choices), ",");
    arguments += (arguments.empty() ? "" : " ");
    arguments += (argument.targets == nullptr ? "" : "*") + (words.empty() ? "-" : words);
  }
  std::string text = "    '" + words_text(leaf.words) + "')\n      options='" + options.substr(1) +
                     "'\n      valued='" + valued + "'\n      arguments='" + arguments + "'\n";
  if (!values.empty()) text += "      case $prev in\n" + values + "      esac\n";
  return text + "      ;;\n";
}

std::string bash_verbs_case(const std::string& command, const std::vector<Verb>& verbs) {
  std::string words;
  for (const Verb& verb : verbs) words += " " + verb.name;
  return "    '" + command + "') verbs='" + words.substr(1) + "' options='--help" +
         (command.empty() ? " --version" : "") + "' ;;\n";
}

}  // namespace

std::string bash_completion(const std::vector<Verb>& verbs) {
  std::string text =
      "# bash completion for beeline, printed by `beeline completion bash`\n"
      "_beeline_words() {\n"
      "  verbs= options= valued= values= arguments=\n"
      "  case $1 in\n" +
      bash_verbs_case("", verbs);
  for (const Verb& verb : verbs) {
    if (!verb.verbs.empty()) text += bash_verbs_case(verb.name, verb.verbs);
  }
  for (const Leaf& leaf : leaves(verbs)) text += bash_case(leaf);
  return text + "  esac\n}\n" + bash_functions;
}

}  // namespace beeline::command
