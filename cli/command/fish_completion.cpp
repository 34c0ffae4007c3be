#include <beeline/model/catalog.h>

#include "completion.h"

namespace beeline::command {
namespace {

/// __beeline_is WORDS: the verb that was typed is WORDS. __beeline_at N: N words were typed that
/// are no options; __beeline_from N: at least N.
constexpr const char* fish_functions = R"(
function __beeline_is
    set -l tokens (commandline -opc)
    for i in (seq (count $argv))
        set -l j (math $i + 1)
        test "$tokens[$j]" = "$argv[$i]"; or return 1
    end
end

function __beeline_at
    test (count (string match -v -- '-*' (commandline -opc))) -eq $argv[1]
end

function __beeline_from
    test (count (string match -v -- '-*' (commandline -opc))) -ge $argv[1]
end
)";

std::string fish_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result + "'";
}

std::string fish_line(const std::string& condition, const std::string& rest) {
  return "complete -c beeline -n " + fish_quoted(condition) + " " + rest + "\n";
}

/// What is offered for a value or an argument: only these words, or names of files as well.
std::string fish_offer(Completes completes, std::vector<std::string> words, const char* no_files) {
  if (completes == Completes::arm) words = built_in_names();
  std::string text = completes == Completes::nothing ? no_files : "-F";
  if (!words.empty()) text += " -a " + fish_quoted(words_text(words));
  return text;
}

std::string fish_option(const std::string& condition, const Option& option) {
  std::string rest = "-l " + option.name.substr(2);
  if (option.alias.size() == 2) rest += " -s " + option.alias.substr(1);
  if (option.alias.size() > 2) rest += " -l " + option.alias.substr(2);
  if (!is_flag(option)) rest += " -r " + fish_offer(option.completes, option.choices, "-f");
  return fish_line(condition, rest + " -d " + fish_quoted(option.help));
}

std::string fish_lines(const Leaf& leaf) {
  const std::string condition = "__beeline_is " + words_text(leaf.words);
  std::string text;
  for (const Option& option : all_options(*leaf.verb)) text += fish_option(condition, option);
  std::size_t words = 1 + leaf.words.size();
  for (const Positional& argument : leaf.verb->arguments) {
    const char* typed =
        argument.targets == nullptr ? "; and __beeline_at " : "; and __beeline_from ";
    text += fish_line(condition + typed + std::to_string(words++),
                      fish_offer(argument.completes, argument.choices, "-f"));
  }
  return text;
}

}  // namespace

std::string fish_completion(const std::vector<Verb>& verbs) {
  std::string text = "# fish completion for beeline, printed by `beeline completion fish`\n" +
                     std::string(fish_functions) + "\ncomplete -c beeline -f\n" +
                     fish_line("__beeline_at 1", "-l version -d 'Print the version.'") +
                     fish_line("__beeline_at 1", "-l help -s h -d 'Print this help.'");
  for (const Verb& verb : verbs) {
    text += fish_line("__beeline_at 1", "-a " + verb.name + " -d " + fish_quoted(verb.summary));
    for (const Verb& part : verb.verbs) {
      text += fish_line("__beeline_at 2; and __beeline_is " + verb.name,
                        "-a " + part.name + " -d " + fish_quoted(part.summary));
    }
  }
  for (const Leaf& leaf : leaves(verbs)) text += fish_lines(leaf);
  return text;
}

}  // namespace beeline::command
