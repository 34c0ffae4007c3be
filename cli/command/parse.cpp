#include "parse.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/file.h>
#include <beeline/model/catalog.h>

namespace beeline::command {
namespace {

using Words = std::vector<std::string>;

bool is_number_like(const std::string& word) {
  const std::size_t sign = word.find_first_not_of("+-");
  return sign != std::string::npos &&
         std::string("0123456789.").find(word[sign]) != std::string::npos;
}

/// The name of an option word: "--rate" of "--rate=100".
std::string option_name(const std::string& word) { return word.substr(0, word.find('=')); }

/// The error for a word that is neither an option nor an expected argument.
Error unexpected(const Verb& verb, const std::string& word) {
  if (is_number_like(word)) {
    return Error("unexpected argument " + word + "; write a list without blanks, such as 1,-2,3");
  }
  if (word[0] != '-') return Error("unexpected argument \"" + word + "\"");
  const std::string name = option_name(word);
  Words known;
  for (const Option& option : all_options(verb)) {
    known.push_back(option.name);
    if (option.alias.size() > 2) known.push_back(option.alias);
  }
  return unknown_name("option", name, known, false);  // the help lists them
}

/// An option as CLI11 parses it.
struct Parsed {
  const Option* option;
  CLI::Option* result;
};

std::string typed_name(const Option& option, const Words& arguments) {
  const auto is_alias = [&](const std::string& word) { return option_name(word) == option.alias; };
  const bool alias = std::any_of(arguments.begin(), arguments.end(), is_alias);
  return alias && !option.alias.empty() ? option.alias : option.name;
}

void refuse_repeated(const Option& option, const CLI::Option* result, const Words& arguments) {
  if (result->count() <= 1 || is_list(option)) return;
  throw Error(typed_name(option, arguments) + " is given " + std::to_string(result->count()) +
              " times");
}

bool has(const Words& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// CLI11 takes the next word as the value of `--q=`, and any value of a flag.
void check_equals_signs(const std::vector<Option>& options, const Words& arguments) {
  for (const std::string& word : arguments) {
    if (!word.starts_with('-') || word.find('=') == std::string::npos) continue;
    for (const Option& option : options) {
      const std::string name = option_name(word);
      if (name != option.name && name != option.alias) continue;
      if (is_flag(option)) throw Error(name + " takes no value, but was given " + word);
      if (word == name + "=") throw Error(name + " needs a value that is not empty");
    }
  }
}

/// Checks the options that this one needs or excludes.
void check_combination(const Option& option, const std::string& name, const Words& typed,
                       const std::string& method) {
  if (!option.needs.empty() && !has(typed, option.needs)) {
    throw Error(name + " needs " + option.needs);
  }
  if (!option.excludes.empty() && has(typed, option.excludes)) {
    throw Error(name + " cannot be combined with " + option.excludes);
  }
  if (option.methods.empty() || has(option.methods, method)) return;
  throw Error(name + " has no effect with --method " + method + "; it requires --method " +
              listed(option.methods));
}

std::string method_of(const Verb& verb) {
  for (const Option& option : verb.options) {
    if (option.name == "--method") return *std::get<std::string*>(option.target);
  }
  return "";
}

/// Whether a text typed for a trajectory can only be an arm; a .json file may be either.
bool is_arm(const std::string& text) {
  return has_link_tree_ending(text) || is_joint_string(text) || has(built_in_names(), text);
}

/// Throws Error if the arguments of a verb `VERB ARM FILE...` were given as `VERB FILE... ARM`.
void check_order(const Verb& verb) {
  if (verb.arguments.size() < 2 || verb.arguments.front().completes != Completes::arm) return;
  const Positional& end = verb.arguments.back();
  if (end.completes == Completes::arm || end.targets != nullptr) return;  // two arms have no order
  const std::string &first = *verb.arguments.front().target, &last = *end.target;
  const std::string format = extension(first);
  if (last.empty() || !(format == "csv" || (format == "json" && is_arm(last)))) return;
  std::string order = verb.name;
  for (const Positional& argument : verb.arguments) order += " " + argument.name;
  throw Error("the arm comes first, before the file: beeline " + order + ", not " + first + " " +
              last);
}

void set_arguments(const Verb& verb, const std::vector<CLI::Option*>& results) {
  for (std::size_t i = 0; i < verb.arguments.size(); ++i) {
    const Positional& argument = verb.arguments[i];
    if (results[i]->count() == 0) {
      if (argument.required) throw Error(argument.name + " is missing");
      continue;
    }
    if (argument.targets != nullptr) {
      *argument.targets = results[i]->results();
      if (has(*argument.targets, "")) throw Error(argument.name + " is empty");
      continue;
    }
    *argument.target = results[i]->results().front();
    if (argument.target->empty()) throw Error(argument.name + " is empty");
    if (argument.choices.empty() || argument.other_values) continue;
    check_choice(argument.name, *argument.target, argument.choices);
  }
  check_order(verb);
}

Words set_options(const Verb& verb, const std::vector<Parsed>& parsed, const Words& arguments) {
  Words typed;
  for (const auto& [option, result] : parsed) {
    const std::string name = typed_name(*option, arguments);
    if (result->count() == 0) {
      if (option->required) throw Error(name + " " + option->value + " is missing");
      continue;
    }
    refuse_repeated(*option, result, arguments);
    typed.push_back(name);
    if (auto* const* flag = std::get_if<bool*>(&option->target)) {
      if (*flag != nullptr) **flag = true;
    } else {
      for (const std::string& text : result->results()) assign(*option, name, text);
    }
  }
  const std::string method = method_of(verb);
  for (const auto& [option, result] : parsed) {
    if (result->count() == 0) continue;
    check_combination(*option, typed_name(*option, arguments), typed, method);
  }
  return typed;
}

}  // namespace

std::vector<std::string> parse(const Verb& verb, const Words& arguments) {
  CLI::App app;
  app.set_help_flag();
  app.allow_extras();
  const std::vector<Option> options = all_options(verb);
  check_equals_signs(options, arguments);
  std::vector<CLI::Option*> positions;
  std::vector<Parsed> parsed;
  for (const Positional& argument : verb.arguments) {
    positions.push_back(argument.targets == nullptr
                            ? app.add_option(argument.name)
                            : app.add_option(argument.name, *argument.targets));
  }
  for (const Option& option : options) {
    const std::string names = option.name + (option.alias.empty() ? "" : "," + option.alias);
    parsed.push_back({&option, is_flag(option) ? app.add_flag(names) : app.add_option(names)});
    if (is_list(option)) parsed.back().result->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  }
  try {
    app.parse(Words(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ParseError& error) {
    for (const auto& [option, result] : parsed) {
      refuse_repeated(*option, result, arguments);
      const bool last = arguments.back() == option->name || arguments.back() == option->alias;
      if (last) throw Error(arguments.back() + " needs a value: " + option->value);
    }
    throw Error(error.what());
  }
  for (const std::string& word : app.remaining()) throw unexpected(verb, word);
  set_arguments(verb, positions);
  return set_options(verb, parsed, arguments);
}

}  // namespace beeline::command
