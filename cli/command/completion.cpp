#include "completion.h"

namespace beeline::command {

std::vector<Leaf> leaves(const std::vector<Verb>& verbs) {
  std::vector<Leaf> found;
  for (const Verb& verb : verbs) {
    if (verb.verbs.empty()) found.push_back({{verb.name}, &verb});
    for (Leaf leaf : leaves(verb.verbs)) {
      leaf.words.insert(leaf.words.begin(), verb.name);
      found.push_back(leaf);
    }
  }
  return found;
}

std::string words_text(const std::vector<std::string>& words, const char* separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

Verb completion_verb(const std::vector<Verb>& verbs) {
  const auto shell = std::make_shared<std::string>();
  return {.name = "completion",
          .summary = "Print a script that completes beeline's words in a shell",
          .description =
              "The script completes verbs, options, their values and the names of built-in arms. "
              "It is installed with Beeline; otherwise write it to where the shell looks, or "
              "evaluate it in the shell's start-up file.",
          .arguments = {{.name = "SHELL",
                         .help = "bash, zsh or fish.",
                         .target = shell.get(),
                         .choices = {"bash", "zsh", "fish"}}},
          .examples = {{"Complete in this session of bash", "source <(beeline completion bash)"},
                       {"Complete in fish",
                        "mkdir -p fish/completions\n"
                        "beeline completion fish > fish/completions/beeline.fish"}},
          .json = nullptr,
          .run = [&verbs, shell]() -> Answer {
            if (*shell == "bash") return {.text = bash_completion(verbs)};
            if (*shell == "zsh") return {.text = zsh_completion(verbs)};
            return {.text = fish_completion(verbs)};
          }};
}

}  // namespace beeline::command
