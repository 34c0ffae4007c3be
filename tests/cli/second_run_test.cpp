#include <cli/command/completion.h>
#include <cli/command/help.h>
#include <cli/command/program.h>
#include <cli/verbs.h>
#include <cmath>
#include <gtest/gtest.h>

namespace beeline::command {
namespace {

std::vector<Verb> whole_command() {
  static const std::vector<Verb> known = all_verbs();  // outlives the verbs that list them
  std::vector<Verb> verbs = all_verbs();
  verbs.push_back(completion_verb(known));
  verbs.push_back(help_verb(known));
  return verbs;
}

bool is_true(const Option& option) {
  const bool* const flag = std::get<bool*>(option.target);
  return flag != nullptr && *flag;
}

/// What the options and arguments of all verbs are set to, a line each.
std::string state_of(const std::vector<Verb>& verbs) {
  std::string text;
  for (const auto& [words, verb] : leaves(verbs)) {
    for (const Option& option : all_options(*verb)) {
      text += words.back() + " " + option.name + " " + default_text(option);
      if (is_flag(option)) text += is_true(option) ? "true" : "false";
      if (const auto* real = std::get_if<std::optional<double>*>(&option.target)) {
        text += **real ? std::to_string(***real) : "none";
      }
      text += "\n";
    }
    for (const Positional& argument : verb->arguments) {
      text += words.back() + " " + argument.name + " " +
              (argument.target != nullptr ? *argument.target : listed(*argument.targets)) + "\n";
    }
  }
  return text;
}

/// Sets an option to another value than its default.
void change(const Option& option) {
  if (is_flag(option)) {
    if (bool* const flag = std::get<bool*>(option.target)) *flag = true;
  } else if (std::holds_alternative<std::string*>(option.target)) {
    *std::get<std::string*>(option.target) += "changed";
  } else {
    const auto [lowest, highest, excludes_lowest] = option.range;
    double value = std::isfinite(highest) ? (lowest + highest) / 2 : std::max(lowest, 1.0) + 1;
    if (value > 1) value = std::floor(value);
    assign(option, option.name, value > 1e6 ? "1000000" : number(value));
  }
}

TEST(SecondRun, SeesNothingThatTheFirstWasGiven) {
  const std::string before = state_of(whole_command());
  const std::vector<Verb> first = whole_command();
  int changed = 0;
  for (const auto& [words, verb] : leaves(first)) {
    for (const Option& option : all_options(*verb)) {
      change(option);
      ++changed;
    }
    for (const Positional& argument : verb->arguments) {
      if (argument.target != nullptr) *argument.target += "changed";
      if (argument.targets != nullptr) argument.targets->push_back("changed");
    }
  }
  EXPECT_GT(changed, 300);
  EXPECT_NE(state_of(first), before);
  EXPECT_EQ(state_of(whole_command()), before);
}

std::string printed(std::vector<std::string> words, int code = 0) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(run_program(all_verbs(), static_cast<int>(arguments.size()), arguments.data()), code);
  return ::testing::internal::GetCapturedStdout();
}

TEST(SecondRun, PrintsWhatItWouldPrintAlone) {
  const std::vector<std::string> plain{"beeline", "ik", "rrr", "--pose", "4.459,5.226,0"};
  const std::string alone = printed(plain);
  std::vector<std::string> with_flags = plain;
  with_flags.insert(with_flags.end(), {"--all", "--degrees", "--json", "--ignore-limits"});
  EXPECT_TRUE(printed(with_flags).starts_with("{"));
  EXPECT_EQ(printed(plain), alone);
  EXPECT_FALSE(printed({"beeline", "help", "batch", "ik"}).empty());
  EXPECT_TRUE(printed({"beeline", "help"}).starts_with("Plans and proves"));
  EXPECT_TRUE(printed({"beeline", "completion", "zsh"}).starts_with("#compdef"));
  EXPECT_EQ(printed({"beeline", "completion"}, 2), "");
}

}  // namespace
}  // namespace beeline::command
